#include <cmath>
#include <numbers>

#include "assets/models/model.h"

namespace sprung::models {
namespace {

constexpr double kThickness = 1.5;  // radius of the tube, cm
constexpr double kLift = 1.5;       // keeps the strands more than a radius apart where they cross

/// A trefoil that lies on the floor.
Vec3 trefoil(double t) {
  const double a = 2 * std::numbers::pi * t;
  const Vec3 flat(std::sin(a) + 2 * std::sin(2 * a), -kLift * std::sin(3 * a), std::cos(a) - 2 * std::cos(2 * a));
  return 3.0 * flat + Vec3(0, 3.0 * kLift + kThickness, 0);
}

/// Runs once through soft rainbow colours along the knot.
Color color_along(double t) {
  const auto wave = [&](double shift) { return 0.60 + 0.36 * std::cos(2 * std::numbers::pi * (t - shift)); };
  return {wave(0), wave(0.36), wave(0.68)};
}

}  // namespace

Model make_knot() {
  Model knot;
  knot.name = "knot";
  knot.shape = tube(
      trefoil, [](double) { return kThickness; }, true);
  knot.center = Vec3(0, 6, 0);
  knot.radius = 14;
  knot.edge = 0.55;
  knot.tolerance = 0.03;
  knot.base = [nearest = nearest_place(trefoil, true)](const Vec3& p) { return color_along(nearest(p)); };
  return knot;
}

}  // namespace sprung::models
