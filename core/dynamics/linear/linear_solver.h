#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "core/body/body.h"
#include "core/world/spring_support.h"

namespace sprung {

/// Which of a body's 3 m degrees of freedom (3 node + axis) keep their current values, and which of its points are held
/// by springs.
struct Supports {
  std::vector<bool> fixed;               // 3 m
  std::vector<SpringSupport> springs{};  // a LinearSolver sees them as StepTerms::points: support_terms()

  explicit Supports(int node_count) : fixed(3 * std::size_t(node_count), false) {}
  void fix(int node, int axis) { fixed[3 * node + axis] = true; }
  void fix(int node) {
    for (int axis = 0; axis < 3; ++axis) fix(node, axis);
  }
};

/// Terms that a time step adds to the stiffness K of a body; by default, none.
struct StepTerms {
  double mass_factor = 0;              // 1/s^2: times the masses
  double damping = 0;                  // times the springs' axial stiffness ...
  Points damping_positions;            // ... with the nodes here (m x 3, m); unused if damping is zero
  std::vector<PointStiffness> points;  // contacts, muscles
  /// The body's own part of what couples it to others: in the preconditioner of an IterativeSolver only.
  std::vector<PointStiffness> coupled;
};

/// The springs of supports, for the solvers.
[[nodiscard]] inline StepTerms support_terms(const Supports& supports) {
  StepTerms terms;
  for (const SpringSupport& support : supports.springs) terms.points.push_back(support.spring);
  return terms;
}

/// Statistics of the solves so far.
struct SolveReport {
  long solves = 0;
  long iterations = 0;  // of an iterative solver, all solves
  int most = 0;         // iterations of one solve
  long indefinite = 0;  // solves that found the matrix not positive definite
  long fallbacks = 0;   // solves that the iterative solver had to leave to the direct one
};

/// The linear systems of Newton's method and linear statics: (K + terms) u = f, with K the second derivative of the
/// elastic energy at a body's positions and u zero at supports. The interface between the equations and their solvers.
/// The same bits for any number of threads.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Sets K at body.positions; with `definite`, each brick's K without its negative curvature, and motions without
  /// resistance stabilised by a stiffness below rounding. Body and terms must not change until the last solve(). False
  /// if the matrix is found not to be positive definite; then solve() must not be called.
  virtual bool linearize(const Body& body, const Supports& supports, bool definite, const StepTerms& terms) = 0;

  /// u (3 m, m) for the forces f (3 m, N); entries of f at supports are ignored. An iterative solver stops when the
  /// residual is `tolerance` of f (Euclidean norms). Empty if the matrix turns out not to be positive definite, or no
  /// solution is found.
  [[nodiscard]] virtual Eigen::VectorXd solve(const Eigen::VectorXd& forces, double tolerance) = 0;

  /// After a solve() that met a direction of negative curvature: the iterate before it, and that direction scaled as
  /// for curvature of the opposite sign; the energy decreases along both (Steihaug, SIAM J. Numer. Anal. 20, 1983).
  /// Otherwise, and from solvers that detect none, empty.
  [[nodiscard]] virtual Eigen::VectorXd downhill() const { return {}; }

  [[nodiscard]] virtual SolveReport report() const = 0;
};

/// A solver that can be a part of a larger system.
class IterativeSolver : public LinearSolver {
 public:
  /// (K + terms) u, N, without the coupled terms; zero at supports.
  virtual void multiply(const Eigen::VectorXd& u, Eigen::VectorXd& forces) = 0;
  /// An approximate u for the forces, zero at supports. Symmetric and positive definite but for rounding.
  virtual void precondition(const Eigen::VectorXd& forces, Eigen::VectorXd& u) = 0;
};

/// Sparse Cholesky (CHOLMOD, supernodal): exact, for small bodies and as the reference for others. Memory and time grow
/// faster than the body: some 250 MB and 2 s at 16 000 bricks.
[[nodiscard]] std::unique_ptr<LinearSolver> make_direct_solver();

/// Conjugate gradients preconditioned by geometric multigrid on the hierarchy of bricks: Galerkin's coarse bricks, each
/// of up to eight connected children, Chebyshev-Jacobi smoothing, the cycle in single precision, the products outside
/// it exact and in double. Time and memory (some 2 kB a brick) grow with the body. Gives up after `max_iterations` per
/// solve.
[[nodiscard]] std::unique_ptr<IterativeSolver> make_multigrid_solver(int max_iterations = 150);

/// The same, but nearly incompressible bodies are solved with the pressures of their bricks as further unknowns
/// (VolumePressures), by GMRES: 2 to 3 times fewer iterations at a ratio of 0.499, 4 to 8 times at 0.4999.
[[nodiscard]] std::unique_ptr<LinearSolver> make_mixed_solver(int max_iterations = 150);

/// The direct solver unless the body is too large for it, else multigrid.
[[nodiscard]] std::unique_ptr<LinearSolver> make_robust_solver(const Body& body);

/// The faster of the two for the body's size, and for its thinness: thin parts take multigrid more iterations. If
/// multigrid gives up, the direct solver takes over, unless the body is too large for it.
[[nodiscard]] std::unique_ptr<LinearSolver> make_default_solver();

/// The stopping criterion of conjugate gradients.
struct StoppingCriterion {
  double tolerance;               // of the residual, relative to the forces
  double fallback_tolerance = 0;  // likewise, if the iterations run out
  int max_iterations;
};

/// Solves A x = forces by flexible conjugate gradients (Polak-Ribiere: rounding makes a preconditioner not quite the
/// same in each iteration), by multiply(x, product) and precondition(residual, correction). `forces` and their results
/// are zero where A is. Empty if A is not positive definite, or no solution is found. `downhill`: see
/// LinearSolver::downhill().
template <class Multiply, class Precondition>
Eigen::VectorXd conjugate_gradients(const Eigen::VectorXd& forces, const StoppingCriterion& end,
                                    const Multiply& multiply, const Precondition& precondition, SolveReport& report,
                                    Eigen::VectorXd* downhill = nullptr) {
  ++report.solves;
  Eigen::VectorXd residual = forces;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(residual.size());
  const double goal = end.tolerance * forces.norm();
  if (goal == 0) return x;
  Eigen::VectorXd z;
  Eigen::VectorXd product;
  precondition(residual, z);
  Eigen::VectorXd direction = z;
  double descent = residual.dot(z);
  for (int iteration = 1; iteration <= end.max_iterations; ++iteration) {
    ++report.iterations;
    report.most = std::max(report.most, iteration);
    multiply(direction, product);
    const double curvature = direction.dot(product);
    if (!(curvature > 0)) {
      ++report.indefinite;
      if (downhill != nullptr && curvature < 0) *downhill = x - descent / curvature * direction;
      return {};
    }
    const double step = descent / curvature;
    x += step * direction;
    residual -= step * product;
    if (residual.norm() <= goal) return x;
    precondition(residual, z);
    const double next = residual.dot(z);
    direction = z - step * z.dot(product) / descent * direction;
    descent = next;
    if (!(descent > 0)) break;
  }
  if (residual.norm() <= end.fallback_tolerance * forces.norm()) return x;
  return {};
}

}  // namespace sprung
