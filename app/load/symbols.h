#pragma once
#include <vector>

#include "core/skin/skin.h"
#include "render/renderer.h"

namespace sprung {

/// Solid arrows and cones, gathered into one skin: the symbols of loads and supports.
class Symbols {
 public:
  /// A cone; `along` from the middle of its base to its tip, m.
  void add_cone(const Vec3& base, const Vec3& along, double radius);
  /// An arrow from `tail` to `tip`, with one head or two, as thick as suits its length.
  void add_arrow(const Vec3& tail, const Vec3& tip, int heads = 1);
  void add_ball(const Vec3& centre, double radius);

  [[nodiscard]] bool empty() const { return triangles_.empty(); }
  /// The skin and its one shape.
  [[nodiscard]] Skin skin() const;
  /// n x 3, m.
  [[nodiscard]] Points points() const;

 private:
  /// A ring of points about an axis, with normals that lean along it by `lean`.
  int add_ring(const Vec3& centre, const Vec3& axis, double radius, double lean);
  void add_band(int first, int second);

  std::vector<Vec3> points_;
  std::vector<Vec3> normals_;
  std::vector<Eigen::Vector3i> triangles_;
};

}  // namespace sprung
