#pragma once
#include <memory>

#include "core/types.h"

namespace sprung {

/// A point of a surface.
struct SurfaceProjection {
  int triangle = 0;           // its row
  Vec3 point = Vec3::Zero();  // in units of the surface
  double distance = 0;        // to the query point
};

/// Finds the point of a surface closest to a query point. Triangles without area are ignored. Build: O(n log n); query:
/// O(log n). Deterministic; queries are thread-safe.
class NearestTriangle {
 public:
  /// Precondition: at least one triangle of non-zero area.
  NearestTriangle(const Points& points, const Triangles& triangles);
  ~NearestTriangle();
  NearestTriangle(NearestTriangle&&) noexcept;
  NearestTriangle& operator=(NearestTriangle&&) noexcept;

  [[nodiscard]] SurfaceProjection at(const Vec3& position) const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace sprung
