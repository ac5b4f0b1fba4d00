#include "core/body/brick_measures.h"

#include <tbb/parallel_for.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/body/brick_model.h"

namespace sprung {
namespace {

constexpr double kSmallestVolume = 0.05;  // as the divisor of a stress

Mat3 gradient_of(const Body& body, std::size_t brick, const Points& positions) {
  return brick_model(body.model).gradient(body, brick, at_corners(body, brick, positions));
}

Mat3 deviator(const Mat3& tensor) { return tensor - tensor.trace() / 3 * Mat3::Identity(); }

Mat3 green_strain(const Mat3& gradient) { return 0.5 * (gradient.transpose() * gradient - Mat3::Identity()); }

double von_mises_strain(const Mat3& strain) { return std::sqrt(2.0 / 3) * deviator(strain).norm(); }

double measure_brick(const Body& body, BrickMeasure measure, const Mat3& gradient, double young) {
  switch (measure) {
    case BrickMeasure::kStretch:
      return Eigen::JacobiSVD<Mat3>(gradient).singularValues()[0];
    case BrickMeasure::kStrain:
      return von_mises_strain(green_strain(gradient));
    case BrickMeasure::kStress:
      return von_mises(cauchy_stress(gradient, brick_model(body.model).second_stress(body, gradient, young)));
    case BrickMeasure::kVolume:
      break;
  }
  return gradient.determinant();
}

/// `gradient`: in the axes of the body at rest.
double measure_small(const Body& body, BrickMeasure measure, const Mat3& gradient, double young) {
  const Mat3 strain = 0.5 * (gradient + gradient.transpose()) - Mat3::Identity();
  switch (measure) {
    case BrickMeasure::kStrain:
      return von_mises_strain(strain);
    case BrickMeasure::kStress:
      return von_mises(hooke_stress(strain, young, body.material.poisson));
    case BrickMeasure::kVolume:
      return 1 + strain.trace();
    case BrickMeasure::kStretch:
      break;
  }
  return measure_brick(body, measure, gradient, young);
}

}  // namespace

Mat3 hooke_stress(const Mat3& strain, double young, double poisson) {
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const double mu = young / (2 * (1 + poisson));
  return lambda * strain.trace() * Mat3::Identity() + 2 * mu * strain;
}

Mat3 cauchy_stress(const Mat3& gradient, const Mat3& second) {
  return gradient * second * gradient.transpose() / std::max(gradient.determinant(), kSmallestVolume);
}

double von_mises(const Mat3& stress) { return std::sqrt(1.5) * deviator(stress).norm(); }

Eigen::VectorXd brick_youngs(const Body& body) {
  Eigen::VectorXd youngs(body.grid.brick_count());
  for (Eigen::Index brick = 0; brick < youngs.size(); ++brick) {
    youngs[brick] = body.material.young * region_factor(body, brick);
  }
  return youngs;
}

Eigen::VectorXd measure_bricks(const Body& body, BrickMeasure measure, const Points& positions, StrainMeasure strain) {
  const Eigen::VectorXd youngs = brick_youngs(body);
  const bool is_small = strain == StrainMeasure::kSmall;
  const Mat3 turn = is_small ? gradient_of(body, 0, body.rest_positions) : Mat3(Mat3::Identity());
  Eigen::VectorXd values(body.grid.brick_count());
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, values.size(), 512), [&](const auto& range) {
    for (Eigen::Index brick = range.begin(); brick < range.end(); ++brick) {
      const Mat3 gradient = gradient_of(body, brick, positions);
      values[brick] = is_small ? measure_small(body, measure, turn.transpose() * gradient, youngs[brick])
                               : measure_brick(body, measure, gradient, youngs[brick]);
    }
  });
  return values;
}

Eigen::VectorXd node_means(const BrickGrid& grid, const Eigen::VectorXd& of_bricks) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(grid.node_count());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(grid.node_count());
  for (std::size_t brick = 0; brick < grid.nodes.size(); ++brick) {
    for (const int node : grid.nodes[brick]) {
      sums[node] += grid.fill[brick] * of_bricks[brick];
      weights[node] += grid.fill[brick];
    }
  }
  return sums.cwiseQuotient(weights);
}

}  // namespace sprung
