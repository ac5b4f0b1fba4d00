#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/models/model.h"

/// The bodies of scenes that show one thing each: plain shapes, painted so that one sees how they deform.
namespace sprung::models {
namespace {

const Color kCream = color_from_hex(0xF2E3C6);
const Color kCoral = color_from_hex(0xD9776C);
const Color kTeal = color_from_hex(0x5E9CA0);

Shape rounded_box(const Vec3& center, const Vec3& size, double radius) {
  const Vec3 core = size / 2 - Vec3::Constant(radius);
  return [=](const Vec3& p) {
    const Vec3 q = (p - center).cwiseAbs() - core;
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0) - radius;
  };
}

/// A rod along the z axis through `center`, its ends rounded.
Shape disc(const Vec3& center, double radius, double width, double rounding) {
  return [=](const Vec3& p) {
    const Vec3 q = p - center;
    const double out = std::hypot(q.x(), q.y()) - radius + rounding;
    const double over = std::abs(q.z()) - width / 2 + rounding;
    return std::hypot(std::max(out, 0.0), std::max(over, 0.0)) + std::min(std::max(out, over), 0.0) - rounding;
  };
}

constexpr double kLength = 20;  // of the tentacle

double tentacle_radius(double y) {
  const double t = std::clamp(y / kLength, 0.0, 1.0);
  return 1.75 - 1.0 * t + 0.55 * std::exp(-y / 0.9);
}

/// Two rows of pale discs up the front.
Shape tentacle_suckers() {
  Shape all = ball(Vec3(0, 18.9, 1.0), 0.36);
  for (int row = 0; row < 9; ++row) {
    const double y = 2.6 + 1.9 * row - 0.03 * row * row;
    const double out = tentacle_radius(y);
    for (const double side : {-1.0, 1.0}) {
      const double angle = side * 0.42;
      all = join(all, ball(Vec3(out * std::sin(angle), y + 0.45 * side, out * std::cos(angle)), 0.34 * out), 0);
    }
  }
  return all;
}

}  // namespace

Model make_tentacle() {
  const Color foot = color_from_hex(0x6F5A96);
  const Color tip = color_from_hex(0xB58BB8);
  Model tentacle;
  tentacle.name = "tentacle";
  const Shape flank = [](const Vec3& p) { return 0.98 * (std::hypot(p.x(), p.z()) - tentacle_radius(p.y())); };
  const Shape below = [](const Vec3& p) { return p.y() - kLength + 0.75; };
  tentacle.shape = meet(join(meet(flank, below, 0), ball(Vec3(0, kLength - 0.82, 0), 0.82), 0.2), above(0), 0.2);
  tentacle.center = Vec3(0, kLength / 2, 0);
  tentacle.radius = 13;
  tentacle.edge = 0.6;
  tentacle.base = [=](const Vec3& p) -> Color { return foot + std::clamp(p.y() / kLength, 0.0, 1.0) * (tip - foot); };
  tentacle.layers = {{tentacle_suckers(), color_from_hex(0xEBD3DC), 0.14}};
  return tentacle;
}

/// Two fingers on a back, with pads where they close on each other.
Model make_gripper() {
  Model gripper;
  gripper.name = "gripper";
  const Shape finger = rounded_box(Vec3(4.5, 6, 0), Vec3(3, 12, 3), 0.75);
  const Shape back = rounded_box(Vec3(0, 1.7, 0), Vec3(11, 2.6, 2.2), 0.75);
  gripper.shape = join(mirrored(finger), back, 0.4);
  gripper.center = Vec3(0, 1.5, 0);
  gripper.radius = 16;
  gripper.edge = 0.6;
  gripper.base = [](const Vec3&) -> const Color& { return kTeal; };
  gripper.layers = {{[](const Vec3& p) { return std::max(std::abs(p.x()) - 3.75, 6.2 - p.y()); }, kCream, 0.14},
                    {[](const Vec3& p) { return std::abs(p.y() - 3.7) - 0.3; }, color_from_hex(0x3F7378), 0.14}};
  return gripper;
}

/// A tyre around a dished rim with five spokes and a hub; stands upright, its axle along z.
Model make_wheel() {
  const Vec3 axle(0, 7, 0);
  Model wheel;
  wheel.name = "wheel";
  const Shape dish = disc(axle, 4.7, 1.0, 0.3);
  const Shape front = [dish](const Vec3& p) { return dish(Vec3(p.x(), p.y(), std::abs(p.z()) - 2)); };
  const Shape hub = disc(axle, 1.5, 4, 0.4);
  wheel.shape = join(carve(disc(axle, 7, 4, 0.8), front, 0.2), hub, 0.2);
  wheel.center = Vec3(0, 7, 1.8);
  wheel.radius = 12;
  wheel.edge = 0.7;
  wheel.base = [](const Vec3&) { return color_from_hex(0x4C5A68); };
  const Shape spokes = [=](const Vec3& p) {
    constexpr double kApart = 2 * std::numbers::pi / 5;
    const double angle = std::atan2(p.x(), p.y() - axle.y());
    const double off = angle - kApart * std::round(angle / kApart);
    return std::hypot(p.x(), p.y() - axle.y()) * std::abs(std::sin(off)) - 0.55;
  };
  const auto within = [=](double radius) {
    return [=](const Vec3& p) { return std::hypot(p.x(), p.y() - axle.y()) - radius; };
  };
  wheel.layers = {{within(5.0), kCream, 0.2},
                  {within(4.3), color_from_hex(0x8AA7B5), 0.2},
                  {meet(spokes, within(4.6), 0), kCream, 0.2},
                  {within(1.7), kCoral, 0.2}};
  return wheel;
}

/// A square cushion with a piping. It has no colour of its own.
Model make_cushion() {
  Model cushion;
  cushion.name = "cushion";
  const Shape filling = rounded_box(Vec3(0, 2.5, 0), Vec3(7.8, 5, 7.8), 1.3);
  const Shape piping = [](const Vec3& p) {
    const Vec3 q = Vec3(p.x(), 0, p.z()).cwiseAbs() - Vec3(2.5, 0, 2.5);
    const double out = q.cwiseMax(0).norm() + std::min(std::max(q.x(), q.z()), 0.0) - 1.3 - 0.04;
    return std::hypot(out, p.y() - 2.5) - 0.3;
  };
  cushion.shape = join(filling, piping, 0.2);
  cushion.center = Vec3(0, 2.5, 0);
  cushion.radius = 9;
  cushion.edge = 0.42;
  cushion.tolerance = 0.01;
  return cushion;
}

}  // namespace sprung::models
