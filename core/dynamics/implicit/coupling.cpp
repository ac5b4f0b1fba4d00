#include "core/dynamics/implicit/coupling.h"

#include "core/dynamics/linear/linear_solver.h"

namespace sprung {
namespace {

constexpr int kMaxIterations = 300;
constexpr double kFallbackTolerance =
    1e-2;  // of the forces, left over when the iterations run out: Newton's next step mends it

class CoupledSystem {
 public:
  CoupledSystem(std::span<const CoupledBody> bodies, const std::vector<Coupling>& couplings)
      : bodies_(bodies), couplings_(couplings) {
    Eigen::Index size = 0;
    for (const CoupledBody& body : bodies) {
      starts_.push_back(size);
      size += Eigen::Index{3} * body.body->node_count();
    }
  }

  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& product) {
    product.resize(x.size());
    each_part(x, product, [&](IterativeSolver& system) { system.multiply(part_, answer_); });
    for (const Coupling& coupling : couplings_) {
      Vec3 moved = Vec3::Zero();
      each_node(coupling, [&](Eigen::Index at, double weight) { moved += weight * x.segment<3>(at); });
      const Vec3 force = coupling.stiffness * moved;
      each_node(coupling, [&](Eigen::Index at, double weight) { product.segment<3>(at) += weight * force; });
    }
    release_held(product);
  }

  void precondition(const Eigen::VectorXd& residual, Eigen::VectorXd& correction) {
    correction.resize(residual.size());
    each_part(residual, correction, [&](IterativeSolver& system) { system.precondition(part_, answer_); });
  }

  void release_held(Eigen::VectorXd& vector) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const std::vector<bool>& fixed = bodies_[i].supports->fixed;
      for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
        if (fixed[dof]) vector[starts_[i] + dof] = 0;
      }
    }
  }

 private:
  /// From part_ to answer_, one body at a time.
  template <class Visit>
  void each_part(const Eigen::VectorXd& from, Eigen::VectorXd& to, const Visit& visit) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Eigen::Index size = Eigen::Index{3} * bodies_[i].body->node_count();
      part_ = from.segment(starts_[i], size);
      visit(*bodies_[i].system);
      to.segment(starts_[i], size) = answer_;
    }
  }

  template <class Visit>
  void each_node(const Coupling& coupling, const Visit& visit) const {
    for (const CoupledCorners& corners : coupling.corners) {
      const auto& nodes = bodies_[corners.body].body->grid.nodes[corners.brick];
      for (std::size_t c = 0; c < 8; ++c) {
        visit(starts_[corners.body] + Eigen::Index{3} * nodes[c], corners.weights[c]);
      }
    }
  }

  std::span<const CoupledBody> bodies_;
  const std::vector<Coupling>& couplings_;
  std::vector<Eigen::Index> starts_;  // of a body's degrees of freedom
  Eigen::VectorXd part_;
  Eigen::VectorXd answer_;
};

}  // namespace

/// (sum_i w_i u_i)^2 <= sum_i w_i^2 u_i^2 / s_i for any shares s_i with the sum 1; these make it equal where a body
/// moves as a whole.
std::vector<std::vector<PointStiffness>> own_parts(const std::vector<Coupling>& couplings, std::size_t bodies) {
  std::vector<std::vector<PointStiffness>> parts(bodies);
  for (const Coupling& coupling : couplings) {
    double other_side = 0;
    for (std::size_t i = 1; i < coupling.corners.size(); ++i) other_side += coupling.corners[i].weights.lpNorm<1>();
    for (std::size_t i = 0; i < coupling.corners.size(); ++i) {
      const CoupledCorners& corners = coupling.corners[i];
      const double share = i == 0 ? 1 : corners.weights.lpNorm<1>() / other_side;
      if (share == 0) continue;
      parts[corners.body].push_back(
          {.brick = corners.brick, .weights = corners.weights, .stiffness = coupling.stiffness / share});
    }
  }
  return parts;
}

Eigen::VectorXd solve_coupled(std::span<const CoupledBody> bodies, const std::vector<Coupling>& couplings,
                              const Eigen::VectorXd& forces, double tolerance, SolveReport& report) {
  CoupledSystem system(bodies, couplings);
  Eigen::VectorXd free = forces;
  system.release_held(free);
  return conjugate_gradients(
      free, {.tolerance = tolerance, .fallback_tolerance = kFallbackTolerance, .max_iterations = kMaxIterations},
      [&](const auto& x, auto& product) { system.multiply(x, product); },
      [&](const auto& residual, auto& correction) { system.precondition(residual, correction); }, report);
}

}  // namespace sprung
