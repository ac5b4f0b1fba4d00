#pragma once
#include <vector>

#include "core/dynamics/linear/stiffness.h"
#include "core/world/world.h"

namespace sprung {

/// How explicit steps damp a body's springs. All of beta in explicit steps would shorten them: a tenth of critical at
/// the slowest vibration is many times critical at the fastest, and shortens steps by as much. So every step includes
/// the part that hardly shortens it, and the rest is applied implicitly, for several steps at a time.
struct DampingShares {
  Rayleigh explicit_part;
  double implicit_beta = 0;  // s
};

/// For a body in its current state, whose highest frequency (largest_frequency_squared()) is known. Small strains
/// (Model::kFem) are damped explicitly only.
[[nodiscard]] DampingShares damping_shares(const Body& body, double frequency_squared);

/// Damps the rates of stretch by backward Euler: (M + T beta K) v' = M v, K the stiffness used by beta damping, T the
/// steps since the last solve. By conjugate gradients on the change of v, preconditioned by the masses: however early
/// they stop, both momenta of a free body are conserved. Deterministic for any number of threads.
class ImplicitDamping {
 public:
  /// `beta` in s; 0 costs nothing. The body must outlive it.
  ImplicitDamping(SoftBody& body, double beta) : body_(body), beta_(beta) {}

  /// Adds the damping of a step (s). Whether so much is due that it should be applied now.
  [[nodiscard]] bool add(double dt);

  /// Applies the damping that is still due.
  void settle();

 private:
  /// T beta K u, zero at pinned nodes.
  void multiply(const Eigen::VectorXd& u, Eigen::VectorXd& product);

  SoftBody& body_;
  double beta_;
  double due_ = 0;  // s
  int passed_ = 0;
  ProductWorkspace workspace_;
};

}  // namespace sprung
