#include "app/inspect/forecast.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <numeric>

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

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool is_implicit(const Film& film, const World& world) {
  return !is_motion(film) || plan_steps(world, film).is_implicit();
}

/// How the time that a run takes grows with the part of the film that is done.
class RunClock : public Observer {
 public:
  /// Ends the run after so many seconds.
  explicit RunClock(double seconds_at_most) : seconds_at_most_(seconds_at_most) {}

  void show(const Progress& progress) const override {
    if (progress.name() != "simulate") return;
    shares_.push_back(progress.done() / progress.total());
    seconds_.push_back(progress.seconds());
    if (seconds_.back() > seconds_at_most_) throw Error(ErrorKind::kFailed, "enough of the motion is timed");
  }

  /// Of the film.
  [[nodiscard]] double share() const { return shares_.empty() ? 0 : shares_.back(); }

  [[nodiscard]] double seconds() const { return seconds_.empty() ? 0 : seconds_.back(); }

  /// Seconds of the frames that are whole, of `count` after the first one.
  [[nodiscard]] std::vector<double> frames(int count) const {
    std::vector<double> seconds;
    double before = 0;
    for (int frame = 1; frame <= count && double(frame) / count <= share() + kRounding; ++frame) {
      const double until = seconds_until(double(frame) / count);
      seconds.push_back(until - before);
      before = until;
    }
    return seconds;
  }

 private:
  static constexpr double kRounding = 1e-9;

  [[nodiscard]] double seconds_until(double share) const {
    const auto after = std::lower_bound(shares_.begin(), shares_.end(), share);
    if (after == shares_.begin()) return 0;
    if (after == shares_.end()) return seconds_.back();
    const std::size_t end = std::size_t(after - shares_.begin());
    const double along = (share - shares_[end - 1]) / (shares_[end] - shares_[end - 1]);
    return seconds_[end - 1] + along * (seconds_[end] - seconds_[end - 1]);
  }

  double seconds_at_most_;
  mutable std::vector<double> shares_;
  mutable std::vector<double> seconds_;
};

/// The scene with bricks twice as large.
Film coarsened(Film scene) {
  constexpr int kMinBricks = 4;
  for (SceneBody& body : scene.bodies) {
    if (body.brick_size) *body.brick_size *= 2;
    if (body.bricks && !body.bricks->is_auto()) body.bricks->along = std::max(kMinBricks, body.bricks->along / 2);
    if (!body.bricks && !body.brick_size) body.bricks = kDefaultBricks / 2;
  }
  return scene;
}

/// The frames of a run that ends within the time of the clock; none if it does not.
std::optional<int> frames_of_run(Simulation simulation, const Film& film, const RunClock& clock) {
  try {
    return int(simulate(simulation, film, clock).progress.size());
  } catch (const Error&) {
    return std::nullopt;
  }
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// Of the last third.
double late_mean(const std::vector<double>& values) {
  const auto third = std::max<std::ptrdiff_t>(1, std::ssize(values) / 3);
  return std::accumulate(values.end() - third, values.end(), 0.0) / double(third);
}

/// Appends to the seconds of a film's first frames those of the frames that follow in the same film with bricks twice
/// as large. Without contact a frame takes what the quickest one takes. What it takes beyond that, for contact, grows
/// in proportion.
void append_like(const std::vector<double>& coarse, std::vector<double>& seconds) {
  constexpr double kOfContact = 0.2;  // of the time of the frames that both have: the least that tells its growth
  constexpr double kGrowth = 3;       // otherwise; 1.6 to 5.2 in the project's scenes
  if (coarse.size() <= seconds.size()) return;
  const double free = *std::min_element(seconds.begin(), seconds.end());
  const double coarse_free = *std::min_element(coarse.begin(), coarse.end());
  const double both = double(seconds.size());
  const double coarse_sum = std::accumulate(coarse.begin(), coarse.begin() + std::ssize(seconds), 0.0);
  const double coarse_contact = coarse_sum - both * coarse_free;
  const bool is_told = coarse_contact > kOfContact * coarse_sum;
  const double growth = is_told ? (sum(seconds) - both * free) / coarse_contact : kGrowth;
  for (std::size_t frame = seconds.size(); frame < coarse.size(); ++frame) {
    seconds.push_back(free + growth * (coarse[frame] - coarse_free));
  }
}

struct MotionTime {
  double seconds = 0;
  int frames = 0;  // fewer than the scene's if it comes to rest before
};

/// Of the whole motion: runs it, and if that takes long, runs it with larger bricks to see more of it. Frames after
/// those seen are like the last of them.
MotionTime time_motion(const Simulation& simulation, Film film) {
  constexpr double kSeconds = 3;
  constexpr double kCoarseSeconds = 4;
  film.probes.clear();
  const RunClock clock(kSeconds);
  if (const std::optional<int> frames = frames_of_run(simulation, film, clock)) return {clock.seconds(), *frames};
  const RunClock coarse_clock(kCoarseSeconds);
  std::optional<int> coarse_frames;
  try {
    const Film coarse = coarsened(film);
    coarse_frames = frames_of_run(prepare_simulation(coarse, Observer()), coarse, coarse_clock);
  } catch (const Error&) {  // bricks so large do not fit the scene
  }
  const int moves = frame_count(film) - 1;
  std::vector<double> seconds = clock.frames(moves);
  if (seconds.empty()) seconds.push_back(clock.seconds() / std::max(clock.share() * moves, 1e-3));
  append_like(coarse_clock.frames(moves), seconds);
  const int last = coarse_frames.value_or(moves + 1) - 1;
  return {sum(seconds) + late_mean(seconds) * std::max(0, last - int(seconds.size())), last + 1};
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
    const MotionTime motion = time_motion(simulation, film);
    forecast.frames = motion.frames;
    forecast.seconds_simulating = motion.seconds / motion.frames;
  }
  forecast.seconds_drawing = seconds_a_picture(simulation, film);
  return forecast;
}

void warn_of_memory(const Simulation& simulation, const Film& film, const Console& console) {
  const std::string warning = warning_of_memory(memory_forecast(simulation, film));
  if (!warning.empty()) console.warn(warning);
}

}  // namespace sprung
