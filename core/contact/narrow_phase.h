#pragma once
#include <array>
#include <vector>

#include "core/contact/contact_candidates.h"

namespace sprung {

/// A point of a skin relative to a triangle.
struct PointTriangleContact {
  const CandidatePair* pair = nullptr;
  double gap = 0;  // m, from the triangle's plane
  Vec3 normal;     // of the triangle
  Vec3 weights;    // of the triangle's corners at the point's projection
};

/// The pairs of one point with triangles of one body, and its last triangle.
struct SkinRun {
  std::size_t first;
  std::size_t end;
  std::size_t last;
};

/// The body that a pair's triangle belongs to.
[[nodiscard]] inline std::size_t other_of(const ContactCandidates& pairs, const CandidatePair& pair) {
  return pairs.tracked(pair.corners[0]).body;
}

[[nodiscard]] std::vector<SkinRun> runs_of(const ContactCandidates& pairs);

/// The contact with the nearest of the triangles that the point projects onto, at the positions of
/// ContactCandidates::follow(); without a pair if there is none. Points deeper than `depth` (m) came from the other
/// side. While a point in contact stays over a triangle, it is not compared with the others.
[[nodiscard]] PointTriangleContact closest_triangle(const ContactCandidates& pairs, SkinRun& run, double depth);

/// Weights of the corners of the bricks that carry a point of a triangle, brick by brick.
struct TriangleStencil {
  std::array<int, 3> bricks{};
  std::array<CornerWeights, 3> weights;
  std::size_t count = 0;
};
[[nodiscard]] TriangleStencil contact_stencil(const ContactCandidates& pairs, const ContactSurface& skin,
                                              const PointTriangleContact& stance);

}  // namespace sprung
