#include "core/dynamics/energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/body/forces.h"

namespace sprung {
namespace {

constexpr double kMaxGain = 0.3;  // of kinetic and strain energy, that a frame's time discretisation may add

/// Whether something that may add energy moves it.
bool is_driven(const SoftBody& body) {
  if (!body.loads.empty()) return true;
  const auto moves = [](const auto& held) { return !held.velocity.isZero(); };
  if (std::any_of(body.pinned.begin(), body.pinned.end(), moves)) return true;
  const std::vector<SpringSupport> supports = body.supports_after(0);
  return std::any_of(supports.begin(), supports.end(), moves);
}

Energy sum_of(const std::vector<Energy>& all, std::span<const std::size_t> bodies) {
  Energy sum;
  for (const std::size_t i : bodies) {
    sum.kinetic += all[i].kinetic;
    sum.elastic += all[i].elastic;
    sum.potential += all[i].potential;
  }
  return sum;
}

bool has_gained(const Energy& before, const Energy& after, const World& world, std::span<const std::size_t> bodies) {
  const double moving = std::max(before.kinetic + before.elastic, after.kinetic + after.elastic);
  double slack = 0;
  for (const std::size_t i : bodies) {
    const Body& body = world.bodies[i];
    slack += body.masses.sum() * world.gravity.norm() * body.grid.brick_size;  // lift
    slack += 1e-12 * body.material.young * body.grid.volume();                 // rounding
  }
  const double gain = after.sum() - before.sum();
  return !std::isfinite(gain) || gain > kMaxGain * moving + slack;
}

}  // namespace

Energy energy_of(const Body& body, const Vec3& gravity) {
  return {.kinetic = kinetic_energy(body),
          .elastic = std::max(0.0, elastic_energy(body)),  // far from rest a folded brick's can be negative
          .potential = -body.masses.dot(body.positions * gravity)};
}

namespace {

Energy energy_with_foundations(const SoftBody& body, const Vec3& gravity) {
  Energy energy = energy_of(body, gravity);
  energy.elastic += support_energy(body.supports_after(0), body, body.positions - body.rest_positions);
  return energy;
}

}  // namespace

std::vector<Energy> energies_of(const World& world) {
  std::vector<Energy> all;
  for (const SoftBody& body : world.bodies) all.push_back(energy_with_foundations(body, world.gravity));
  return all;
}

std::vector<Energy> energies_of(const World& world, std::span<const std::size_t> bodies) {
  std::vector<Energy> some(world.bodies.size());
  for (const std::size_t i : bodies) some[i] = energy_with_foundations(world.bodies[i], world.gravity);
  return some;
}

std::string energy_gain(const World& world, std::span<const std::size_t> bodies, const std::vector<Energy>& before,
                        const std::vector<Energy>& after) {
  if (std::any_of(world.obstacles.begin(), world.obstacles.end(),
                  [](const Obstacle& one) { return one.is_moving(); }) ||
      world.wind.blows() ||
      std::any_of(bodies.begin(), bodies.end(), [&](std::size_t i) { return is_driven(world.bodies[i]); })) {
    return "";
  }
  const Energy start = sum_of(before, bodies);
  const Energy end = sum_of(after, bodies);
  if (!has_gained(start, end, world, bodies)) return "";
  return fmt::format("spurious energy gain, {:.3g} J more than {:.3g} J", end.sum() - start.sum(),
                     start.kinetic + start.elastic);
}

}  // namespace sprung
