#include "core/body/forces.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numeric>

#include "core/body/brick_kernel.h"

namespace sprung {
namespace {

using BrickVector = Eigen::Matrix<double, 24, 1>;

BrickVector at_corners(const Body& body, std::size_t brick, const Points& values) {
  BrickVector gathered;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    gathered.segment<3>(static_cast<Eigen::Index>(3 * corner)) = values.row(body.grid.nodes[brick][corner]);
  }
  return gathered;
}

BrickVector displacement(const Body& body, std::size_t brick) {
  return at_corners(body, brick, body.positions) - at_corners(body, brick, body.rest_positions);
}

/// A body of trilinear hexahedra, whose force is linear in the displacement from rest.
BrickVector hexahedron_forces(const Body& body, std::size_t brick) {
  const BrickVector lagged = displacement(body, brick) + body.damping.beta * at_corners(body, brick, body.velocities);
  return -body.stiffness_scale[brick] * (body.small_strain_stiffness * lagged);
}

double hexahedron_energy(const Body& body, std::size_t brick) {
  const BrickVector u = displacement(body, brick);
  return 0.5 * body.stiffness_scale[brick] * u.dot(body.small_strain_stiffness * u);
}

void sum_hexahedra(const Body& body, CornerSums& sums, Points& forces) {
  double* corner_forces = sums.room(body.grid);
  tbb::parallel_for(std::size_t{0}, body.grid.nodes.size(), [&](std::size_t brick) {
    Eigen::Map<BrickVector> corner_force(corner_forces + 24 * brick);
    corner_force = hexahedron_forces(body, brick);
  });
  forces.resize(body.node_count(), 3);
  sums.sum(forces.data());
}

BrickVector elastic_forces(const Body& body, std::size_t brick) {
  if (body.is_hexahedral()) {
    return -body.stiffness_scale[brick] * (body.small_strain_stiffness * displacement(body, brick));
  }
  CornerVectors<double> force{};
  brick_forces<double>(body.law, body.grid.brick_size, brick_corners(body, brick), nullptr, force);
  return body.stiffness_scale[brick] * Eigen::Map<const BrickVector>(force.data());
}

/// A number of each brick, summed in their order.
template <class Number>
double sum_over_bricks(const Body& body, const Number& number) {
  std::vector<double> numbers(body.grid.cells.size());
  tbb::parallel_for(std::size_t{0}, numbers.size(), [&](std::size_t brick) { numbers[brick] = number(brick); });
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

}  // namespace

void spring_forces(const Body& body, ForceWorkspace& workspace, Points& forces) {
  if (body.is_hexahedral()) {
    sum_hexahedra(body, workspace.hexahedra, forces);
  } else {
    workspace.springs.forces(body, forces);
  }
}

double elastic_energy(const Body& body, ForceWorkspace& workspace) {
  if (!body.is_hexahedral()) return workspace.springs.energy(body);
  return sum_over_bricks(body, [&](std::size_t brick) { return hexahedron_energy(body, brick); });
}

double elastic_energy(const Body& body) {
  ForceWorkspace workspace;
  return elastic_energy(body, workspace);
}

double corner_force_sum(const Body& body) {
  return sum_over_bricks(body, [&](std::size_t brick) { return elastic_forces(body, brick).lpNorm<1>(); });
}

double kinetic_energy(const Body& body) { return 0.5 * body.masses.dot(body.velocities.rowwise().squaredNorm()); }

double largest_speed(const Body& body) { return std::sqrt(body.velocities.rowwise().squaredNorm().maxCoeff()); }

Vec3 linear_momentum(const Body& body) { return body.velocities.transpose() * body.masses; }

Vec3 angular_momentum(const Body& body) {
  Vec3 sum = Vec3::Zero();
  for (int node = 0; node < body.node_count(); ++node) {
    const Vec3 position = body.positions.row(node);
    const Vec3 velocity = body.velocities.row(node);
    sum += body.masses[node] * position.cross(velocity);
  }
  return sum;
}

}  // namespace sprung
