#include "core/dynamics/divergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/contact/penetration.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr double kDeep = 0.1;         // bricks
constexpr double kFast = 0.5;         // of the speed of sound
constexpr double kStiffForMass = 50;  // times that of most bricks

std::string length(double value) { return readable(value, Dimension::kLength); }

std::string remedy_for_overlaps(const World& world, std::size_t index) {
  const SoftBody& body = world.bodies[index];
  const double deep = kDeep * body.grid.brick_size;
  for (std::size_t row = 0; row < world.obstacles.size(); ++row) {
    const double depth = penetration_depth(world.obstacles[row], body);
    if (depth > 5 * deep) {
      return fmt::format("it lies {} deep in obstacle {}: move them apart, or the obstacle more slowly", length(depth),
                         row + 1);
    }
  }
  for (std::size_t other = 0; world.bodies_collide && other < world.bodies.size(); ++other) {
    if (other == index) continue;
    const double depth =
        std::max(penetration_depth(world.bodies[other], body), penetration_depth(body, world.bodies[other]));
    if (depth <= deep) continue;
    return fmt::format(
        "bodies {} and {} lie {} deep in each other: move them apart at the start, or let bodies not "
        "touch each other ([contact] bodies = false)",
        std::min(index, other) + 1, std::max(index, other) + 1, length(depth));
  }
  return "";
}

std::string remedy_for_speed(const SoftBody& body) {
  const double speed = body.velocities.rowwise().norm().maxCoeff();
  const double sound = std::sqrt(body.material.young / body.material.density);
  if (!(speed > kFast * sound)) return "";
  return fmt::format(
      "it moves at {:.3g} m/s, where sound in its material moves at {:.3g} m/s: use a lower speed, spin "
      "or fall, or a stiffer material (young)",
      speed, sound);
}

std::string remedy_for_inversion(const SoftBody& body) {
  const int inverted = inverted_bricks(body);
  if (inverted == 0) return "";
  return fmt::format(
      "{} of its {} bricks are inverted: use a stiffer or lighter material (young, density) or a "
      "smaller body",
      inverted, body.grid.brick_count());
}

/// Stiffness of a brick over the mass of its lightest corner, up to a factor common to the body.
double stiffness_for_mass(const SoftBody& body, std::size_t brick) {
  double lightest = body.masses[body.grid.nodes[brick][0]];
  for (const int node : body.grid.nodes[brick]) lightest = std::min(lightest, body.masses[node]);
  return (body.stiffness_scale.empty() ? 1 : body.stiffness_scale[brick]) / lightest;
}

std::string remedy_for_stiff_springs(const SoftBody& body, std::size_t brick) {
  std::vector<double> all(body.grid.nodes.size());
  for (std::size_t one = 0; one < all.size(); ++one) all[one] = stiffness_for_mass(body, one);
  const double here = all[brick];
  std::nth_element(all.begin(), all.begin() + long(all.size() / 2), all.end());
  const double ratio = here / all[all.size() / 2];
  if (!(ratio > kStiffForMass)) return "";
  return fmt::format(
      "the ratio of stiffness to mass there is {:.2g} times that of most of the body: use "
      "a softer or denser material there (region)",
      ratio);
}

std::string remedy_for_thinness(const SoftBody& body, std::size_t brick) {
  const std::array<int, 6> neighbours = face_neighbours(body.grid, CellIndex(body.grid), brick);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (neighbours[2 * axis] >= 0 || neighbours[2 * axis + 1] >= 0) continue;
    return fmt::format("its part there is one brick of {} thick: use more bricks (bricks), so that it has two or three",
                       length(body.grid.brick_size));
  }
  return "";
}

}  // namespace

std::size_t worst_brick_of(const Body& body) {
  std::size_t worst = 0;
  double fastest = -1;
  for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
    double speed = 0;
    for (const int node : body.grid.nodes[brick]) {
      if (!body.positions.row(node).allFinite() || !body.velocities.row(node).allFinite()) return brick;
      speed = std::max(speed, body.velocities.row(node).squaredNorm());
    }
    if (speed <= fastest) continue;
    fastest = speed;
    worst = brick;
  }
  return worst;
}

std::string advice_for_divergence(const World& world, std::size_t row, std::size_t brick) {
  const SoftBody& body = world.bodies[row];
  for (const std::string& remedy : {remedy_for_overlaps(world, row), remedy_for_speed(body), remedy_for_inversion(body),
                                    remedy_for_stiff_springs(body, brick), remedy_for_thinness(body, brick)}) {
    if (!remedy.empty()) return remedy;
  }
  return "use more bricks, a stiffer material, more damping or a shorter fall";
}

}  // namespace sprung
