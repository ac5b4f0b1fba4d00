#pragma once
#include <utility>
#include <vector>

#include "core/dynamics/linear/stiffness.h"
#include "core/world/world.h"

namespace sprung {

/// How explicit steps damp a body's springs. All of beta in every step would shorten them: a tenth of critical at the
/// slowest vibration is many times critical at the fastest, and shortens steps by as much. So every step includes the
/// part that hardly shortens it, and the rest is applied by itself, for several steps at a time.
struct DampingShares {
  Rayleigh of_steps;
  double split_beta = 0;  // s
};

/// For a body in its current state, whose highest frequency (largest_frequency_squared()) is known. Small strains
/// (Model::kFem) are damped in every step only.
[[nodiscard]] DampingShares damping_shares(const Body& body, double frequency_squared);

/// Damps the rates of stretch during several steps at once, M v' = -beta K v, K the stiffness used by beta damping: by
/// one step of a Runge-Kutta-Chebyshev method, of as many stages as make it stable, a product with K each; their number
/// grows with the root of the time. Its polynomial is damped so much that a vibration which decays by exp(-x) is left
/// exp(-x - x^2 / 9) at first and no more than a fortieth in the end; backward Euler's is exp(-x + x^2 / 2). Both
/// momenta of a free body are conserved. A body that is deformed may vibrate faster than was known: if the stages were
/// too few, it dissipates more afterwards than before, and is done again with more. Deterministic for any number of
/// threads. Source: Verwer, Hundsdorfer and Sommeijer, "Convergence properties of the Runge-Kutta-Chebyshev method",
/// Numer. Math. 57, 1990.
class SplitDamping {
 public:
  /// `beta` in s; 0 costs nothing. `frequency_squared`: 1/s^2, of the body's fastest vibration, which may become
  /// faster. The body must outlive it.
  SplitDamping(SoftBody& body, double beta, double frequency_squared);

  /// Adds the damping of a step (s). Whether so much is due that it should be applied now: the body's slowest vibration
  /// moves little in that time.
  [[nodiscard]] bool add(double dt);

  /// Applies the damping that is still due. If a single step is worth more than a hundred stages, the rest of it is
  /// lost: steps that long are not stable.
  void settle();

 private:
  /// s, that can be applied at once.
  [[nodiscard]] double affordable() const;
  /// -T beta M^-1 K u, zero at pinned nodes; T: the time that is due. Returns T beta u K u, J, which damping never
  /// lets grow.
  double find_change(const Eigen::VectorXd& u, Eigen::VectorXd& change);
  /// Returns the change of velocities in that time, m/s, and T beta v K v before it, J.
  [[nodiscard]] std::pair<Eigen::VectorXd, double> damped_change(const Eigen::VectorXd& v);

  SoftBody& body_;
  double beta_;
  double rate_;                     // 1/s, at most, at which it damps
  double longest_ = 0;              // s, between two applications
  Eigen::VectorXd inverse_masses_;  // 1/kg, per unknown; 0 if pinned
  double due_ = 0;                  // s
  ProductWorkspace workspace_;
  Eigen::VectorXd product_;
};

}  // namespace sprung
