#pragma once
#include <memory>

#include "core/types.h"

namespace sprung {

/// Where on a surface.
struct SurfacePlace {
  int triangle = 0;           // its row
  Vec3 point = Vec3::Zero();  // in units of the surface
  double distance = 0;        // to what was asked
};

/// Finds the place of a surface that is nearest to a point. Triangles without area are left out.
/// Build: n log n; a point costs log n. Deterministic; safe to ask from several threads.
class NearestTriangle {
 public:
  /// Precondition: a triangle with area at least.
  NearestTriangle(const Points& points, const Triangles& triangles);
  ~NearestTriangle();
  NearestTriangle(NearestTriangle&&) noexcept;
  NearestTriangle& operator=(NearestTriangle&&) noexcept;

  [[nodiscard]] SurfacePlace at(const Vec3& place) const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace sprung
