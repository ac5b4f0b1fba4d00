#include "app/inspect/forecast.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/dynamics/implicit/implicit_motion.h"
#include "render/renderer.h"

namespace sprung {
namespace {

constexpr double kBytesOfProgram = 130e6;      // libraries and compiled shaders
constexpr double kBytesAPixel = 120;           // per sample: colour, depth, light and copies
constexpr double kBytesABrick = 900;           // grid, patches, state and tiles
constexpr double kBytesABrickImplicit = 3200;  // including the matrices and vectors of multigrid
constexpr double kBytesASkinVertex = 400;      // rest shape, embedding, contact, buffers of the driver
constexpr double kSecondsToMeasure = 0.3;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool is_implicit(const Film& scene, const World& world) {
  return !is_motion(scene) || plan_steps(world, scene).is_implicit();
}

double seconds_of_implicit_frame(World world, const StepPlan& plan) {
  const auto start = std::chrono::steady_clock::now();
  ImplicitMotion motion(world,
                        {.scheme = plan.scheme == Solver::kBdf2 ? ImplicitScheme::kBdf2 : ImplicitScheme::kEuler});
  motion.advance(plan.steps.dt, 1, 0);
  return seconds_since(start) * double(plan.steps.count);
}

/// Of explicit time steps of all bodies: seconds per call, and per step.
double seconds_of_explicit_frame(World world, const StepPlan& plan) {
  const Scheme scheme = plan.scheme == Solver::kVerlet ? Scheme::kVerlet : Scheme::kSymplecticEuler;
  double bricks = 0;
  for (const SoftBody& actor : world.bodies) bricks += actor.grid.brick_count();
  const double dt = stable_step(world);
  const auto seconds_of = [&](long steps) {
    const auto start = std::chrono::steady_clock::now();
    advance(world, scheme, dt, steps, 0);
    return seconds_since(start);
  };
  static_cast<void>(seconds_of(1));  // the first call starts threads and allocates
  const double one = seconds_of(1);
  const double whole = plan.brick_steps / bricks;  // steps per frame
  double seconds = 0;
  double a_step = one;
  for (long steps = 2; seconds < kSecondsToMeasure && double(steps) <= std::max(whole, 2.0); steps *= 2) {
    const double more = seconds_of(1 + steps);
    a_step = std::max(more - one, 0.0) / double(steps);
    seconds += more;
  }
  return one + a_step * std::max(whole - 1, 0.0);
}

/// Sum over all bodies.
double seconds_a_frame(const World& world, const StepPlan& plan) {
  return plan.is_implicit() ? seconds_of_implicit_frame(world, plan) : seconds_of_explicit_frame(world, plan);
}

double seconds_a_picture(const Simulation& simulation, const Film& scene) {
  Stage stage;
  std::vector<SkinShape> shapes;
  for (const SoftBody& drawn : simulation.world.bodies) {
    stage.skins.push_back(&drawn.skin);
    stage.default_colors.emplace_back(Eigen::Vector3f::Constant(0.7F));
    stage.bounds.extend(bounding_box(drawn.skin.positions));
    shapes.push_back({drawn.skin.positions.cast<float>(), drawn.skin.normals.cast<float>()});
  }
  stage.has_ground = ground_height(simulation.world.obstacles).has_value();
  stage.ground.height = stage.bounds.min().y();
  const auto [width, height] = scene.render.resolution;
  Renderer renderer(stage, {.width = width,
                            .height = height,
                            .samples = scene.render.samples.value_or(samples_of(scene.render.quality)),
                            .quality = scene.render.quality});
  const Camera camera = frame_bounds(stage.bounds, double(width) / height);
  static_cast<void>(renderer.draw(shapes, camera));  // the first picture compiles shaders
  const auto start = std::chrono::steady_clock::now();
  static_cast<void>(renderer.draw(shapes, camera));
  return seconds_since(start);
}

}  // namespace

double memory_forecast(const Simulation& simulation, const Film& scene) {
  const double bytes_a_brick = is_implicit(scene, simulation.world) ? kBytesABrickImplicit : kBytesABrick;
  double bytes = kBytesOfProgram;
  double nodes = 0;
  for (std::size_t i = 0; i < simulation.world.bodies.size(); ++i) {
    bytes += bytes_a_brick * simulation.world.bodies[i].grid.brick_count();
    bytes += kBytesASkinVertex * double(simulation.world.bodies[i].skin.positions.rows());
    nodes += simulation.world.bodies[i].node_count();
  }
  const auto [width, height] = scene.render.resolution;
  return bytes + 3 * sizeof(float) * nodes * frame_count(scene) + kBytesAPixel * double(width) * height;
}

std::string warning_of_memory(double bytes) {
  const double present = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (bytes < present) return "";
  return fmt::format(
      "needs about {:.3g} GB of memory, of which this machine has {:.3g} GB; larger bricks or a shorter "
      "--duration need less",
      bytes / 1e9, present / 1e9);
}

Forecast make_forecast(const Simulation& simulation, const Film& scene) {
  Forecast forecast;
  forecast.memory = memory_forecast(simulation, scene);
  forecast.frames = frame_count(scene);
  if (is_motion(scene)) {
    forecast.plan = plan_steps(simulation.world, scene);
    forecast.seconds_simulating = seconds_a_frame(simulation.world, *forecast.plan);
  }
  forecast.seconds_drawing = seconds_a_picture(simulation, scene);
  return forecast;
}

void warn_of_memory(const Simulation& simulation, const Film& film, const Console& console) {
  const std::string warning = warning_of_memory(memory_forecast(simulation, film));
  if (!warning.empty()) console.warn(warning);
}

}  // namespace sprung
