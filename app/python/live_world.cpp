#include "app/python/live_world.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <type_traits>

#include "core/contact/inversion_guard.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "core/simulation/drivers.h"
#include "render/renderer.h"

namespace sprung {
namespace {

// Else a vector of actors that grows would copy them, and leave views behind in memory that is gone.
static_assert(std::is_nothrow_move_constructible_v<Actor>);

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
  world_.gravity = gravity;
  if (!ground) return;
  check(std::isfinite(*ground), "ground (m)", *ground, "a finite height, or None");
  world_.obstacles.push_back(level_ground(*ground));
}

std::vector<std::size_t> LiveWorld::add(SurfaceMesh mesh, const std::string& name, const FillOptions& options) {
  check(std::isfinite(options.size), "size (m)", options.size, "finite");
  check_finite(options.position, "position (m)");
  std::vector<std::size_t> rows;
  for (SoftBody& body : fill_mesh(std::move(mesh), name, options)) {
    rows.push_back(world_.actors.size());
    drawn_.push_back({std::move(body.skin), std::move(body.embedding), body.actor.body.law.guard});
    world_.actors.push_back(std::move(body.actor));
  }
  is_braced_ = false;
  return rows;
}

template <class Work>
void LiveWorld::keep_memory(const Work& work) {
  struct State {
    Points positions;
    Points velocities;
  };
  std::vector<State> kept;  // where others look, as it was
  const auto put_back = [&] {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      world_.actors[i].body.positions = std::move(kept[i].positions);
      world_.actors[i].body.velocities = std::move(kept[i].velocities);
    }
  };
  try {
    for (Actor& actor : world_.actors) {
      State copy{actor.body.positions, actor.body.velocities};
      std::swap(copy.positions, actor.body.positions);
      std::swap(copy.velocities, actor.body.velocities);
      kept.push_back(std::move(copy));
    }
    work();
  } catch (...) {
    put_back();
    throw;
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    kept[i].positions = world_.actors[i].body.positions;  // into the same memory
    kept[i].velocities = world_.actors[i].body.velocities;
  }
  put_back();
}

void LiveWorld::stiffen_volume_guards() {
  if (is_braced_) return;
  is_braced_ = true;
  const double speed = impact_speed(world_);
  for (std::size_t row = 0; row < drawn_.size(); ++row) {
    Body& body = world_.actors[row].body;
    body.law.guard = drawn_[row].guard;
    stiffen_volume_guard(body, world_.gravity.norm(), speed);
  }
}

void LiveWorld::advance(double duration, const Between& between) {
  check(duration >= 0 && std::isfinite(duration), "duration (s)", duration, "0 or above");
  if (duration == 0) return;
  stiffen_volume_guards();
  AdaptiveIntegrator motion(world_, Scheme::kSymplecticEuler);
  keep_memory([&] {
    motion.advance_frame(
        time_, duration, [&](double) { between(); }, [](const std::string&) {});
  });
  time_ += duration;
}

void LiveWorld::step(double dt, long count, const Between& between) {
  check(dt > 0 && std::isfinite(dt), "dt (s)", dt, "above 0");
  check(count >= 0, "count", double(count), "0 or above");
  stiffen_volume_guards();
  double bricks = 0;
  for (const Actor& actor : world_.actors) bricks += actor.body.grid.brick_count();
  const long at_once = std::max(1L, long(kBrickStepsBetween / std::max(1.0, bricks)));
  const double stable = stable_step();
  const auto steps = [&] {
    for (long done = 0; done < count; done += at_once) {
      const double time = time_ + dt * double(done);
      sprung::advance(world_, Scheme::kSymplecticEuler, dt, std::min(at_once, count - done), time);
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

void LiveWorld::settle(std::size_t row, bool linear) {
  Actor& actor = world_.actors[row];
  if (actor.pinned.empty()) {
    throw Error(ErrorKind::kBadInput, "a body without pinned nodes cannot come to rest: pin() some of them first");
  }
  keep_memory([&] {
    Body& body = actor.body;
    const Supports supports = supports_of(actor);
    const Points loads = body.masses * world_.gravity.transpose();
    const std::unique_ptr<LinearSolver> system = make_default_solver();
    if (linear) {
      const Points still = Points::Zero(body.node_count(), 3);
      body.positions = body.rest_positions;
      body.positions += linear_response(body, supports, loads, still, *system).displacements;
    } else {
      const Points start = body.positions;
      solve_static(body, supports, loads, start, *system);
    }
    body.velocities.setZero();
  });
}

void LiveWorld::pin(std::size_t row, const std::vector<long>& nodes) {
  Actor& actor = world_.actors[row];
  const int count = actor.body.node_count();
  std::vector<bool> is_held(count);
  for (const long node : nodes) {
    if (node < 0 || node >= count) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("there is no node {} to pin: the body's nodes are 0 to {}", node, count - 1));
    }
    is_held[node] = true;
  }
  actor.pinned.clear();
  for (int node = 0; node < count; ++node) {
    if (!is_held[node]) continue;
    actor.pinned.push_back({.node = node});
    actor.body.velocities.row(node).setZero();
  }
}

Points LiveWorld::skin_positions(std::size_t row) const {
  const Body& body = world_.actors[row].body;
  return deform_points(body.grid, drawn_[row].embedding, body.positions);
}

Image LiveWorld::draw(int width, int height, double azimuth, double elevation) const {
  if (drawn_.empty()) throw Error(ErrorKind::kBadInput, "there is nothing to draw: add() a mesh first");
  check(std::isfinite(azimuth), "azimuth (degrees)", azimuth, "finite");
  check(elevation >= -85 && elevation <= 85, "elevation (degrees)", elevation, "from -85 to 85");
  Stage stage;
  std::vector<SkinShape> shapes;
  for (std::size_t row = 0; row < drawn_.size(); ++row) {
    const Drawn& drawn = drawn_[row];
    const Body& body = world_.actors[row].body;
    const Points positions = skin_positions(row);
    if (!positions.allFinite()) {
      throw Error(ErrorKind::kBadInput, fmt::format("body {} has a position that is not finite: nothing to draw", row));
    }
    const Points normals = deform_normals(body.grid, drawn.embedding, drawn.skin.normals, body.positions);
    shapes.push_back({positions.cast<float>(), normals.cast<float>()});
    stage.skins.push_back(&drawn.skin);
    stage.default_colors.emplace_back(0.85F, 0.2F, 0.16F);
    stage.bounds.include(positions);
  }
  const std::optional<double> ground = ground_height(world_.obstacles);
  stage.has_ground = ground.has_value();
  if (ground) stage.ground.height = *ground;
  Renderer renderer(stage, {.width = width, .height = height});
  return renderer.draw(shapes, frame_bounds(stage.bounds, double(width) / height, azimuth, elevation));
}

}  // namespace sprung
