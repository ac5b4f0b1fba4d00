#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include "core/types.h"

namespace sprung {

/// A triangle of a skin, or a part of one.
struct SkinPiece {
  int triangle = 0;
  Mat3 corners = Mat3::Identity();  // a column for each: its barycentric coordinates in the triangle

  /// The fraction of the triangle's area.
  [[nodiscard]] double share() const { return std::abs(corners.determinant()); }
};

/// The part of a surface (`points` n x 3, m) that a test selects. Triangles that cross its border are cut in four up to
/// `cuts` times; the last pieces count by their centroids.
[[nodiscard]] std::vector<SkinPiece> pieces_where(const Points& points, const Triangles& triangles, int cuts,
                                                  const std::function<bool(const Vec3& position)>& test);

}  // namespace sprung
