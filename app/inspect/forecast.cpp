#include "app/inspect/forecast.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/dynamics/implicit/implicit_motion.h"
#include "core/error.h"
#include "core/simulation/simulate.h"
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

bool is_implicit(const Film& film, const World& world) {
  return !is_motion(film) || plan_steps(world, film).is_implicit();
}

double seconds_of_implicit_frame(World world, const StepPlan& plan) {
  const auto start = std::chrono::steady_clock::now();
  ImplicitMotion motion(world,
                        {.scheme = plan.scheme == Solver::kBdf2 ? ImplicitScheme::kBdf2 : ImplicitScheme::kEuler});
  motion.advance(plan.steps.dt, 1, 0);
  return seconds_since(start) * double(plan.steps.count);
}

/// Measures explicit time steps of all bodies: seconds per call, and per step.
double seconds_of_explicit_frame(World world, const StepPlan& plan) {
  const Scheme scheme = plan.scheme == Solver::kVerlet ? Scheme::kVerlet : Scheme::kSymplecticEuler;
  double bricks = 0;
  for (const SoftBody& body : world.bodies) bricks += body.grid.brick_count();
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

/// Measures the frames of a run, up to some time.
class FrameClock : public Observer {
 public:
  explicit FrameClock(double most) : most_(most) {}

  void check_interrupt() const override {
    if (seconds_since(start_) > most_) throw Error(ErrorKind::kFailed, "enough is measured");
  }
  void finish_frame(int frame, double, const World&) const override {
    if (frame == 0) start_ = std::chrono::steady_clock::now();  // what comes before belongs to no frame
    ends_.push_back(seconds_since(start_));
  }

  /// Seconds per frame of a film of that many, if the rest is like the last third of those measured; none if there are
  /// none.
  [[nodiscard]] std::optional<double> mean(int frames) const {
    if (ends_.size() < 2) return std::nullopt;
    const std::size_t done = ends_.size() - 1;
    const std::size_t last = std::max<std::size_t>(1, done / 3);
    const double late = (ends_[done] - ends_[done - last]) / double(last);
    return (ends_[done] + late * std::max(0, frames - 1 - int(done))) / std::max(1, frames - 1);
  }

 private:
  double most_;
  mutable std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  mutable std::vector<double> ends_;  // s, of the frames
};

/// The scene with bricks twice as large.
Film coarsened(Film scene) {
  constexpr int kMinBricks = 4;
  for (SceneBody& body : scene.bodies) {
    if (body.brick_size) *body.brick_size *= 2;
    if (body.bricks && !body.bricks->is_auto()) body.bricks->along = std::max(kMinBricks, body.bricks->along / 2);
    if (!body.bricks && !body.brick_size) body.bricks = kDefaultBricks / 2;
  }
  scene.probes.clear();
  return scene;
}

double count_of_bricks(const World& world) {
  double count = 0;
  for (const SoftBody& body : world.bodies) count += body.grid.brick_count();
  return count;
}

double count_of_contact_points(const World& world) {
  double count = 0;
  for (const SoftBody& body : world.bodies) count += double(body.contact.points.brick.size());
  return count;
}

struct CoarseRun {
  double seconds = 0;  // mean per frame
  int frames = 0;      // fewer than the scene's if it came to rest before
};

/// The time that contact adds to a frame, from a run of the whole scene with coarse bricks: it grows in proportion to
/// its points and steps. For implicit steps, whose Newton iterations grow with it, their total time. None if the scene
/// cannot be coarsened.
std::optional<CoarseRun> coarse_run(const Simulation& simulation, const Film& film, const StepPlan& plan) {
  constexpr double kMost = 4;  // s: of a heap that falls, the impact and some of what follows
  const FrameClock clock(kMost);
  const Film coarse = coarsened(film);
  std::optional<Simulation> small;
  std::optional<StepPlan> small_plan;
  double free_frame = 0;
  int frames = frame_count(film);
  try {
    small = prepare_simulation(coarse, Observer());
    small_plan = plan_steps(small->world, coarse);
    if (small_plan->is_implicit() != plan.is_implicit()) return std::nullopt;
    if (!plan.is_implicit()) free_frame = seconds_of_explicit_frame(small->world, *small_plan);
    frames = int(simulate(*small, coarse, clock).progress.size());
  } catch (const Error&) {
    if (!small || !small_plan) return std::nullopt;
  }
  const std::optional<double> frame = clock.mean(frames);
  if (!frame) return std::nullopt;
  const double steps = double(plan.steps.count) / double(small_plan->steps.count);
  if (plan.is_implicit()) {
    return CoarseRun{*frame * steps * count_of_bricks(simulation.world) / count_of_bricks(small->world), frames};
  }
  const double points = count_of_contact_points(simulation.world) / count_of_contact_points(small->world);
  return CoarseRun{std::max(0.0, *frame - free_frame) * steps * points, frames};
}

double seconds_a_picture(const Simulation& simulation, const Film& film) {
  Stage stage;
  std::vector<SkinShape> shapes;
  for (const SoftBody& body : simulation.world.bodies) {
    const Skin& skin = body.drawn.skin;
    stage.skins.push_back(&skin);
    stage.default_colors.emplace_back(Eigen::Vector3f::Constant(0.7F));
    stage.bounds.extend(bounding_box(skin.positions));
    shapes.push_back({skin.positions.cast<float>(), skin.normals.cast<float>()});
  }
  stage.has_ground = ground_height(simulation.world.obstacles).has_value();
  stage.ground.height = stage.bounds.min().y();
  const auto [width, height] = film.render.resolution;
  Renderer renderer(stage, {.width = width,
                            .height = height,
                            .samples = film.render.samples.value_or(samples_of(film.render.quality)),
                            .quality = film.render.quality});
  const Camera camera = frame_bounds(stage.bounds, double(width) / height);
  static_cast<void>(renderer.draw(shapes, camera));  // the first picture compiles shaders
  const auto start = std::chrono::steady_clock::now();
  static_cast<void>(renderer.draw(shapes, camera));
  return seconds_since(start);
}

}  // namespace

double memory_forecast(const Simulation& simulation, const Film& film) {
  const double bytes_a_brick = is_implicit(film, simulation.world) ? kBytesABrickImplicit : kBytesABrick;
  double bytes = kBytesOfProgram;
  double nodes = 0;
  for (std::size_t i = 0; i < simulation.world.bodies.size(); ++i) {
    bytes += bytes_a_brick * simulation.world.bodies[i].grid.brick_count();
    bytes += kBytesASkinVertex * double(simulation.world.bodies[i].drawn.skin.positions.rows());
    nodes += simulation.world.bodies[i].node_count();
  }
  const auto [width, height] = film.render.resolution;
  return bytes + 3 * sizeof(float) * nodes * frame_count(film) + kBytesAPixel * double(width) * height;
}

std::string warning_of_memory(double bytes) {
  const double present = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (bytes < present) return "";
  return fmt::format(
      "needs about {:.3g} GB of memory, of which this machine has {:.3g} GB; larger bricks or a shorter "
      "--duration need less",
      bytes / 1e9, present / 1e9);
}

Forecast make_forecast(const Simulation& simulation, const Film& film) {
  Forecast forecast;
  forecast.memory = memory_forecast(simulation, film);
  forecast.frames = frame_count(film);
  if (is_motion(film)) {
    forecast.plan = plan_steps(simulation.world, film);
    const std::optional<CoarseRun> coarse = coarse_run(simulation, film, *forecast.plan);
    if (coarse) forecast.frames = coarse->frames;
    if (!forecast.plan->is_implicit()) {
      forecast.seconds_simulating =
          seconds_of_explicit_frame(simulation.world, *forecast.plan) + (coarse ? coarse->seconds : 0);
    } else {
      forecast.seconds_simulating =
          coarse ? coarse->seconds : seconds_of_implicit_frame(simulation.world, *forecast.plan);
    }
  }
  forecast.seconds_drawing = seconds_a_picture(simulation, film);
  return forecast;
}

void warn_of_memory(const Simulation& simulation, const Film& film, const Console& console) {
  const std::string warning = warning_of_memory(memory_forecast(simulation, film));
  if (!warning.empty()) console.warn(warning);
}

}  // namespace sprung
