#include "core/output/brick_fields.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/bricks/corner.h"

namespace sprung {
namespace {

/// The mean axes over the brick's side, as columns.
Mat3 mean_gradient(const BrickGrid& grid, std::size_t brick, const Points& positions) {
  Mat3 gradient = Mat3::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 place = positions.row(grid.nodes[brick][static_cast<std::size_t>(corner)]);
    for (int axis = 0; axis < 3; ++axis) gradient.col(axis) += on_high_side(corner, axis) ? place : Vec3(-place);
  }
  return gradient / (4 * grid.brick_size);
}

}  // namespace

Eigen::VectorXf brick_moduli(const Body& body) {
  Eigen::VectorXf moduli(body.grid.brick_count());
  for (Eigen::Index i = 0; i < moduli.size(); ++i) {
    const auto brick = static_cast<std::size_t>(i);
    const double share = body.stiffness_scale[brick] / std::max(body.grid.fill[brick], kStiffnessFloor);
    moduli[i] = static_cast<float>(body.material.young * share);
  }
  return moduli;
}

BrickFields brick_fields(const Body& body, const Points& positions) {
  const Eigen::VectorXf moduli = brick_moduli(body);
  BrickFields fields{Eigen::VectorXf(moduli.size()), Eigen::VectorXf(moduli.size())};
  for (Eigen::Index i = 0; i < moduli.size(); ++i) {
    const Mat3 gradient = mean_gradient(body.grid, static_cast<std::size_t>(i), positions);
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(gradient.transpose() * gradient, Eigen::EigenvaluesOnly);
    const Vec3 strain = principal.eigenvalues().cwiseMax(0.0).cwiseSqrt().array() - 1;
    const Vec3 deviator = strain.array() - strain.mean();
    const double shear = static_cast<double>(moduli[i]) / (2 * (1 + body.material.poisson));
    fields.stretch[i] = static_cast<float>(strain.maxCoeff());
    fields.stress[i] = static_cast<float>(std::sqrt(1.5) * 2 * shear * deviator.norm());
  }
  return fields;
}

}  // namespace sprung
