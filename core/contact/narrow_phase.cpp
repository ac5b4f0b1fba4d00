#include "core/contact/narrow_phase.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/query/barycentric.h"

namespace sprung {
namespace {

constexpr double kBeside = 0.05;    // of a triangle: points slightly outside count as over it
constexpr double kTouching = 0.15;  // of the depth: points this near to the triangle below them touch it

/// False if the point does not project onto the triangle.
bool stand(const ContactCandidates& pairs, const CandidatePair& pair, double depth, PointTriangleContact& stance) {
  const TrackedPoint& point = pairs.tracked(pair.point);
  std::array<const TrackedPoint*, 3> corners{};
  for (std::size_t i = 0; i < 3; ++i) corners[i] = &pairs.tracked(pair.corners[i]);
  const Vec3 ahead = corners[1]->position - corners[0]->position;
  const Vec3 aside = corners[2]->position - corners[0]->position;
  const Vec3 area = ahead.cross(aside);
  const Vec3 off = point.position - corners[0]->position;
  stance.pair = &pair;
  stance.normal = area / area.norm();
  stance.gap = stance.normal.dot(off);
  stance.weights = barycentric(ahead, aside, off);
  return stance.gap > -depth && stance.weights.minCoeff() > -kBeside;  // not if the triangle has no area
}

}  // namespace

std::vector<SkinRun> runs_of(const ContactCandidates& pairs) {
  const std::vector<CandidatePair>& all = pairs.pairs();
  std::vector<SkinRun> runs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool goes_on =
        i > 0 && all[i].point == all[i - 1].point && other_of(pairs, all[i]) == other_of(pairs, all[i - 1]);
    if (!goes_on) runs.push_back({.first = i, .end = i, .last = i});
    runs.back().end = i + 1;
  }
  return runs;
}

PointTriangleContact closest_triangle(const ContactCandidates& pairs, SkinRun& run, double depth) {
  PointTriangleContact nearest;
  const std::vector<CandidatePair>& all = pairs.pairs();
  if (stand(pairs, all[run.last], depth, nearest) && std::abs(nearest.gap) < kTouching * depth) return nearest;
  nearest.pair = nullptr;
  for (std::size_t i = run.first; i < run.end; ++i) {
    PointTriangleContact stance;
    if (!stand(pairs, all[i], depth, stance)) continue;
    if (nearest.pair != nullptr && std::abs(stance.gap) >= std::abs(nearest.gap)) continue;
    nearest = stance;
    run.last = i;
  }
  return nearest;
}

TriangleStencil contact_stencil(const ContactCandidates& pairs, const ContactSurface& skin,
                                const PointTriangleContact& stance) {
  TriangleStencil stencil;
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = pairs.tracked(stance.pair->corners[i]).point;
    const ContactPoint& corner = skin.points[row];
    const auto begin = stencil.bricks.begin();
    const auto same = std::size_t(std::find(begin, begin + std::ptrdiff_t(stencil.count), corner.brick) - begin);
    if (same == stencil.count) {
      stencil.bricks[stencil.count] = corner.brick;
      stencil.weights[stencil.count++].setZero();
    }
    stencil.weights[same] -= stance.weights[i] * corner.weights;
  }
  return stencil;
}

}  // namespace sprung
