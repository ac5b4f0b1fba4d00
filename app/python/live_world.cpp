#include "app/python/live_world.h"

#include "app/pin_movements.h"
#include "core/error.h"
#include "core/mesh/read_mesh.h"
#include "core/motion/linear_response.h"
#include "core/motion/statics.h"
#include "core/world/squeeze.h"
#include "render/renderer.h"

namespace sprung {

LiveWorld::LiveWorld(const Vec3& gravity, std::optional<double> ground) {
  world_.gravity = gravity;
  if (ground) world_.obstacles.push_back(level_ground(*ground));
}

std::vector<std::size_t> LiveWorld::add(const std::string& mesh, const FillOptions& options) {
  std::vector<std::size_t> rows;
  for (SoftBody& body : fill_mesh(read_mesh(mesh), mesh, options)) {
    rows.push_back(world_.actors.size());
    world_.actors.push_back(std::move(body.actor));
    drawn_.push_back({std::move(body.skin), std::move(body.embedding)});
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
  std::vector<State> seen;  // what others look at
  for (Actor& actor : world_.actors) {
    State& state = seen.emplace_back(State{std::move(actor.body.positions), std::move(actor.body.velocities)});
    actor.body.positions = state.positions;
    actor.body.velocities = state.velocities;
  }
  const auto give_back = [&] {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      Body& body = world_.actors[i].body;
      seen[i].positions = body.positions;  // into the same memory
      seen[i].velocities = body.velocities;
      body.positions = std::move(seen[i].positions);
      body.velocities = std::move(seen[i].velocities);
    }
  };
  try {
    work();
  } catch (...) {
    give_back();
    throw;
  }
  give_back();
}

void LiveWorld::brace_bodies() {
  if (is_braced_) return;
  is_braced_ = true;
  const double speed = meeting_speed(world_);
  for (Actor& actor : world_.actors) brace(actor.body, world_.gravity.norm(), speed);
}

void LiveWorld::advance(double duration) {
  brace_bodies();
  CarefulMotion motion(world_, Scheme::kSymplecticEuler);
  keep_memory([&] {
    motion.advance_frame(
        time_, duration, [](double) {}, [](const std::string&) {});
  });
  time_ += duration;
}

void LiveWorld::step(double dt, long count) {
  brace_bodies();
  keep_memory([&] { sprung::advance(world_, Scheme::kSymplecticEuler, dt, count, time_); });
  time_ += dt * static_cast<double>(count);
}

void LiveWorld::settle(std::size_t row, bool linear) {
  Actor& actor = world_.actors[row];
  if (actor.pinned.empty()) throw Error(ErrorKind::kBadInput, "a body without pinned nodes cannot come to rest");
  keep_memory([&] {
    Body& body = actor.body;
    const Supports supports = supports_of(actor);
    const Points loads = body.masses * world_.gravity.transpose();
    const std::unique_ptr<NewtonSystem> system = make_quick_system();
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

void LiveWorld::pin(std::size_t row, const std::vector<int>& nodes) {
  Actor& actor = world_.actors[row];
  actor.pinned.clear();
  for (const int node : nodes) {
    if (node < 0 || node >= actor.body.node_count()) throw Error(ErrorKind::kBadInput, "there is no such node to pin");
    actor.pinned.push_back({.node = node});
    actor.body.velocities.row(node).setZero();
  }
}

Points LiveWorld::skin_positions(std::size_t row) const {
  const Body& body = world_.actors[row].body;
  return deform_points(body.grid, drawn_[row].embedding, body.positions);
}

Image LiveWorld::draw(int width, int height, double azimuth, double elevation) const {
  Stage stage;
  std::vector<SkinShape> shapes;
  for (std::size_t row = 0; row < drawn_.size(); ++row) {
    const auto& [skin, embedding] = drawn_[row];
    const Body& body = world_.actors[row].body;
    const Points positions = skin_positions(row);
    const Points normals = deform_normals(body.grid, embedding, skin.normals, body.positions);
    shapes.push_back({positions.cast<float>(), normals.cast<float>()});
    stage.skins.push_back(&skin);
    stage.default_colors.emplace_back(0.85F, 0.2F, 0.16F);
    stage.bounds.include(positions);
  }
  const std::optional<double> ground = ground_height(world_.obstacles);
  stage.has_ground = ground.has_value();
  if (ground) stage.ground.height = *ground;
  Renderer renderer(stage, {.width = width, .height = height});
  return renderer.draw(shapes, frame_bounds(stage.bounds, static_cast<double>(width) / height, azimuth, elevation));
}

}  // namespace sprung
