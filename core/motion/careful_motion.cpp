#include "core/motion/careful_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/body/forces.h"
#include "core/motion/diverged.h"

namespace sprung {
namespace {

constexpr double kFurthestMove = 0.25;  // of a brick, in a step
constexpr int kMostHalvings = 4;
constexpr double kBrickStepsBetween = 2e6;
constexpr double kEnergyFromNowhere = 0.3;  // of what moves and strains a body, that a frame's rounding of time may add

/// What can be taken back.
struct State {
  Points positions;
  Points velocities;
};

std::vector<State> state_of(const World& world) {
  std::vector<State> states;
  for (const Actor& actor : world.actors) states.push_back({actor.body.positions, actor.body.velocities});
  return states;
}

void restore(const std::vector<State>& states, World& world) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    world.actors[i].body.positions = states[i].positions;
    world.actors[i].body.velocities = states[i].velocities;
  }
}

/// What is wrong with an actor, and the brick where it is worst.
struct Trouble {
  std::size_t actor;
  std::size_t brick;
  std::string what;
};

bool is_finite(const Body& body, std::size_t brick) {
  const auto& nodes = body.grid.nodes[brick];
  return std::all_of(nodes.begin(), nodes.end(), [&](int node) {
    return body.positions.row(node).allFinite() && body.velocities.row(node).allFinite();
  });
}

/// The first brick with a number that is not finite; else the one whose corners move fastest.
std::size_t worst_brick(const Body& body) {
  std::size_t worst = 0;
  double fastest = -1;
  for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
    if (!is_finite(body, brick)) return brick;
    double speed = 0;
    for (const int node : body.grid.nodes[brick]) speed = std::max(speed, body.velocities.row(node).squaredNorm());
    if (speed <= fastest) continue;
    fastest = speed;
    worst = brick;
  }
  return worst;
}

bool is_driven(const Actor& actor) {
  return std::any_of(actor.pinned.begin(), actor.pinned.end(),
                     [](const HeldNode& held) { return !held.velocity.isZero(); });
}

/// The ground and what holds a body still take energy and give none, but for lifting what starts a little too deep.
bool has_gained(const Energy& before, const Energy& after, const Actor& actor, const Vec3& gravity) {
  const Body& body = actor.body;
  const double moving = std::max(before.kinetic + before.elastic, after.kinetic + after.elastic);
  const double lift = body.masses.sum() * gravity.norm() * body.grid.brick_size;
  const double rounding = 1e-12 * body.material.young * body.grid.volume();
  return after.sum() - before.sum() > kEnergyFromNowhere * moving + lift + rounding;
}

std::optional<Trouble> find_trouble(const World& world, const std::vector<Energy>& before) {
  for (std::size_t i = 0; i < world.actors.size(); ++i) {
    const Actor& actor = world.actors[i];
    const Body& body = actor.body;
    if (!body.positions.allFinite() || !body.velocities.allFinite()) {
      return Trouble{i, worst_brick(body), "a number that is not finite"};
    }
    if (is_driven(actor)) continue;
    const Energy after = energy_of(body, world.gravity);
    if (!has_gained(before[i], after, actor, world.gravity)) continue;
    return Trouble{i, worst_brick(body),
                   fmt::format("energy from nowhere, {:.3g} J more than {:.3g} J", after.sum() - before[i].sum(),
                               before[i].kinetic + before[i].elastic)};
  }
  return std::nullopt;
}

/// "body 1, brick 12 at (0.1, 0.02, 0) m at rest".
std::string place_of(const World& world, const Trouble& trouble) {
  const Body& body = world.actors[trouble.actor].body;
  Vec3 middle = Vec3::Zero();
  for (const int node : body.grid.nodes[trouble.brick]) middle += body.rest_positions.row(node).transpose() / 8;
  return fmt::format("body {}, brick {} at ({:.4g}, {:.4g}, {:.4g}) m at rest", trouble.actor + 1, trouble.brick + 1,
                     middle.x(), middle.y(), middle.z());
}

}  // namespace

Energy energy_of(const Body& body, const Vec3& gravity) {
  return {.kinetic = kinetic_energy(body),
          .elastic = std::max(0.0, elastic_energy(body)),  // far from its rest a folded brick's can be negative
          .potential = -body.masses.dot(body.positions * gravity)};
}

std::vector<Steps> choose_steps(const World& world, double time) {
  std::vector<Steps> all;
  for (const Actor& actor : world.actors) {
    double step = stable_step(actor.body);
    const double speed = std::sqrt(actor.body.velocities.rowwise().squaredNorm().maxCoeff());
    const double most = speed + world.gravity.norm() * time;
    if (world.ground && most > 0) step = std::min(step, kFurthestMove * actor.body.grid.brick_size / most);
    const long count = std::max(1L, static_cast<long>(std::ceil(time / step)));
    all.push_back({.count = count, .dt = time / static_cast<double>(count)});
  }
  return all;
}

bool CarefulMotion::run(std::span<const Steps> steps, double time, const Between& between) {
  double brick_steps = 0;
  long chunks = std::numeric_limits<long>::max();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    brick_steps += static_cast<double>(steps[i].count) * world_.actors[i].body.grid.brick_count();
    chunks = std::min(chunks, steps[i].count);
  }
  chunks = std::clamp(static_cast<long>(std::ceil(brick_steps / kBrickStepsBetween)), 1L, chunks);
  std::vector<Steps> chunk(steps.begin(), steps.end());
  for (long done = 0; done < chunks; ++done) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      chunk[i].count = steps[i].count * (done + 1) / chunks - steps[i].count * done / chunks;
    }
    try {
      advance(world_, scheme_, chunk, time);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kDiverged) throw;
      return false;
    }
    between(static_cast<double>(done + 1) / static_cast<double>(chunks));
  }
  return true;
}

std::vector<Steps> CarefulMotion::advance_frame(double time, double duration, const Between& between,
                                                const Tell& tell) {
  const std::vector<State> start = state_of(world_);
  std::vector<Energy> before;
  for (const Actor& actor : world_.actors) before.push_back(energy_of(actor.body, world_.gravity));
  const std::vector<Steps> stable = choose_steps(world_, duration);
  while (true) {
    const long parts = 1L << halvings_;
    std::vector<Steps> steps = stable;
    for (Steps& of_actor : steps) of_actor = {of_actor.count * parts, of_actor.dt / static_cast<double>(parts)};
    const bool is_through = run(steps, time, between);
    const std::optional<Trouble> trouble = find_trouble(world_, before);
    if (is_through && !trouble) return steps;
    const std::string what = fmt::format("{} between t = {:.6g} s and {:.6g} s: {}", place_of(world_, *trouble), time,
                                         time + duration, trouble->what);
    restore(start, world_);
    if (halvings_ == kMostHalvings) {
      throw Diverged(trouble->actor,
                     what + fmt::format(", with steps of {:.3g} s too: the motion diverged; use more bricks, a stiffer "
                                        "material, more damping or a shorter fall",
                                        steps[trouble->actor].dt));
    }
    ++halvings_;
    tell(what + fmt::format("; the frame is done again in steps half as long, {:.3g} s", steps[trouble->actor].dt / 2));
  }
}

}  // namespace sprung
