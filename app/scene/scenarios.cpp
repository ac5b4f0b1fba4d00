#include "app/scene/scenarios.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/text.h"

namespace sprung {
namespace {

constexpr std::array<std::string_view, 8> kScenarioNames{"drop",  "hang",   "squash", "stretch",
                                                         "twist", "wobble", "throw",  "tumble"};

constexpr double kTumbleHeight = 0.4;  // in sizes above the ground
constexpr double kHangHeight = 0.5;    // in sizes above the ground: near enough to see, far enough to stretch
constexpr double kSwing = 0.6;         // sizes to the side, in a time
constexpr double kSwingTime = 0.36;    // s: what hangs follows late and swings
constexpr double kPinnedFraction = 0.08;
constexpr double kStretch = 0.6;      // heights
constexpr double kPlate = 0.08;       // sizes, thick
constexpr double kPlateSide = 1.5;    // sizes
constexpr double kPlateHeight = 0.1;  // sizes above the ground
constexpr double kSquash = 0.2;       // heights, each plate
constexpr double kTwist = 180;        // degrees
constexpr double kBend = 0.3;         // heights
constexpr double kBendTime = 0.45;    // s
constexpr double kLetGo = 0.6;        // s
constexpr double kThere = 1.2;        // s: what is done and undone is done by then,
constexpr double kStay = 1.8;         // s: is held until then
constexpr double kBack = 3.0;         // s: and is undone by then
constexpr double kThrowHeight = 0.3;
constexpr double kTumble = 0.6;  // rad in the time that gravity takes for a size

/// The row of the vertical axis in the file's frame.
int row_of(UpAxis up) { return up == UpAxis::kY ? 1 : 2; }

Pin bottom_pin(UpAxis up) {
  Pin pin;
  pin.name = "bottom";
  pin.box = Box{};
  pin.box->max[row_of(up)] = kPinnedFraction;
  return pin;
}

Pin top_pin(UpAxis up) {
  Pin pin;
  pin.name = "top";
  pin.box = Box{};
  pin.box->min[row_of(up)] = 1 - kPinnedFraction;
  pin.interpolation = Interpolation::kSmooth;
  return pin;
}

std::vector<Keyframe> there_and_back(Keyframe there) {
  there.time = kThere;
  Keyframe still = there;
  still.time = kStay;
  return {Keyframe{}, there, still, Keyframe{.time = kBack}};
}

/// Held by its top, which moves to the side and stops there.
void stage_hang(SceneBody& body, double size, UpAxis up) {
  Pin top = top_pin(up);
  top.keyframes = {Keyframe{}, {.time = kSwingTime, .translate = Vec3(kSwing * size, 0, 0)}};
  body.position = Vec3(-kSwing / 2 * size, kHangHeight * size, 0);
  body.pins = {top};
}

void stage_stretch(SceneBody& body, double height, UpAxis up) {
  Pin top = top_pin(up);
  top.keyframes = there_and_back({.translate = Vec3(0, kStretch * height, 0)});
  body.pins = {bottom_pin(up), top};
}

/// A plate with its lower face at `bottom` that moves up by `way` and back (m).
SceneObstacle plate(double size, double bottom, double way) {
  SceneObstacle obstacle;
  obstacle.box = size * Vec3(kPlateSide, kPlate, kPlateSide);
  obstacle.position = Vec3(0, bottom + obstacle.box->y() / 2, 0);
  obstacle.keyframes = there_and_back({.translate = Vec3(0, way, 0)});
  obstacle.interpolation = Interpolation::kSmooth;
  return obstacle;
}

/// Pressed between two plates.
void stage_squash(Film& film, SceneBody& body, double size, double height) {
  const double low = kPlateHeight * size;
  body.position.y() = low + kPlate * size;
  film.obstacles.push_back(plate(size, low, kSquash * height));
  film.obstacles.push_back(plate(size, body.position.y() + height, -kSquash * height));
}

void stage_twist(SceneBody& body, UpAxis up) {
  Pin top = top_pin(up);
  top.keyframes = there_and_back({.rotate = Vec3(0, kTwist, 0)});
  body.pins = {bottom_pin(up), top};
}

void stage_wobble(SceneBody& body, double height, UpAxis up) {
  Pin top = top_pin(up);
  top.keyframes = {Keyframe{}, {.time = kBendTime, .translate = Vec3(kBend * height, 0, 0)}};
  top.until = kLetGo;
  body.pins = {bottom_pin(up), top};
}

/// Thrown on a trajectory that scales with the size.
void stage_throw(SceneBody& body, double size, double gravity) {
  const double speed = std::sqrt(gravity * size);
  body.position = Vec3(-0.7 * size, kThrowHeight * size, 0);
  body.velocity = speed * Vec3(0.55, 1.1, 0);
  body.spin = Vec3(0, 0, -kTumble * std::sqrt(gravity / size) * 180 / std::numbers::pi);
}

}  // namespace

std::span<const std::string_view> scenario_names() { return kScenarioNames; }

Scenario scenario_from_name(std::string_view name) {
  const auto found = std::find(kScenarioNames.begin(), kScenarioNames.end(), name);
  if (found != kScenarioNames.end()) return static_cast<Scenario>(found - kScenarioNames.begin());
  throw Error(ErrorKind::kUsage, fmt::format("there is no scenario '{}'{}", name, did_you_mean(name, kScenarioNames)));
}

void stage_scenario(Film& film, Scenario scenario, double height, UpAxis up, double drop) {
  SceneObstacle ground;
  ground.plane = Plane{};
  film.obstacles = {ground};
  for (SceneBody& body : film.bodies) {
    const double size = body.size.value_or(kDefaultSize);
    switch (scenario) {
      case Scenario::kDrop:
        body.position.y() = drop * size;
        break;
      case Scenario::kTumble:
        body.position.y() = kTumbleHeight * size;
        body.rotation += Vec3(12, 0, 9);
        break;
      case Scenario::kHang:
        stage_hang(body, size, up);
        break;
      case Scenario::kSquash:
        stage_squash(film, body, size, height);
        break;
      case Scenario::kStretch:
        stage_stretch(body, height, up);
        break;
      case Scenario::kTwist:
        stage_twist(body, up);
        break;
      case Scenario::kWobble:
        stage_wobble(body, height, up);
        break;
      case Scenario::kThrow:
        stage_throw(body, size, film.gravity.norm());
        break;
    }
  }
}

void stage_at_rest(Film& film, UpAxis up) {
  std::erase_if(film.obstacles, [](const SceneObstacle& obstacle) { return obstacle.plane.has_value(); });
  for (SceneBody& body : film.bodies) {
    body.velocity.setZero();
    body.spin.setZero();
    if (body.pins.empty()) body.pins = {bottom_pin(up)};
  }
}

}  // namespace sprung
