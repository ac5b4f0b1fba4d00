#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "assets/models/model.h"

namespace sprung::models {
namespace {

constexpr double kRing = 5.6;    // radius of the torus' middle line, cm
constexpr double kTube = 2.9;    // radius of its tube, cm
constexpr double kHeight = 8.2;  // of the pudding, cm

/// Icing covers the upper half of the ring and runs down it in waves.
Shape icing() {
  return [](const Vec3& p) {
    const double angle = std::atan2(p.z(), p.x());
    const double across = std::hypot(p.x(), p.z()) - kRing;
    const double outer = std::clamp(0.5 + across / kTube, 0.0, 1.0);
    const double wave = 0.38 * std::sin(7 * angle) + 0.22 * std::sin(12 * angle + 1);
    return kTube + 0.2 + outer * wave - p.y();
  };
}

/// A grain of sugar on the upper side, spread evenly by the golden angle.
Shape sprinkle(int index, int count) {
  const double around = index * 2.399963229728653;
  const double over = (0.22 + 0.6 * (index + 0.5) / count) * std::numbers::pi;
  const Vec3 outward(std::cos(around), 0, std::sin(around));
  const Vec3 along(-std::sin(around), 0, std::cos(around));
  const Vec3 normal = std::cos(over) * outward + std::sin(over) * Vec3::UnitY();
  const Vec3 place = kRing * outward + kTube * Vec3::UnitY() + kTube * normal;
  const double turn = 1.7 * index;
  const Vec3 direction = std::cos(turn) * along + std::sin(turn) * normal.cross(along);
  return limb(place - 0.4 * direction, 0.23, place + 0.4 * direction, 0.23);
}

/// Distance from the axis to the pudding's side at height y, seen from direction `angle`: 12 flutes, deeper below.
double pudding_radius(double y, double angle) {
  const double share = std::clamp(y / kHeight, 0.0, 1.0);
  const double flute = 0.42 * (1 - 0.55 * share) * std::cos(12 * angle);
  return 6.3 - 2.0 * share + flute;
}

Shape pudding_side() {
  return [](const Vec3& p) {
    const double out = std::hypot(p.x(), p.z()) - pudding_radius(p.y(), std::atan2(p.z(), p.x()));
    return 0.95 * out;  // the side leans, so this is nearer to the distance
  };
}

Shape pudding_body() {
  const Shape slab = [](const Vec3& p) { return p.y() - kHeight; };
  return meet(meet(pudding_side(), slab, 1.8), above(0), 0.9);
}

/// Sauce over the top that drips down in tongues.
Shape sauce() {
  return [](const Vec3& p) {
    const double angle = std::atan2(p.z(), p.x());
    const double drip = 0.55 * std::sin(5 * angle + 0.6) + 0.35 * std::sin(8 * angle + 2);
    return kHeight - 1.9 + drip - p.y();
  };
}

}  // namespace

Model make_torus() {
  constexpr int kSprinkles = 36;
  const std::array<Color, 5> sugar = {color_from_hex(0xFFFFFF), color_from_hex(0xFFD23F), color_from_hex(0x3BCEAC),
                                      color_from_hex(0x4D7CFE), color_from_hex(0xD7263D)};
  const Color dough = color_from_hex(0xD9A05B);
  Model torus;
  torus.name = "torus";
  torus.shape = [](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.z()) - kRing, p.y() - kTube) - kTube; };
  torus.center = Vec3(0, kTube, 0);
  torus.radius = 11;
  torus.edge = 0.7;
  torus.base = [dough](const Vec3&) -> const Color& { return dough; };
  torus.layers = {{icing(), color_from_hex(0xF277A6), 0.22}};
  for (int i = 0; i < kSprinkles; ++i) {
    torus.layers.push_back({sprinkle(i, kSprinkles), sugar[std::size_t(i) % sugar.size()], 0.2});
  }
  return torus;
}

Model make_jelly() {
  Model jelly;
  jelly.name = "jelly";
  jelly.shape = pudding_body();
  jelly.center = Vec3(0, kHeight / 2, 0);
  jelly.radius = 9;
  jelly.edge = 0.5;
  return jelly;
}

Model make_pudding() {
  const Color custard = color_from_hex(0xF6CF65);
  Model pudding;
  pudding.name = "pudding";
  const Shape cherry = ball(Vec3(0, kHeight + 0.75, 0), 1.25);
  pudding.shape = join(pudding_body(), cherry, 0.25);
  pudding.center = Vec3(0, kHeight / 2, 0);
  pudding.radius = 9;
  pudding.edge = 0.42;
  pudding.base = [custard](const Vec3&) -> const Color& { return custard; };
  pudding.tolerance = 0.015;
  pudding.layers = {{sauce(), color_from_hex(0x7A3312), 0.18},
                    {ball(Vec3(0, kHeight + 0.8, 0), 1.28), color_from_hex(0xC8102E), 0.14},
                    {ball(Vec3(-0.45, kHeight + 1.75, 0.55), 0.28), color_from_hex(0xFFD5D5), 0.14, 0.8}};
  return pudding;
}

}  // namespace sprung::models
