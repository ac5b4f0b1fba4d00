#include "core/simulation/part_measures.h"

#include <algorithm>
#include <span>
#include <vector>

#include "core/body/forces.h"
#include "core/body/stress.h"

namespace sprung {
namespace {

constexpr double kSmallDisplacement = 1e-5;  // bricks, at which an energy is quadratic to that share

/// J, of the part's bricks. Small: by its quadratic growth at small displacements.
double elastic_energy_of(const SoftBody& body, const ProbedPart& part, StrainMeasure strain) {
  if (strain == StrainMeasure::kFinite) return brick_energies(body, part.bricks, body.positions).sum();
  const Points displacement = body.positions - body.rest_positions;
  const double largest = displacement.cwiseAbs().maxCoeff();
  if (largest == 0) return 0;
  const double share = kSmallDisplacement * body.grid.brick_size / largest;
  const Points near_rest = body.rest_positions + share * displacement;
  return brick_energies(body, part.bricks, near_rest).sum() / (share * share);
}

double kinetic_energy_of(const SoftBody& body, const ProbedPart& part) {
  const BrickGrid& grid = body.grid;
  Eigen::VectorXd fill = Eigen::VectorXd::Zero(body.node_count());
  Eigen::VectorXd fill_of_part = Eigen::VectorXd::Zero(body.node_count());
  for (std::size_t brick = 0; brick < grid.nodes.size(); ++brick) {
    for (const int node : grid.nodes[brick]) fill[node] += grid.fill[brick];
  }
  for (const int brick : part.bricks) {
    for (const int node : grid.nodes[brick]) fill_of_part[node] += grid.fill[brick];
  }
  const Eigen::VectorXd masses = body.masses.cwiseProduct(fill_of_part).cwiseQuotient(fill);
  return 0.5 * masses.dot(body.velocities.rowwise().squaredNorm());
}

/// Pa, von Mises.
double largest_skin_stress(const SoftBody& body, const ProbedPart& part, StrainMeasure strain) {
  std::vector<int> nodes;
  for (const int point : part.skin_points) {
    const auto& corners = body.grid.nodes[body.drawn.embedding.brick[point]];
    nodes.insert(nodes.end(), corners.begin(), corners.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  StressTensors of_nodes = StressTensors::Zero(body.node_count(), 6);
  of_nodes(nodes, Eigen::all) = recover_stress(body, body.positions, nodes, strain);
  const Embedding& skin = body.drawn.embedding;
  Embedding points{.brick = {}, .local = skin.local(part.skin_points, Eigen::all)};
  for (const int point : part.skin_points) points.brick.push_back(skin.brick[point]);
  return von_mises(stress_at(body.grid, points, of_nodes)).maxCoeff();
}

}  // namespace

void PartMeasures::add(const SoftBody& body, const ProbedPart& part, StrainMeasure strain) {
  const Eigen::VectorXd ratios = measure_bricks(body, BrickMeasure::kVolume, body.positions, strain);
  const Eigen::VectorXd stresses = measure_bricks(body, BrickMeasure::kStress, body.positions, strain);
  const Eigen::VectorXd strains = measure_bricks(body, BrickMeasure::kStrain, body.positions, strain);
  for (const int brick : part.bricks) {
    const auto& nodes = body.grid.nodes[brick];
    const double volume = body.grid.fill[brick] * body.grid.brick_volume();
    const Vec3 position = columns_of(nodes, body.positions).rowwise().mean();
    const Vec3 start = columns_of(nodes, body.rest_positions).rowwise().mean();
    volume_ += volume;
    sums_.position += volume * position;
    sums_.displacement += volume * (position - start);
    sums_.volume += volume * ratios[brick];
    sums_.mean_stress += volume * stresses[brick];
    sums_.mean_strain += volume * strains[brick];
    sums_.max_stress = std::max(sums_.max_stress, stresses[brick]);
    sums_.max_strain = std::max(sums_.max_strain, strains[brick]);
  }
  if (!part.skin_points.empty()) {
    sums_.max_stress = std::max(sums_.max_stress, largest_skin_stress(body, part, strain));
  }
  sums_.elastic_energy += elastic_energy_of(body, part, strain);
  sums_.kinetic_energy += kinetic_energy_of(body, part);
}

ProbeSample PartMeasures::sample() const {
  ProbeSample sample = sums_;
  sample.position /= volume_;
  sample.displacement /= volume_;
  sample.mean_stress /= volume_;
  sample.mean_strain /= volume_;
  return sample;
}

}  // namespace sprung
