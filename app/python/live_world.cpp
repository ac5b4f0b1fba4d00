#include "app/python/live_world.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <type_traits>

#include "core/dynamics/explicit/integrator.h"
#include "core/error.h"
#include "core/simulation/body_loads.h"
#include "core/simulation/drivers.h"
#include "core/simulation/equilibria.h"
#include "core/simulation/observer.h"
#include "core/simulation/skin_supports.h"
#include "render/renderer.h"

namespace sprung {
namespace {

// Otherwise a growing vector would copy the bodies, and views would dangle.
static_assert(std::is_nothrow_move_constructible_v<SoftBody>);

constexpr double kBrickStepsBetween = 2e6;

void check(bool is_right, std::string_view name, double value, std::string_view range) {
  if (!is_right) throw Error(ErrorKind::kBadInput, fmt::format("{} is {:g}; it must be {}", name, value, range));
}

void check_finite(const Vec3& vector, std::string_view name) {
  for (const double value : vector) check(std::isfinite(value), name, value, "three finite numbers");
}

}  // namespace

LiveWorld::LiveWorld(const Vec3& gravity, std::optional<double> ground) {
  check_finite(gravity, "gravity (m/s2)");
  scene_.gravity = gravity;
  if (ground) {
    check(std::isfinite(*ground), "ground (m)", *ground, "a finite height, or None");
    scene_.obstacles.emplace_back().plane = Plane{.y = *ground};
  }
  simulation_ = build_world(scene_, {}, Observer());
}

LiveWorld::LiveWorld(Scene scene) : scene_(std::move(scene)) { simulation_ = prepare_simulation(scene_, Observer()); }

std::vector<std::size_t> LiveWorld::add(const SceneBody& body) {
  check_finite(body.position, "position (m)");
  const LoadedBody loaded = load_body(body, Observer());
  const std::size_t first = body_count();
  scene_.bodies.push_back(body);
  motion_.reset();
  try {
    add_bodies(scene_, scene_.bodies.size() - 1, {loaded}, simulation_, Observer());
  } catch (...) {
    scene_.bodies.pop_back();
    simulation_.world.bodies.erase(simulation_.world.bodies.begin() + long(first), simulation_.world.bodies.end());
    simulation_.origins.resize(simulation_.world.bodies.size());
    throw;
  }
  std::vector<std::size_t> rows;
  for (std::size_t row = first; row < body_count(); ++row) rows.push_back(row);
  return rows;
}

SceneMotion& LiveWorld::motion() {
  if (!motion_) {
    motion_.emplace(simulation_, scene_);
  }
  return *motion_;
}

template <class Work>
void LiveWorld::keep_memory(const Work& work) {
  struct State {
    Points positions;
    Points velocities;
  };
  std::vector<State> kept;  // the old memory, which views refer to
  const auto put_back = [&] {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      simulation_.world.bodies[i].positions = std::move(kept[i].positions);
      simulation_.world.bodies[i].velocities = std::move(kept[i].velocities);
    }
  };
  try {
    for (SoftBody& body : simulation_.world.bodies) {
      State copy{body.positions, body.velocities};
      std::swap(copy.positions, body.positions);
      std::swap(copy.velocities, body.velocities);
      kept.push_back(std::move(copy));
    }
    work();
  } catch (...) {
    put_back();
    throw;
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    kept[i].positions = simulation_.world.bodies[i].positions;  // a copy into the same memory
    kept[i].velocities = simulation_.world.bodies[i].velocities;
  }
  put_back();
}

void LiveWorld::advance(double duration, const Between& between) {
  check(duration >= 0 && std::isfinite(duration), "duration (s)", duration, "0 or above");
  if (!is_motion(scene_)) {
    throw Error(ErrorKind::kBadInput, "the scene is no motion (solver.scheme): simulate() finds its states of rest");
  }
  if (duration == 0) return;
  try {
    keep_memory([&] {
      motion().advance(
          time_, time_ + duration, duration, [&](double) { between(); }, [](const std::string&) {});
    });
  } catch (...) {
    motion_.reset();
    throw;
  }
  time_ += duration;
}

void LiveWorld::step(double dt, long count, const Between& between) {
  check(dt > 0 && std::isfinite(dt), "dt (s)", dt, "above 0");
  check(count >= 0, "count", double(count), "0 or above");
  World& world = simulation_.world;
  double bricks = 0;
  for (const SoftBody& body : world.bodies) bricks += body.grid.brick_count();
  const long at_once = std::max(1L, long(kBrickStepsBetween / std::max(1.0, bricks)));
  const double stable = stable_step();
  const auto steps = [&] {
    for (long done = 0; done < count; done += at_once) {
      const double time = time_ + dt * double(done);
      sprung::advance(world, Scheme::kSymplecticEuler, dt, std::min(at_once, count - done), time);
      between();
    }
  };
  try {
    keep_memory(steps);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kDiverged || dt <= stable) throw;
    throw Error(error.kind(),
                fmt::format("steps of {:.4g} s are too long, up to {:.4g} s are stable; {}", dt, stable, error.what()));
  }
  time_ += dt * double(count);
}

void LiveWorld::settle(std::size_t row, bool linear, const Between& between) {
  SoftBody& body = simulation_.world.bodies[row];
  if (body.pinned.empty() && simulation_.origins[row].pinned_skins.empty()) {
    throw Error(ErrorKind::kBadInput, "a body without pinned nodes has no equilibrium: pin() some of them first");
  }
  if (const std::vector<MotionOnly> parts = motion_only(scene_); !parts.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("settle() cannot take into account {}; use advance()", parts.front().what));
  }
  keep_memory([&] {
    int newton_steps = 0;
    const Loads loads = loads_and_weight(scene_, simulation_, row, forced_wholes(scene_, simulation_.origins)[row]);
    const Points movements = body.positions - body.rest_positions;
    static_cast<void>(sprung::settle(body, supports_of(body), loads, movements, linear, *make_default_solver(),
                                     newton_steps, between));
    body.velocities.setZero();
  });
}

void LiveWorld::pin(std::size_t row, const std::vector<long>& nodes) {
  SoftBody& body = simulation_.world.bodies[row];
  const int count = body.node_count();
  std::vector<bool> is_pinned(count);
  for (const long node : nodes) {
    if (node < 0 || node >= count) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("there is no node {} to pin: the body's nodes are 0 to {}", node, count - 1));
    }
    is_pinned[node] = true;
  }
  body.pinned.clear();
  for (int node = 0; node < count; ++node) {
    if (!is_pinned[node]) continue;
    body.pinned.push_back({.node = node});
    body.velocities.row(node).setZero();
  }
}

Points LiveWorld::skin_positions(std::size_t row) const {
  const SoftBody& body = simulation_.world.bodies[row];
  return body.skin_positions(body.positions);
}

Image LiveWorld::draw(int width, int height, double azimuth, double elevation) const {
  const std::vector<SoftBody>& bodies = simulation_.world.bodies;
  if (bodies.empty()) throw Error(ErrorKind::kBadInput, "there is nothing to draw: add() a mesh first");
  check(std::isfinite(azimuth), "azimuth (degrees)", azimuth, "finite");
  check(elevation >= -85 && elevation <= 85, "elevation (degrees)", elevation, "from -85 to 85");
  Stage stage;
  std::vector<SkinShape> shapes;
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    const SoftBody& body = bodies[row];
    const Points positions = skin_positions(row);
    if (!positions.allFinite()) {
      throw Error(ErrorKind::kBadInput, fmt::format("body {} has a position that is not finite: nothing to draw", row));
    }
    const Points normals = deform_normals(body.grid, body.drawn.embedding, body.drawn.skin.normals, body.positions);
    shapes.push_back({positions.cast<float>(), normals.cast<float>()});
    stage.skins.push_back(&body.drawn.skin);
    stage.default_colors.emplace_back(0.85F, 0.2F, 0.16F);
    stage.bounds.extend(bounding_box(positions));
  }
  const std::optional<double> ground = ground_height(simulation_.world.obstacles);
  stage.has_ground = ground.has_value();
  if (ground) stage.ground.height = *ground;
  Renderer renderer(stage, {.width = width, .height = height});
  return renderer.draw(shapes, frame_bounds(stage.bounds, double(width) / height, azimuth, elevation));
}

}  // namespace sprung
