#include "core/body/forces.h"

#include <tbb/parallel_for.h>

#include <experimental/simd>
#include <numeric>

#include "core/body/brick_kernel.h"

namespace sprung {
namespace {

namespace stdx = std::experimental;
constexpr int kLanes = 8;
using Pack = stdx::fixed_size_simd<double, kLanes>;

constexpr int kBlocksPerTask = 32;

/// The bricks first .. first + kLanes - 1 side by side; the last brick is repeated where there are fewer.
CornerVectors<Pack> gather(const BrickGrid& grid, const Points& values, int first, double factor) {
  CornerVectors<Pack> packed;
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto brick = static_cast<std::size_t>(std::min(first + lane, grid.brick_count() - 1));
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const double* value = values.data() + 3 * static_cast<std::ptrdiff_t>(grid.nodes[brick][corner]);
      for (std::size_t k = 0; k < 3; ++k) packed[3 * corner + k][static_cast<std::size_t>(lane)] = factor * value[k];
    }
  }
  return packed;
}

void compute_block(const Body& body, int first, ForceWorkspace& workspace) {
  const BrickGrid& grid = body.grid;
  const CornerVectors<Pack> x = gather(grid, body.positions, first, 1);
  CornerVectors<Pack> force;
  force.fill(Pack(0.0));
  Pack energy;
  if (body.damping.beta > 0) {
    const CornerVectors<Pack> rates = gather(grid, body.velocities, first, body.damping.beta);
    energy = brick_forces<Pack>(body.law, grid.brick_size, x, &rates, force);
  } else {
    energy = brick_forces<Pack>(body.law, grid.brick_size, x, nullptr, force);
  }
  const int lanes = std::min(kLanes, grid.brick_count() - first);
  for (int lane = 0; lane < lanes; ++lane) {
    const auto brick = static_cast<std::size_t>(first + lane);
    const double scale = body.stiffness_scale[brick];
    const auto l = static_cast<std::size_t>(lane);
    for (std::size_t i = 0; i < 24; ++i) workspace.corner_forces[24 * brick + i] = scale * force[i][l];
    workspace.energies[brick] = scale * energy[l];
  }
}

/// The same for a body of trilinear hexahedra, whose force is linear in the displacement from rest.
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
  const int blocks = (body.grid.brick_count() + kLanes - 1) / kLanes;
  tbb::parallel_for(tbb::blocked_range<int>(0, blocks, kBlocksPerTask), [&](const tbb::blocked_range<int>& range) {
    for (int block = range.begin(); block < range.end(); ++block) compute_block(body, block * kLanes, workspace);
  });
}

}  // namespace

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
