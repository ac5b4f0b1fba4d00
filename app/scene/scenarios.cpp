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

constexpr std::array<std::string_view, 7> kScenarioNames{"drop",  "hang",   "squash", "stretch",
                                                         "twist", "wobble", "throw"};

constexpr double kDropHeight = 0.4;  // in sizes above the ground
constexpr double kHangHeight = 0.5;  // in sizes above the ground: near enough to see, far enough to stretch
constexpr double kSwing = 0.6;       // sizes to the side, in a time
constexpr double kSwingTime = 0.12;  // of the film's: what hangs follows late and swings
constexpr double kHeldFraction = 0.08;
constexpr double kStretch = 0.6;      // heights
constexpr double kPlate = 0.08;       // sizes, thick
constexpr double kPlateSide = 1.5;    // sizes
constexpr double kPlateHeight = 0.1;  // sizes above the ground
constexpr double kSquash = 0.2;       // heights, each plate
constexpr double kTwist = 180;        // degrees
constexpr double kBend = 0.3;         // heights
constexpr double kThrowHeight = 0.3;
constexpr double kTumble = 0.6;  // rad in the time that gravity takes for a size

Pin bottom_pin() {
  Pin pin;
  pin.name = "bottom";
  pin.box = Box{.max = Vec3(1, kHeldFraction, 1)};
  return pin;
}

Pin top_pin() {
  Pin pin;
  pin.name = "top";
  pin.box = Box{.min = Vec3(0, 1 - kHeldFraction, 0)};
  pin.interpolation = Interpolation::kSmooth;
  return pin;
}

/// Reached at 40 % of the film, held until 60 %, and undone by the end.
std::vector<Keyframe> there_and_back(double duration, Keyframe there) {
  there.time = 0.4 * duration;
  Keyframe still = there;
  still.time = 0.6 * duration;
  return {Keyframe{}, there, still, Keyframe{.time = duration}};
}

/// Held by its top, which moves to the side and stops there.
void stage_hang(SceneBody& body, double size, double duration) {
  Pin top = top_pin();
  top.keyframes = {Keyframe{}, {.time = kSwingTime * duration, .translate = Vec3(kSwing * size, 0, 0)}};
  body.position = Vec3(-kSwing / 2 * size, kHangHeight * size, 0);
  body.pins = {top};
}

void stage_stretch(SceneBody& body, double height, double duration) {
  Pin top = top_pin();
  top.keyframes = there_and_back(duration, {.translate = Vec3(0, kStretch * height, 0)});
  body.pins = {bottom_pin(), top};
}

/// A plate with its lower face at `bottom` that moves up by `way` and back (m).
SceneObstacle plate(double size, double bottom, double way, double duration) {
  SceneObstacle obstacle;
  obstacle.box = size * Vec3(kPlateSide, kPlate, kPlateSide);
  obstacle.position = Vec3(0, bottom + obstacle.box->y() / 2, 0);
  obstacle.keyframes = there_and_back(duration, {.translate = Vec3(0, way, 0)});
  obstacle.interpolation = Interpolation::kSmooth;
  return obstacle;
}

/// Pressed between two plates.
void stage_squash(Film& scene, SceneBody& body, double size, double height) {
  const double low = kPlateHeight * size;
  body.position.y() = low + kPlate * size;
  scene.obstacles.push_back(plate(size, low, kSquash * height, scene.duration));
  scene.obstacles.push_back(plate(size, body.position.y() + height, -kSquash * height, scene.duration));
}

void stage_twist(SceneBody& body, double duration) {
  Pin top = top_pin();
  top.keyframes = there_and_back(duration, {.rotate = Vec3(0, kTwist, 0)});
  body.pins = {bottom_pin(), top};
}

void stage_wobble(SceneBody& body, double height, double duration) {
  Pin top = top_pin();
  top.keyframes = {Keyframe{}, {.time = 0.15 * duration, .translate = Vec3(kBend * height, 0, 0)}};
  top.until = 0.2 * duration;
  body.pins = {bottom_pin(), top};
}

/// On a trajectory that scales with the size.
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

bool needs_height(Scenario scenario) {
  return scenario == Scenario::kStretch || scenario == Scenario::kWobble || scenario == Scenario::kSquash;
}

void stage_scenario(Film& scene, Scenario scenario, double height) {
  SceneObstacle ground;
  ground.plane = Plane{};
  scene.obstacles = {ground};
  for (SceneBody& body : scene.bodies) {
    const double size = body.size.value_or(kDefaultSize);
    switch (scenario) {
      case Scenario::kDrop:
        body.position.y() = kDropHeight * size;
        body.rotation = Vec3(12, 0, 9);
        break;
      case Scenario::kHang:
        stage_hang(body, size, scene.duration);
        break;
      case Scenario::kSquash:
        stage_squash(scene, body, size, height);
        break;
      case Scenario::kStretch:
        stage_stretch(body, height, scene.duration);
        break;
      case Scenario::kTwist:
        stage_twist(body, scene.duration);
        break;
      case Scenario::kWobble:
        stage_wobble(body, height, scene.duration);
        break;
      case Scenario::kThrow:
        stage_throw(body, size, scene.gravity.norm());
        break;
    }
  }
}

}  // namespace sprung
