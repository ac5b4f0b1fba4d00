#include "core/body/forces.h"

#include <tbb/parallel_for.h>

#include <numeric>

#include "core/body/brick_block.h"

namespace sprung {
namespace {

constexpr int kBlocksPerTask = 32;

/// A body of trilinear hexahedra, whose force is linear in the displacement from rest.
void compute_hexahedron(const Body& body, std::size_t brick, ForceWorkspace& workspace) {
  Eigen::Matrix<double, 24, 1> displacement;
  Eigen::Matrix<double, 24, 1> rates;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const int node = body.grid.nodes[brick][corner];
    const auto row = static_cast<Eigen::Index>(3 * corner);
    displacement.segment<3>(row) = body.positions.row(node) - body.rest_positions.row(node);
    rates.segment<3>(row) = body.damping.beta * body.velocities.row(node);
  }
  const double scale = body.stiffness_scale[brick];
  Eigen::Map<Eigen::Matrix<double, 24, 1>> force(&workspace.corner_forces[24 * brick]);
  force = -scale * (body.small_strain_stiffness * (displacement + rates));
  workspace.energies[brick] = 0.5 * scale * displacement.dot(body.small_strain_stiffness * displacement);
}

void compute_corner_forces(const Body& body, ForceWorkspace& workspace) {
  const auto bricks = static_cast<std::size_t>(body.grid.brick_count());
  workspace.corner_forces.resize(24 * bricks);
  workspace.energies.resize(bricks);
  if (body.small_strain_stiffness.size() > 0) {
    tbb::parallel_for(std::size_t{0}, bricks, [&](std::size_t brick) { compute_hexahedron(body, brick, workspace); });
    return;
  }
  const BlockForces compute_block = block_forces();
  const BlockInput input = block_input(body);
  const int blocks = (body.grid.brick_count() + kBricksPerBlock - 1) / kBricksPerBlock;
  tbb::parallel_for(tbb::blocked_range<int>(0, blocks, kBlocksPerTask), [&](const tbb::blocked_range<int>& range) {
    for (int block = range.begin(); block < range.end(); ++block) {
      compute_block(input, block * kBricksPerBlock, workspace.corner_forces.data(), workspace.energies.data());
    }
  });
}

}  // namespace

BlockInput block_input(const Body& body) {
  return {.law = &body.law,
          .brick_size = body.grid.brick_size,
          .brick_count = body.grid.brick_count(),
          .nodes = body.grid.nodes.data(),
          .stiffness_scale = body.stiffness_scale.data(),
          .positions = body.positions.data(),
          .velocities = body.velocities.data(),
          .beta = body.damping.beta};
}

void spring_forces(const Body& body, ForceWorkspace& workspace, Points& forces) {
  compute_corner_forces(body, workspace);
  forces.resize(body.node_count(), 3);
  tbb::parallel_for(tbb::blocked_range<int>(0, body.node_count(), 512), [&](const tbb::blocked_range<int>& range) {
    for (int node = range.begin(); node < range.end(); ++node) {
      Vec3 sum = Vec3::Zero();
      const auto n = static_cast<std::size_t>(node);
      for (int i = body.first_corner[n]; i < body.first_corner[n + 1]; ++i) {
        const auto corner = static_cast<std::size_t>(body.corners[static_cast<std::size_t>(i)]);
        sum += Eigen::Map<const Vec3>(&workspace.corner_forces[3 * corner]);
      }
      forces.row(node) = sum;
    }
  });
}

double elastic_energy(const Body& body) {
  ForceWorkspace workspace;
  compute_corner_forces(body, workspace);
  return std::accumulate(workspace.energies.begin(), workspace.energies.end(), 0.0);
}

double kinetic_energy(const Body& body) { return 0.5 * body.masses.dot(body.velocities.rowwise().squaredNorm()); }

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
