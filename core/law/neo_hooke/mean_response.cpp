#include "core/law/neo_hooke/mean_response.h"

#include "core/bricks/brick_topology.h"

namespace sprung {

MeanResponse::MeanResponse(const Material& material, double h, double volume, const Vec3& centroid)
    : law_(material), volume_(volume) {
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      double weight = 1 / h;
      for (int other = 0; other < 3; ++other) {
        const double side = on_high_side(corner, other) ? 1 : -1;
        weight *= other == axis ? side : 0.5 + side * centroid[other];
      }
      weights_(corner, axis) = weight;
    }
  }
}

Mat3 MeanResponse::gradient(const BrickVector& x) const { return x.reshaped(3, 8) * weights_; }

double MeanResponse::energy(const BrickVector& x) const { return volume_ * law_.energy(gradient(x)); }

void MeanResponse::add_forces(const BrickVector& x, BrickVector& forces) const {
  forces.reshaped(3, 8) -= volume_ * law_.stress(gradient(x)) * weights_.transpose();
}

void MeanResponse::add_hessian(const BrickVector& x, bool definite, BrickMatrix& matrix) const {
  const Mat3 f = gradient(x);
  add(definite ? law_.definite_hessian(f) : law_.hessian(f), matrix);
}

void MeanResponse::add_damping(const BrickVector& x, BrickMatrix& matrix) const {
  add(law_.viscosity(gradient(x)), matrix);
}

void MeanResponse::add_damping_product(const BrickVector& x, const BrickVector& v, BrickVector& product) const {
  product.reshaped(3, 8) += volume_ * law_.viscous_stress(gradient(x), gradient(v)) * weights_.transpose();
}

void MeanResponse::add(const GradientMatrix& of_gradient, BrickMatrix& matrix) const {
  Eigen::Matrix<double, 9, 24> by_corner = Eigen::Matrix<double, 9, 24>::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      by_corner.block<3, 3>(3 * axis, 3 * corner).diagonal().setConstant(weights_(corner, axis));
    }
  }
  matrix += volume_ * by_corner.transpose() * of_gradient * by_corner;
}

}  // namespace sprung
