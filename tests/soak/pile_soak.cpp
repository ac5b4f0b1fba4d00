#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/simulation/simulate.h"
#include "tests/soak/dice.h"
#include "tests/soak/trials.h"

namespace sprung::test {
namespace {

constexpr double kMaxCrossing = 1e-3;  // depth over the size of the largest body
constexpr double kDuration = 1.5;      // s
constexpr double kFps = 24;

struct Options : Trials {
  std::filesystem::path scenes{};
};

struct Pile {
  Scene scene;
  std::string description;
};

enum class Shape { kBox, kBall, kCylinder, kDoughnut, kBear, kOctopus };
constexpr std::array kShapeNames{"box", "ball", "cylinder", "doughnut", "bear", "octopus"};

/// A shape of that size (m), longest side.
void shape(SceneBody& body, Shape shape, double size, Dice& dice) {
  const int bricks = dice.whole(5, 9);
  switch (shape) {
    case Shape::kBox: {
      const double brick = size / bricks;
      body.box = brick * Vec3(bricks, dice.whole(2, bricks), dice.whole(2, bricks));
      body.brick_size = brick;
      return;
    }
    case Shape::kBall:
      body.sphere = SphereShape{.radius = size / 2};
      break;
    case Shape::kCylinder:
      body.cylinder = CylinderShape{.radius = dice.between(0.15, 0.5) * size, .height = size};
      break;
    case Shape::kDoughnut: {
      const double tube = dice.between(0.1, 0.2) * size;
      body.torus = TorusShape{.radius = size / 2 - tube, .tube = tube};
      break;
    }
    case Shape::kBear:
    case Shape::kOctopus:
      body.mesh = std::filesystem::path(SPRUNG_SOURCE_DIR) / "assets/models" /
                  (shape == Shape::kBear ? "bear.ply" : "octopus.ply");
      body.size = size;
      break;
  }
  body.bricks = BrickCount(bricks);
}

/// Two to twelve bodies fall on each other, every other pile between four walls.
Pile random_pile(std::uint32_t seed, std::uint32_t index) {
  Dice dice(seed, index);
  Pile pile;
  Scene& scene = pile.scene;
  scene.duration = kDuration;
  scene.fps = kFps;
  SceneObstacle ground;
  ground.plane = Plane{};
  ground.friction = dice.between(0, 1);
  scene.obstacles.push_back(ground);
  const int count = dice.whole(2, 12);
  double height = 0;
  double largest = 0;
  for (int i = 0; i < count; ++i) {
    SceneBody body;
    const auto kind = static_cast<Shape>(dice.whole(0, int(kShapeNames.size()) - 1));
    const double size = dice.log_between(0.05, 0.2);
    shape(body, kind, size, dice);
    body.material = {.name = "random",
                     .young = dice.log_between(3e3, 3e6),
                     .poisson = dice.between(0.1, 0.49),
                     .density = dice.log_between(200, 4000),
                     .damping = dice.log_between(0.01, 0.3),
                     .source = ""};
    body.friction = dice.between(0, 1);
    for (double& angle : body.rotation) angle = dice.between(0, 360);
    // Turned about its centre, a body reaches no further than half its diagonal from there.
    constexpr double kRoom = 1.75;
    body.position = Vec3(dice.between(-0.3, 0.3) * size, height + 0.4 * size, dice.between(-0.3, 0.3) * size);
    height += kRoom * size;
    body.velocity = Vec3(dice.between(-0.5, 0.5), -dice.between(0, 4), dice.between(-0.5, 0.5));
    for (double& turn : body.spin) turn = dice.between(-180, 180);
    largest = std::max(largest, size);
    pile.description +=
        fmt::format("{}{} {:.3g} m {:.2g} Pa {:.2g} {:.3g} kg/m3", i == 0 ? "" : ", ", kShapeNames[std::size_t(kind)],
                    size, body.material.young, body.material.poisson, body.material.density);
    scene.bodies.push_back(std::move(body));
  }
  if (dice.whole(0, 1) == 0) return pile;
  const double half = 1.1 * largest;
  for (const double side : {-1.0, 1.0}) {
    for (const bool is_x : {true, false}) {
      SceneObstacle wall;
      wall.plane = Plane{.normal = is_x ? Vec3(-side, 0, 0) : Vec3(0, 0, -side)};
      wall.position = side * half * (is_x ? Vec3::UnitX() : Vec3::UnitZ());
      scene.obstacles.push_back(wall);
    }
  }
  pile.description += ", between walls";
  return pile;
}

struct Outcome {
  std::string fault;  // empty: none
  double deepest = 0;
  std::string deepest_names;
  double brick_steps = 0;
};

Outcome run(const Pile& pile) {
  Outcome outcome;
  try {
    Simulation simulation = prepare_simulation(pile.scene, Observer());
    const Recording recording = simulate(simulation, pile.scene, Observer());
    outcome.brick_steps = recording.brick_steps;
    for (const Crossings& crossings : recording.crossings) {
      if (crossings.share <= outcome.deepest) continue;
      outcome.deepest = crossings.share;
      outcome.deepest_names = fmt::format("{} at {:.3g} s", crossings.names, crossings.time);
    }
    if (recording.inverted_bricks > 0) outcome.fault = fmt::format("{} inverted bricks", recording.inverted_bricks);
  } catch (const Error& error) {
    outcome.fault = error.what();
  }
  if (outcome.deepest > kMaxCrossing) {
    outcome.fault += fmt::format("{}{} cross by {:.3g} % of the size", outcome.fault.empty() ? "" : "; ",
                                 outcome.deepest_names, 100 * outcome.deepest);
  }
  return outcome;
}

void write_scene(const Pile& pile, const std::filesystem::path& file) {
  Film film;
  static_cast<Scene&>(film) = pile.scene;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << print_scene(film);
}

TrialLine soak(const Options& options, std::uint32_t index) {
  const Pile pile = random_pile(options.seed, index);
  const Outcome outcome = run(pile);
  const bool has_failed = !outcome.fault.empty();
  if (has_failed && !options.scenes.empty()) {
    write_scene(pile, options.scenes / fmt::format("pile_{}_{}.toml", options.seed, index));
  }
  return {has_failed,
          fmt::format("{}: {}; deepest {:.2g} %, {:.2g} M brick-steps", pile.description,
                      has_failed ? outcome.fault : "well", 100 * outcome.deepest, outcome.brick_steps * 1e-6)};
}

}  // namespace
}  // namespace sprung::test

int main(int argc, char** argv) {
  using namespace sprung::test;
  Options options;
  options.count = 20;
  CLI::App app(
      "Piles up random bodies and fails where the motion diverges, a brick ends inside out or drawn skins cross by "
      "more than 0.1 % of the size.");
  options.add_options(app, "pile");
  app.add_option("--scenes", options.scenes, "folder to write the scenes of those that fail into");
  CLI11_PARSE(app, argc, argv);
  return run_trials(options, "pile", [&](std::uint32_t index) { return soak(options, index); }) == 0 ? 0 : 1;
}
