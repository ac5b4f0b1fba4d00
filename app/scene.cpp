#include "app/scene.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kDropHeight = 0.4;  // in sizes above the ground
constexpr double kHangHeight = 0.5;  // in sizes above the ground: near enough to see, far enough to stretch
constexpr double kHeldFraction = 0.08;

}  // namespace

int frame_count(const Scene& scene) { return std::max(1, static_cast<int>(std::lround(scene.duration * scene.fps))); }

Scene with_defaults(Scene scene) {
  for (SceneBody& body : scene.bodies) {
    if (!body.size && !body.scale) body.size = kDefaultSize;
    if (!body.bricks && !body.brick_size) body.bricks = kDefaultBricks;
  }
  return scene;
}

void stage_scenario(Scene& scene, Scenario scenario) {
  scene.obstacles = {Obstacle{}};
  for (SceneBody& body : scene.bodies) {
    const double size = body.size.value_or(kDefaultSize);
    if (scenario == Scenario::kDrop) {
      body.position.y() = kDropHeight * size;
      body.rotation = Vec3(12, 0, 9);
    } else {
      body.position.y() = kHangHeight * size;
      body.pins = {Pin{.box = {.min = Vec3(0, 1 - kHeldFraction, 0)}}};
    }
  }
}

}  // namespace sprung
