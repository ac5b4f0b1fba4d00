#include "app/validate/macneal.h"

#include <cmath>
#include <numbers>

#include "app/validate/mapped_block.h"
#include "app/validate/table_scene.h"

namespace sprung {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

}  // namespace

Scene curved_beam_scene(int axis) {
  const auto arc = [](const Vec3& p) {
    const double radius = 4.12 + 0.2 * p.x();
    const double angle = kQuarter * p.y();
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.1 * p.z());
  };
  TableScene scene(mapped_block({1, 90, 1}, arc), 0.1 / 3, 1e7, 0.25);
  // Its root lies in the plane y = 0; the load at the other end.
  scene.hold("y-low").pull("y-high", Vec3::Unit(axis)).probe("tip", {0, 4.22, 0.05});
  return scene.scene();
}

Scene twisted_beam_scene(int axis, int bricks) {
  const auto twist = [](const Vec3& p) {
    const double angle = kQuarter * p.x();
    const double across = 1.1 * (p.y() - 0.5);
    const double thick = 0.32 * (p.z() - 0.5);
    return Vec3(12 * p.x(), across * std::cos(angle) - thick * std::sin(angle),
                across * std::sin(angle) + thick * std::cos(angle));
  };
  TableScene scene(mapped_block({96, 8, 2}, twist), 1.1 / bricks, 29e6, 0.22);
  // At the tip the section's width lies along z.
  scene.hold("x-low").pull("x-high", Vec3::Unit(axis)).probe("tip", {12, 0, 0});
  return scene.scene();
}

}  // namespace sprung
