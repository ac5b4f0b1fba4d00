#include "core/body/forces.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/body/brick_model.h"
#include "core/body/brick_tiles.h"
#include "core/body/kernel/pack.h"
#include "core/body/solid_tiles.h"

namespace sprung {
namespace {

constexpr int kSharedPerTask = 256;  // rows
constexpr std::size_t kPacksPerTask = 32;
constexpr int kFewBricks = 4000;  // faster on one thread than waking another

KernelInput input_of(const Body& body, KernelTask task) {
  KernelInput input;
  input.task = task;
  input.law = body.law;
  input.is_solid = body.model == Model::kCalibrated;
  if (input.is_solid) input.solid = solid_law(body.material, body.grid.brick_size);
  input.brick_size = body.grid.brick_size;
  input.beta = body.damping.beta;
  // Only KernelTask::kMove, which has the body to itself, writes there.
  input.positions = const_cast<double*>(body.positions.data());
  input.velocities = const_cast<double*>(body.velocities.data());
  return input;
}

/// Calls visit(0 .. count - 1), in parallel if that is worth it.
template <class Visit>
void each(std::size_t count, std::size_t per_task, const Visit& visit) {
  const auto visit_range = [&](const tbb::blocked_range<std::size_t>& range) {
    const FlushDenormals flush;
    for (std::size_t i = range.begin(); i < range.end(); ++i) visit(i);
  };
  if (count <= per_task) {
    visit_range({0, count});
  } else {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, per_task), visit_range);
  }
}

}  // namespace

void SpringSystem::run(const Body& body, KernelInput input) {
  const BrickTiles& tiles = *body.tiles;
  const bool is_small = body.grid.brick_count() < kFewBricks;
  const std::size_t packs = tiles.gathered.packs.size();
  const std::size_t pack_groups = (packs + kPacksPerTask - 1) / kPacksPerTask;
  energies_.assign(tiles.tiles.size() + pack_groups, {});
  gathered_.resize(kGatheredForces * packs);
  input.gathered = tiles.gathered.view(gathered_.data());
  each(pack_groups, is_small ? pack_groups : 1, [&](std::size_t group) {
    const std::size_t last = std::min(packs, (group + 1) * kPacksPerTask);
    for (std::size_t pack = group * kPacksPerTask; pack < last; ++pack) {
      kernel_.gathered(input, int(pack), energies_[tiles.tiles.size() + group]);
    }
  });
  const std::size_t tiles_per_task = is_small ? tiles.tiles.size() : 1;
  shared_.resize(tiles.shared_size);
  scratch_.resize(tbb::this_task_arena::max_concurrency());
  each(tiles.tiles.size(), tiles_per_task, [&](std::size_t i) {
    const BrickTile& tile = tiles.tiles[i];
    // Below 0: a thread that has had no task yet.
    const int thread = std::max(0, tbb::this_task_arena::current_thread_index());
    std::vector<CacheLine>& scratch = scratch_[thread];
    if (scratch.empty()) scratch.resize(kScratchSize / 8);
    kernel_.tile(tile.view(), input, scratch.front().values, shared_.data() + tile.shared_offset, energies_[i]);
  });
  if (input.task == KernelTask::kEnergy) return;
  each(tiles.shared.size(), kSharedPerTask,
       [&](std::size_t i) { kernel_.shared(tiles.shared[i], tiles.parts.data(), shared_.data(), input); });
}

void SpringSystem::forces(const Body& body, Points& forces) {
  KernelInput input = input_of(body, KernelTask::kForces);
  forces.resize(body.node_count(), 3);
  input.forces = forces.data();
  run(body, input);
  // The scratch must not contain non-finite numbers: lanes behind a run are computed too, times zero.
  if (!forces.allFinite()) scratch_.clear();
}

void SpringSystem::multiply(const Body& body, const Eigen::VectorXd& u, Eigen::VectorXd& product) {
  run_product(body, input_of(body, KernelTask::kProduct), u, product);
}

void SpringSystem::multiply_along(const Body& body, const Points& positions, double factor, const Eigen::VectorXd& u,
                                  Eigen::VectorXd& product) {
  KernelInput input = input_of(body, KernelTask::kDamping);
  input.beta = -factor;
  input.positions = const_cast<double*>(positions.data());
  run_product(body, input, u, product);
}

void SpringSystem::run_product(const Body& body, KernelInput input, const Eigen::VectorXd& u,
                               Eigen::VectorXd& product) {
  product.resize(u.size());
  input.velocities = const_cast<double*>(u.data());
  input.forces = product.data();
  run(body, input);
  if (!product.allFinite()) scratch_.clear();
}

double SpringSystem::energy(const Body& body) {
  KernelInput input = input_of(body, KernelTask::kEnergy);
  run(body, input);
  double sum = 0;
  for (const auto& lanes : energies_) {
    for (const double energy : lanes) sum += energy;
  }
  if (!std::isfinite(sum)) scratch_.clear();
  return sum;
}

void SpringSystem::move(Body& body, const Step& step, const Eigen::VectorXd& inverse_masses) {
  KernelInput input = input_of(body, KernelTask::kMove);
  input.inverse_masses = inverse_masses.data();
  input.beta = step.damping.beta;
  input.drift = step.drift;
  input.kick = step.kick;
  input.keep = 1 - step.kick * step.damping.alpha;
  for (int k = 0; k < 3; ++k) input.gravity_kick[k] = step.kick * step.gravity[k];
  run(body, input);
}

namespace {

void sum_brick_forces(const Body& body, CornerSums& sums, Points& forces) {
  const BrickModel& model = brick_model(body.model);
  double* corner_forces = sums.room(body.grid);
  tbb::parallel_for(std::size_t{0}, body.grid.nodes.size(), [&](std::size_t brick) {
    Eigen::Map<BrickVector> corner_force(corner_forces + 24 * brick);
    corner_force = model.damped_forces(body, brick, at_corners(body, brick, body.positions),
                                       at_corners(body, brick, body.velocities));
  });
  forces.resize(body.node_count(), 3);
  sums.sum(forces.data());
}

/// Sums one number per brick, in the order of the bricks.
template <class Number>
double sum_over_bricks(const Body& body, const Number& number) {
  std::vector<double> numbers(body.grid.cells.size());
  tbb::parallel_for(std::size_t{0}, numbers.size(), [&](std::size_t brick) { numbers[brick] = number(brick); });
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

}  // namespace

void spring_forces(const Body& body, ForceWorkspace& workspace, Points& forces) {
  if (has_tiles(body.model)) {
    workspace.springs.forces(body, forces);
  } else {
    sum_brick_forces(body, workspace.bricks, forces);
  }
}

double elastic_energy(const Body& body, ForceWorkspace& workspace) {
  if (has_tiles(body.model)) return workspace.springs.energy(body);
  const BrickModel& model = brick_model(body.model);
  return sum_over_bricks(
      body, [&](std::size_t brick) { return model.energy(body, brick, at_corners(body, brick, body.positions)); });
}

double elastic_energy(const Body& body) {
  ForceWorkspace workspace;
  return elastic_energy(body, workspace);
}

Eigen::VectorXd brick_energies(const Body& body, const std::vector<int>& bricks, const Points& positions) {
  const BrickModel& model = brick_model(body.model);
  Eigen::VectorXd energies(Eigen::Index(bricks.size()));
  tbb::parallel_for(std::size_t{0}, bricks.size(), [&](std::size_t row) {
    const std::size_t brick = bricks[row];
    energies[Eigen::Index(row)] = model.energy(body, brick, at_corners(body, brick, positions));
  });
  return energies;
}

double energy_rounding(const Body& body) {
  const Eigen::Map<const Eigen::VectorXd> scales(body.stiffness_scale.data(),
                                                 Eigen::Index(body.stiffness_scale.size()));
  return 4 * std::numeric_limits<double>::epsilon() * body.material.young * body.grid.brick_volume() * scales.norm();
}

double corner_force_sum(const Body& body) {
  const BrickModel& model = brick_model(body.model);
  return sum_over_bricks(body, [&](std::size_t brick) {
    return model.forces(body, brick, at_corners(body, brick, body.positions)).lpNorm<1>();
  });
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
