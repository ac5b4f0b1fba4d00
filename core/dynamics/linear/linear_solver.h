#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "core/body/body.h"
#include "core/contact/point_stiffness.h"

namespace sprung {

/// Pulls a point of a body towards where a displacement would bring it, by a spring.
struct SpringSupport {
  PointStiffness spring;
  Vec3 displacement = Vec3::Zero();  // m, from rest
};

/// Which of a body's 3 m degrees of freedom (3 node + axis) keep the value that its positions have, and which of its
/// points springs hold.
struct Supports {
  std::vector<bool> fixed;               // 3 m
  std::vector<SpringSupport> springs{};  // a LinearSolver sees them as StepTerms::points: support_terms()

  explicit Supports(int node_count) : fixed(3 * std::size_t(node_count), false) {}
  void fix(int node, int axis) { fixed[3 * node + axis] = true; }
  void fix(int node) {
    for (int axis = 0; axis < 3; ++axis) fix(node, axis);
  }
};

/// What a step in time adds to the stiffness K of a body; as it comes, nothing.
struct StepTerms {
  double mass_factor = 0;              // 1/s^2: times the masses
  double damping = 0;                  // times the springs' stiffness along themselves, without the guard ...
  Points damping_positions;            // ... where the nodes are here (m x 3, m); not read where damping is zero
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

/// How the solving went so far.
struct SolveReport {
  long solves = 0;
  long iterations = 0;  // of an iterative solver, all solves
  int most = 0;         // iterations of one solve
  long indefinite = 0;  // solves that found the matrix not positive definite
  long fallbacks = 0;   // solves that the iterative solver had to leave to the direct one
};

/// The linear systems that Newton's method and linear statics meet: (K + terms) u = f, with K the second derivative of
/// the elastic energy at a body's positions and u zero where it is supported. The seam between the equations and the
/// ways to solve them. The same bits for any number of threads.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Takes K at body.positions; with `definite`, each brick's K without its negative curvature, and
  /// motions that meet no resistance held by a stiffness below rounding. Body and terms have to stay as they are until
  /// the last solve(). False where the matrix is seen not to be positive definite, and then solve() must not be called.
  virtual bool linearize(const Body& body, const Supports& supports, bool definite, const StepTerms& terms) = 0;

  /// u (3 m, m) for the forces f (3 m, N); entries of f at supports are ignored. An iterative solver stops where the
  /// forces left over are `tolerance` of f (Euclidean norms). Empty where the matrix turns out not to be positive
  /// definite, or no answer is found.
  [[nodiscard]] virtual Eigen::VectorXd solve(const Eigen::VectorXd& forces, double tolerance) = 0;

  /// After a solve() that met a direction of negative curvature: what it had found before, and that direction as far
  /// as a curvature of the opposite sign would lead; the energy falls along both (Steihaug, SIAM J. Numer. Anal. 20,
  /// 1983). Otherwise, and from solvers that meet none, empty.
  [[nodiscard]] virtual Eigen::VectorXd downhill() const { return {}; }

  [[nodiscard]] virtual SolveReport report() const = 0;
};

/// One that can be a part of a larger system.
class IterativeSolver : public LinearSolver {
 public:
  /// (K + terms) u, N, without what is coupled; zero at supports.
  virtual void multiply(const Eigen::VectorXd& u, Eigen::VectorXd& forces) = 0;
  /// About the u for the forces, zero at supports. Symmetric and positive definite but for rounding.
  virtual void precondition(const Eigen::VectorXd& forces, Eigen::VectorXd& u) = 0;
};

/// Sparse Cholesky (CHOLMOD, supernodal): exact, for small bodies and as the oracle of others. Memory and time grow
/// faster than the body: some 250 MB and 2 s at 16 000 bricks.
[[nodiscard]] std::unique_ptr<LinearSolver> make_direct_solver();

/// Conjugate gradients preconditioned by geometric multigrid on the hierarchy of bricks: Galerkin's coarse bricks, each
/// of up to eight connected children, Chebyshev-Jacobi smoothing, the cycle in single precision, the products
/// outside it exact and in double. Time and memory (some 2 kB a brick) grow with the body. Gives up after
/// `max_iterations` of a solve.
[[nodiscard]] std::unique_ptr<IterativeSolver> make_multigrid_solver(int max_iterations = 150);

/// The direct solver where the body is not too large for it, else multigrid.
[[nodiscard]] std::unique_ptr<LinearSolver> make_robust_solver(const Body& body);

/// The quicker of the two for the body's size; where multigrid gives up the direct solver answers, if the body is not
/// too large for it.
[[nodiscard]] std::unique_ptr<LinearSolver> make_default_solver();

/// When conjugate gradients end.
struct StoppingCriterion {
  double tolerance;               // of the forces, left over
  double fallback_tolerance = 0;  // likewise, where the iterations run out
  int max_iterations;
};

/// Solves A x = forces by flexible conjugate gradients (Polak-Ribiere: rounding makes a preconditioner not quite the
/// same in each iteration), by multiply(x, product) and precondition(residual, correction). `forces` and what these
/// give are zero where A is. Empty where A is not positive definite, or no answer is found. `downhill`: as
/// LinearSolver::downhill() has it.
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
