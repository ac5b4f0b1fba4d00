#pragma once
#include <vector>

#include "core/dynamics/linear/stiffness.h"
#include "core/world/world.h"

namespace sprung {

/// How explicit steps damp a body's springs. All of beta in every step would cost step size: a tenth of critical at the
/// slowest vibration is many times critical at the fastest, and shortens steps by as much. So every step has what
/// hardly shortens it, and the rest is done implicitly, for several steps at a time.
struct DampingShares {
  Rayleigh explicit_part;
  double implicit_beta = 0;  // s
};

/// Of a body as it stands, whose fastest frequency (largest_frequency_squared()) is known. Small strains (Model::kFem)
/// are all explicit.
[[nodiscard]] DampingShares damping_shares(const Body& body, double frequency_squared);

/// Slows the rates of stretch by backward Euler: (M + T beta K) v' = M v, K what beta damping sees, T the steps
/// since the last time. By conjugate gradients on the change of v, preconditioned by the masses: however early they
/// stop, both momenta of a free body are kept. Deterministic for any number of threads.
class ImplicitDamping {
 public:
  /// `beta` in s; 0 costs nothing. The body has to outlive it.
  ImplicitDamping(SoftBody& body, double beta) : body_(body), beta_(beta) {}

  /// Lets a step (s) pass; every few the velocities follow.
  void pass(double dt);

  /// Does what is still due.
  void settle();

 private:
  /// T beta K u, zero at what is held.
  void multiply(const Eigen::VectorXd& u, Eigen::VectorXd& product);

  SoftBody& body_;
  double beta_;
  double due_ = 0;  // s
  int passed_ = 0;
  ProductWorkspace workspace_;
};

}  // namespace sprung
