#pragma once
#include <vector>

#include "render/renderer.h"

namespace sprung {

/// Straight rods between points, three-sided and seen from outside; and balls. For springs, nodes and ways,
/// which are thinner than what their light would show.
class Rods {
 public:
  /// `radius` in metres.
  Rods(std::size_t count, double radius);
  [[nodiscard]] const Skin& skin() const { return skin_; }
  /// Rod i goes from from[i] to to[i]; `shares` one a rod on the colour map, or none.
  [[nodiscard]] SkinShape shape(const Points& from, const Points& to, const Eigen::VectorXd& shares) const;

 private:
  double radius_;
  Skin skin_;
};

class Balls {
 public:
  Balls(std::size_t count, double radius);
  [[nodiscard]] const Skin& skin() const { return skin_; }
  /// Those that have no middle (at most as many x 3, m) shrink to a point, `idle`.
  [[nodiscard]] SkinShape shape(const Points& middles, const Vec3& idle = Vec3::Zero()) const;

 private:
  double radius_;
  Skin skin_;
};

}  // namespace sprung
