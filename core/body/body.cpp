#include "core/body/body.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/body/brick_model.h"
#include "core/body/brick_tiles.h"
#include "core/body/solid_tiles.h"
#include "core/bricks/embedding.h"
#include "core/law/hexahedron.h"
#include "core/law/solid/solid_brick.h"
#include "core/types.h"

namespace sprung {
namespace {

/// How a brick's mass is lumped at its corners: in eighths, or, where its solid is known, weighted towards the nearer
/// ones. With weights exactly at its centroid, corners far from it would be left with next to nothing, and set the
/// largest stable step.
CornerWeights corner_shares(const Body& body, std::size_t brick) {
  constexpr double kLean = 0.8;
  constexpr double kMaxLean = 0.32;
  if (body.solids.empty()) return trilinear_weights(Vec3::Constant(0.5));
  const Vec3 lean = kLean * body.solids[brick].moments.centroid;
  return trilinear_weights(Vec3::Constant(0.5) + lean.cwiseMax(-kMaxLean).cwiseMin(kMaxLean));
}

Eigen::VectorXd lump_masses(const Body& body) {
  const BrickGrid& grid = body.grid;
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(grid.node_count());
  for (std::size_t brick = 0; brick < grid.nodes.size(); ++brick) {
    const CornerWeights shares = corner_shares(body, brick);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      masses[grid.nodes[brick][corner]] += body.stiffness_scale[brick] * shares[corner];
    }
  }
  masses *= body.material.density * grid.volume() / masses.sum();
  return masses;
}

void put_at_rest(Body& body) {
  body.rest_positions = body.grid.rest_positions();
  body.positions = body.rest_positions;
  body.velocities = Points::Zero(body.grid.node_count(), 3);
  body.damping = rayleigh_from_damping(body.material, length_of(body));
}

double volume_ratio(const Body& body, std::size_t brick) {
  return brick_model(body.model).gradient(body, brick, at_corners(body, brick, body.positions)).determinant();
}

}  // namespace

double slowest_frequency(const Material& material, double length) {
  return std::sqrt(material.shear_modulus() / material.density) / (2 * length);
}

Rayleigh rayleigh_from_damping(const Material& material, double length) {
  return {.alpha = 0, .beta = 2 * material.damping / (2 * std::numbers::pi * slowest_frequency(material, length))};
}

double length_of(const Body& body) {
  return (body.rest_positions.colwise().maxCoeff() - body.rest_positions.colwise().minCoeff()).maxCoeff();
}

namespace {

std::vector<BodySolid> solids_of(const BrickGrid& grid, double poisson) {
  const auto whole = std::make_shared<const CurvedSolid>(curved_solid(poisson, {}));
  std::vector<BodySolid> solids(grid.cells.size(), {.moments = {}, .curved = whole});
  if (grid.moments.empty()) return solids;
  tbb::parallel_for(std::size_t{0}, solids.size(), [&](std::size_t brick) {
    if (grid.moments[brick].is_whole()) return;
    const SolidMoments moments = bounded_moments(grid.moments[brick]);
    solids[brick] = {.moments = moments, .curved = std::make_shared<const CurvedSolid>(curved_solid(poisson, moments))};
  });
  return solids;
}

}  // namespace

Body make_body(BrickGrid grid, Model model, const Material& material) {
  Body body;
  body.law = brick_law(model, material, grid.brick_size);
  if (model == Model::kFem) body.small_strain_stiffness = hexahedron_stiffness(material, grid.brick_size);
  if (model == Model::kCalibrated) body.solids = solids_of(grid, material.poisson);
  body.grid = std::move(grid);
  body.model = model;
  body.material = material;
  body.stiffness_scale.reserve(body.grid.fill.size());
  for (const double fill : body.grid.fill) body.stiffness_scale.push_back(std::max(fill, kStiffnessFloor));
  tbb::parallel_invoke([&] { build_tiles(body); },
                       [&] {
                         body.masses = lump_masses(body);
                         put_at_rest(body);
                       });
  return body;
}

void build_tiles(Body& body) {
  body.tiles = std::make_shared<const BrickTiles>(
      body.model == Model::kCalibrated ? make_solid_tiles(body) : make_spring_tiles(body.grid, body.stiffness_scale));
}

void place(Body& body, const Mat3& rotation, const Vec3& translation) {
  const auto move = [&](Points& points) {
    points = (points * rotation.transpose()).rowwise() + translation.transpose();
  };
  move(body.rest_positions);
  move(body.positions);
  body.velocities = body.velocities * rotation.transpose();
  if (body.small_strain_stiffness.size() == 0) return;
  for (int a = 0; a < 24; a += 3) {
    for (int b = 0; b < 24; b += 3) {
      const Mat3 block = body.small_strain_stiffness.block<3, 3>(a, b);
      body.small_strain_stiffness.block<3, 3>(a, b) = rotation * block * rotation.transpose();
    }
  }
}

std::array<double, 24> brick_corners(const Body& body, std::size_t brick) {
  std::array<double, 24> x{};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (std::size_t k = 0; k < 3; ++k) {
      x[3 * corner + k] = body.positions(body.grid.nodes[brick][corner], k);
    }
  }
  return x;
}

double smallest_volume_ratio(const Body& body) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
    smallest = std::min(smallest, volume_ratio(body, brick));
  }
  return smallest;
}

int inverted_bricks(const Body& body) {
  int count = 0;
  for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
    count += volume_ratio(body, brick) <= 0 ? 1 : 0;
  }
  return count;
}

namespace {

constexpr int kNodesPerTask = 512;

}  // namespace

double* CornerSums::room(const BrickGrid& grid) {
  if (lists_.first.empty()) {
    lists_ = list_corners(grid.nodes, grid.node_count());
    at_corners_.resize(3 * lists_.corners.size());
  }
  return at_corners_.data();
}

void CornerSums::sum(double* sums) const {
  const int nodes = isize(lists_.first) - 1;
  tbb::parallel_for(tbb::blocked_range<int>(0, nodes, kNodesPerTask), [&](const tbb::blocked_range<int>& range) {
    for (int node = range.begin(); node < range.end(); ++node) {
      Vec3 sum = Vec3::Zero();
      const std::size_t n = node;
      for (int i = lists_.first[n]; i < lists_.first[n + 1]; ++i) {
        const std::size_t corner = lists_.corners[i];
        sum += Eigen::Map<const Vec3>(&at_corners_[3 * corner]);
      }
      Eigen::Map<Vec3>(sums + 3 * std::ptrdiff_t(node)) = sum;
    }
  });
}

}  // namespace sprung
