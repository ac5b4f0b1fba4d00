#include "core/dynamics/explicit/split_damping.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/body/body.h"
#include "core/body/forces.h"

namespace sprung {
namespace {

constexpr double kFastestRatio = 0.1;      // damping ratio of the fastest vibration in steps: a tenth shorter
constexpr double kPeriodShare = 1.0 / 16;  // of the slowest vibration, between two applications
constexpr double kMargin = 1.2;            // the square of the fastest frequency may grow by ...
constexpr double kMoreMargin = 4;          // ... and by so much more, each time that it turns out to be too little
constexpr double kRounding = 1e-9;         // of the kinetic energy
constexpr int kMaxStages = 120;
constexpr double kRoot = 4.5;  // the fastest vibrations are left a share of 1 / cosh of it

/// A Chebyshev polynomial of the first kind and its derivative at w > 1.
struct Chebyshev {
  double value;
  double slope;
  Chebyshev(int degree, double w) {
    const double sine = std::sqrt(w * w - 1);
    const double angle = degree * std::log(w + sine);
    value = std::cosh(angle);
    slope = degree * std::sinh(angle) / sine;
  }
};

/// Enough for vibrations that decay by up to that exponent.
int stages_for(double decay) { return 2 + int(std::sqrt(kRoot / 2 * decay)); }

}  // namespace

DampingShares damping_shares(const Body& body, double frequency_squared) {
  DampingShares shares{.of_steps = body.damping};
  if (body.model == Model::kFem) return shares;
  const double most = 2 * kFastestRatio / std::sqrt(frequency_squared);
  shares.of_steps.beta = std::min(most, body.damping.beta);
  shares.split_beta = body.damping.beta - shares.of_steps.beta;
  return shares;
}

SplitDamping::SplitDamping(SoftBody& body, double beta, double frequency_squared)
    : body_(body), beta_(beta), rate_(kMargin * beta * frequency_squared) {
  if (beta_ == 0) return;
  longest_ = std::min(kPeriodShare / slowest_frequency(body.material, length_of(body)), affordable());
  inverse_masses_.resize(3 * body.masses.size());
  for (Eigen::Index node = 0; node < body.masses.size(); ++node) {
    inverse_masses_.segment<3>(3 * node).setConstant(1 / body.masses[node]);
  }
  for (const KinematicNode& pinned : body.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (pinned.axes[axis]) inverse_masses_[3 * pinned.node + axis] = 0;
    }
  }
}

bool SplitDamping::add(double dt) {
  if (beta_ == 0) return false;
  due_ += dt;
  return due_ + dt > longest_;
}

double SplitDamping::affordable() const { return (kMaxStages - 2) * (kMaxStages - 2) * 2 / kRoot / rate_; }

double SplitDamping::find_change(const Eigen::VectorXd& u, Eigen::VectorXd& change) {
  multiply_damping(body_, body_.positions, due_ * beta_, u, workspace_, product_);
  change = -inverse_masses_.cwiseProduct(product_);
  return u.dot(product_);
}

void SplitDamping::settle() {
  if (due_ == 0) return;
  Eigen::Map<Eigen::VectorXd> v(body_.velocities.data(), body_.velocities.size());
  const double rounding = kRounding * kinetic_energy(body_);
  while (true) {
    due_ = std::min(due_, affordable());
    const auto [sum, dissipated] = damped_change(v);
    const Eigen::VectorXd after = v + sum;
    Eigen::VectorXd change;
    if (!(find_change(after, change) > dissipated + rounding)) {
      v = after;
      break;
    }
    rate_ *= kMoreMargin;
    longest_ = std::min(longest_, affordable());
  }
  due_ = 0;
}

std::pair<Eigen::VectorXd, double> SplitDamping::damped_change(const Eigen::VectorXd& v) {
  const int stages = stages_for(due_ * rate_);
  const double w = 1 + kRoot * kRoot / (2 * stages * stages);
  const Chebyshev last(stages, w);
  const double scale = last.value / last.slope;
  Eigen::VectorXd at_first;
  const double dissipated = find_change(v, at_first);
  Eigen::VectorXd before = Eigen::VectorXd::Zero(v.size());
  Eigen::VectorXd sum = scale / w * at_first;  // of what v has changed by
  Eigen::VectorXd change;
  for (int stage = 2; stage <= stages; ++stage) {
    const double now = Chebyshev(stage, w).value;
    const double grown = 2 * Chebyshev(stage - 1, w).value / now;
    find_change(sum, change);
    before = w * grown * sum - Chebyshev(stage - 2, w).value / now * before + scale * grown * (at_first + change);
    std::swap(before, sum);
  }
  return {sum, dissipated};
}

}  // namespace sprung
