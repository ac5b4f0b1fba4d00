#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/models/model.h"

namespace sprung::models {
namespace {

constexpr int kArms = 8;
const Vec3 kEye(2.35, 9.2, 4.45);

/// Where something of a tentacle's own frame (x outwards, y up, z sideways) lies around the body.
Vec3 around(double angle, const Vec3& p) {
  return {p.x() * std::sin(angle) + p.z() * std::cos(angle), p.y(), p.x() * std::cos(angle) - p.z() * std::sin(angle)};
}

double arm_angle(int arm) { return (arm + 0.5) * 2 * std::numbers::pi / kArms; }

/// Down from the body, along the floor and up again at the tip, swinging to alternate sides.
Curve tentacle(int arm) {
  const double angle = arm_angle(arm);
  const double side = arm % 2 == 0 ? 1 : -1;
  const double rise = 2.6 - 1.2 * std::cos(angle);  // lower in front of the face
  return bezier(around(angle, Vec3(1.2, 5.0, 0)), around(angle, Vec3(5.0, -1.2, 0)),
                around(angle, Vec3(8.7, 0.4, -1.4 * side)), around(angle, Vec3(10.6, rise, 2.4 * side)));
}

double arm_radius(double t) { return 1.95 - 1.05 * t; }

Shape arms() {
  Shape all = tube(tentacle(0), arm_radius, false);
  for (int arm = 1; arm < kArms; ++arm) all = join(all, tube(tentacle(arm), arm_radius, false), 0.9);
  return all;
}

/// Pale discs in a row under each tentacle.
Shape suckers() {
  Shape all;
  for (int arm = 0; arm < kArms; ++arm) {
    const Curve curve = tentacle(arm);
    for (const double t : {0.62, 0.74, 0.86, 0.97}) {
      const Vec3 tangent = (curve(std::min(t + 0.01, 1.0)) - curve(t - 0.01)).normalized();
      const Vec3 outward = around(arm_angle(arm), Vec3(1, 0, 0));
      const Vec3 down = (outward - outward.dot(tangent) * tangent).normalized();
      const Shape disc = ball(curve(t) + 1.0 * arm_radius(t) * down, 0.5 * arm_radius(t));
      all = all ? join(all, disc, 0) : disc;
    }
  }
  return all;
}

Shape freckles() {
  Shape all = ball(Vec3(0.2, 14.9, 2.4), 0.8);
  all = join(all, ball(Vec3(-2.0, 14.3, 2.5), 0.5), 0);
  all = join(all, ball(Vec3(2.1, 13.9, 3.4), 0.5), 0);
  all = join(all, ball(Vec3(-5.1, 12.2, -0.8), 0.85), 0);
  all = join(all, ball(Vec3(5.3, 11.5, -0.9), 0.7), 0);
  all = join(all, ball(Vec3(2.1, 13.4, -4.3), 0.9), 0);
  return join(all, ball(Vec3(-2.3, 11.3, -5.3), 0.75), 0);
}

/// Drawn in the plane z = 0 and printed on whatever lies in front of it.
Shape smile() {
  const Curve arc = bezier(Vec3(-1.2, 7.1, 0), Vec3(-0.7, 6.2, 0), Vec3(0.7, 6.2, 0), Vec3(1.2, 7.1, 0));
  const Shape line = tube(
      arc, [](double) { return 0.17; }, false);
  return [line](const Vec3& p) { return std::max(line(Vec3(p.x(), p.y(), 0)), 1 - p.z()); };
}

}  // namespace

Model make_octopus() {
  const Color top = color_from_hex(0x7B4FB5);
  const Color bottom = color_from_hex(0xB974C9);
  const Color pale = color_from_hex(0xFFD9E0);
  const Color dark = color_from_hex(0x1E1230);
  const Color white = color_from_hex(0xFFFFFF);
  const Color rose = color_from_hex(0xFF7F9E);
  Model octopus;
  octopus.name = "octopus";
  const Shape dome = join(ellipsoid(Vec3(0, 10.2, -0.2), Vec3(5.7, 5.6, 5.5)), ball(Vec3(0, 5.2, 0), 3.6), 2.5);
  octopus.shape = join(join(dome, arms(), 1.4), mirrored(ball(kEye, 1.25)), 0.3);
  octopus.shape = meet(octopus.shape, above(0), 0.5);
  octopus.center = Vec3(0, 7, 0);
  octopus.radius = 18;
  octopus.edge = 0.85;
  octopus.base = [top, bottom](const Vec3& p) -> Color {
    const double share = std::clamp(p.y() / 11, 0.0, 1.0);
    return share * top + (1 - share) * bottom;
  };
  octopus.layers = {
      {freckles(), color_from_hex(0xA97BDB), 0.25},
      {suckers(), pale, 0.22},
      {mirrored(ball(Vec3(3.6, 7.3, 3.9), 0.9)), rose, 1.0, 0.7},
      {smile(), dark, 0.1},
      {mirrored(ball(kEye + Vec3(0, 0, 0.15), 1.24)), white, 0.14},
      {mirrored(ball(kEye + Vec3(-0.1, 0, 0.95), 0.85)), dark, 0.12},
      {ball(kEye + Vec3(-0.45, 0.45, 1.15), 0.3), white, 0.09},
      {ball(kEye.cwiseProduct(Vec3(-1, 1, 1)) + Vec3(-0.25, 0.45, 1.15), 0.3), white, 0.09},
  };
  return octopus;
}

}  // namespace sprung::models
