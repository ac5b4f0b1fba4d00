#include "core/dynamics/explicit/adaptive_integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/body/forces.h"
#include "core/contact/broad_phase.h"
#include "core/dynamics/divergence.h"
#include "core/dynamics/energy.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kFurthestMove = 0.25;  // of a brick, in a step
constexpr int kMaxHalvings = 4;
constexpr double kBrickStepsBetween = 2e6;
constexpr double kMaxSteps = 1e12;  // at a time: more than anyone would wait for

/// State that can be restored.
struct State {
  Points positions;
  Points velocities;
};

std::vector<State> state_of(const World& world) {
  std::vector<State> states;
  for (const SoftBody& body : world.bodies) states.push_back({body.positions, body.velocities});
  return states;
}

void restore(const std::vector<State>& states, World& world) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    world.bodies[i].positions = states[i].positions;
    world.bodies[i].velocities = states[i].velocities;
  }
}

/// The fault of a body, and the brick where it is worst.
struct Trouble {
  std::size_t body;
  std::size_t brick;
  std::string what;
};

std::optional<Trouble> find_trouble(const World& world, const std::vector<Energy>& before,
                                    std::span<const GroupSteps> groups) {
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    if (body.positions.allFinite() && body.velocities.allFinite()) continue;
    return Trouble{i, worst_brick_of(body), "a number that is not finite"};
  }
  const std::vector<Energy> after = energies_of(world);
  for (const GroupSteps& group : groups) {
    std::string gain = energy_gain(world, group.bodies, before, after);
    if (gain.empty()) continue;
    const std::size_t worst =
        *std::max_element(group.bodies.begin(), group.bodies.end(), [&](std::size_t a, std::size_t b) {
          return after[a].sum() - before[a].sum() < after[b].sum() - before[b].sum();
        });
    return Trouble{worst, worst_brick_of(world.bodies[worst]), std::move(gain)};
  }
  return std::nullopt;
}

/// "body 1, brick 12 at (0.1, 0.02, 0) m at rest".
std::string location_of(const World& world, const Trouble& trouble) {
  const Body& body = world.bodies[trouble.body];
  Vec3 middle = Vec3::Zero();
  for (const int node : body.grid.nodes[trouble.brick]) middle += body.rest_positions.row(node).transpose() / 8;
  return fmt::format("body {}, brick {} at ({:.4g}, {:.4g}, {:.4g}) m at rest", trouble.body + 1, trouble.brick + 1,
                     middle.x(), middle.y(), middle.z());
}

/// s, that a body took.
double step_of(std::span<const GroupSteps> groups, std::size_t body) {
  const auto group = std::find_if(groups.begin(), groups.end(), [&](const GroupSteps& one) {
    return std::find(one.bodies.begin(), one.bodies.end(), body) != one.bodies.end();
  });
  return group->steps.dt;
}

}  // namespace

std::vector<GroupSteps> choose_steps(const World& world, double time) {
  std::vector<GroupSteps> groups;
  double carried = 0;  // m/s, by obstacles
  for (const Obstacle& obstacle : world.obstacles) carried = std::max(carried, obstacle.velocity.norm());
  for (std::vector<std::size_t>& bodies : contact_groups(world, time)) {
    double step = stable_step(world, bodies);
    double brick = std::numeric_limits<double>::infinity();
    double speed = 0;
    for (const std::size_t i : bodies) {
      const Body& body = world.bodies[i];
      brick = std::min(brick, body.grid.brick_size);
      speed = std::max(speed, largest_speed(body));
    }
    const double most = speed + carried + world.gravity.norm() * time;
    const bool can_meet = !world.obstacles.empty() || bodies.size() > 1;
    if (can_meet && most > 0) step = std::min(step, kFurthestMove * brick / most);
    if (!(time / step <= kMaxSteps)) {
      throw Diverged(bodies.front(),
                     fmt::format("body {} moves at {:.3g} m/s, which would take too many time steps: "
                                 "the motion diverged; use slower bodies, larger bricks or less gravity",
                                 bodies.front() + 1, speed));
    }
    groups.push_back({.bodies = std::move(bodies), .steps = equal_steps(time, step)});
  }
  return groups;
}

double brick_steps_of(const World& world, std::span<const GroupSteps> groups) {
  double sum = 0;
  for (const GroupSteps& group : groups) {
    for (const std::size_t row : group.bodies) {
      sum += double(group.steps.count) * world.bodies[row].grid.brick_count();
    }
  }
  return sum;
}

void AdaptiveIntegrator::begin_contacts(std::span<const GroupSteps> groups) {
  std::vector<std::vector<std::size_t>> bodies;
  for (const GroupSteps& group : groups) bodies.push_back(group.bodies);
  contacts_.begin_frame(world_, bodies);
}

std::optional<Diverged> AdaptiveIntegrator::run(std::span<GroupSteps> groups, double time, const Between& between) {
  long chunks = std::numeric_limits<long>::max();
  for (const GroupSteps& group : groups) chunks = std::min(chunks, group.steps.count);
  chunks = std::clamp(long(std::ceil(brick_steps_of(world_, groups) / kBrickStepsBetween)), 1L, chunks);
  std::vector<GroupSteps> chunk(groups.begin(), groups.end());
  std::vector<Steps> planned;
  for (GroupSteps& group : groups) planned.push_back(std::exchange(group.steps, {.count = 0, .dt = group.steps.dt}));
  for (long done = 0; done < chunks; ++done) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const Steps& all = planned[i];
      const long first = all.count * done / chunks;
      const long count = all.count * (done + 1) / chunks - first;
      chunk[i].steps = {.count = count, .dt = all.dt};
      if (groups[i].steps.dt < all.dt) {  // as short as they became before
        chunk[i].steps = equal_steps(double(count) * all.dt, groups[i].steps.dt);
      }
      chunk[i].elapsed = all.dt * double(first);
    }
    try {
      advance(world_, scheme_, chunk, time, contacts_);
    } catch (const Diverged& error) {
      return error;
    }
    for (std::size_t i = 0; i < groups.size(); ++i) {
      groups[i].steps.count += chunk[i].steps.count;
      groups[i].steps.dt = std::min(groups[i].steps.dt, chunk[i].steps.dt);
    }
    between(double(done + 1) / double(chunks));
  }
  return std::nullopt;
}

std::vector<GroupSteps> AdaptiveIntegrator::advance_frame(double time, double duration, const Between& between,
                                                          const Tell& tell) {
  const std::vector<State> start = state_of(world_);
  const std::vector<Energy> before = energies_of(world_);
  const std::vector<GroupSteps> stable = choose_steps(world_, duration);
  while (true) {
    const long parts = 1L << halvings_;
    std::vector<GroupSteps> groups = stable;
    for (GroupSteps& group : groups) {
      group.steps = {group.steps.count * parts, group.steps.dt / double(parts)};
      group.share = 1 / double(parts);
    }
    begin_contacts(groups);
    const std::optional<Diverged> end = run(groups, time, between);
    std::optional<Trouble> trouble = find_trouble(world_, before, groups);
    if (end && !trouble) trouble = Trouble{end->body(), worst_brick_of(world_.bodies[end->body()]), end->what()};
    if (!trouble) {
      move_prescribed(world_, duration);
      return groups;
    }
    const std::string what = fmt::format("{} between t = {:.6g} s and {:.6g} s: {}", location_of(world_, *trouble),
                                         time, time + duration, trouble->what);
    restore(start, world_);
    const double dt = step_of(groups, trouble->body);
    if (halvings_ == kMaxHalvings) {
      throw Diverged(trouble->body,
                     what + fmt::format(", even with a time step of {:.3g} s: the motion diverged; {}", dt,
                                        advice_for_divergence(world_, trouble->body, trouble->brick)));
    }
    ++halvings_;
    tell(what + fmt::format("; the frame is repeated with half the time step, {:.3g} s", dt / 2));
  }
}

}  // namespace sprung
