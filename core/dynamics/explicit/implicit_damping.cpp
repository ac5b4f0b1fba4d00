#include "core/dynamics/explicit/implicit_damping.h"

#include <cmath>

namespace sprung {
namespace {

constexpr double kFastestRatio = 0.25;  // explicit damping ratio of the fastest vibration: steps a fifth shorter
constexpr int kStepsBetween = 12;       // the slow vibrations left to it hardly move in this many
constexpr int kMaxIterations = 40;
constexpr double kTolerance = 1e-2;  // of the damping that is due: the next solve corrects the rest

Eigen::Map<Eigen::VectorXd> flat(Points& points) { return {points.data(), points.size()}; }

}  // namespace

DampingShares damping_shares(const Body& body, double frequency_squared) {
  DampingShares shares{.explicit_part = body.damping};
  if (body.model == Model::kFem) return shares;
  const double most = 2 * kFastestRatio / std::sqrt(frequency_squared);
  shares.explicit_part.beta = std::min(most, body.damping.beta);
  shares.implicit_beta = body.damping.beta - shares.explicit_part.beta;
  return shares;
}

bool ImplicitDamping::add(double dt) {
  if (beta_ == 0) return false;
  due_ += dt;
  return ++passed_ == kStepsBetween;
}

void ImplicitDamping::multiply(const Eigen::VectorXd& u, Eigen::VectorXd& product) {
  multiply_damping(body_, body_.positions, due_ * beta_, u, workspace_, product);
  for (const KinematicNode& pinned : body_.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (pinned.axes[axis]) product[3 * pinned.node + axis] = 0;
    }
  }
}

void ImplicitDamping::settle() {
  if (due_ == 0) return;
  auto v = flat(body_.velocities);
  Eigen::VectorXd masses(v.size());
  for (Eigen::Index node = 0; node < body_.masses.size(); ++node) {
    masses.segment<3>(3 * node).setConstant(body_.masses[node]);
  }
  Eigen::VectorXd residual;
  Eigen::VectorXd product;
  multiply(v, residual);
  residual = -residual;
  Eigen::VectorXd preconditioned = residual.cwiseQuotient(masses);
  Eigen::VectorXd direction = preconditioned;
  double size = residual.dot(preconditioned);
  const double enough = kTolerance * kTolerance * size;
  for (int i = 0; i < kMaxIterations && size > enough && size > 0; ++i) {
    multiply(direction, product);
    product += masses.cwiseProduct(direction);
    const double length = size / direction.dot(product);
    v += length * direction;
    residual -= length * product;
    preconditioned = residual.cwiseQuotient(masses);
    const double next = residual.dot(preconditioned);
    direction = preconditioned + next / size * direction;
    size = next;
  }
  due_ = 0;
  passed_ = 0;
}

}  // namespace sprung
