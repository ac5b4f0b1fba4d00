#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/dynamics/integrator_state.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/world/world.h"

namespace sprung {

/// The implicit time-stepping schemes.
enum class ImplicitScheme {
  kEuler,  // backward Euler: first order; damps what it does not resolve, and slow motion too
  kBdf2    // second order
};

struct ImplicitOptions {
  ImplicitScheme scheme = ImplicitScheme::kBdf2;
  double tolerance = 1e-4;  // residual forces on a body in a step, relative to those at work (Euclidean norms)
  int max_iterations = 30;  // of Newton's method
};

class ImplicitBody;
struct ImplicitCounts;

/// Moves a world by implicit steps, which may be as long as the motion of interest allows, however stiff the bricks.
/// Each step is the minimum over the positions x of the incremental potential
///   W(x) + muscles(x) + 1/(2 s^2) |x - x0 - s v0 - s^2 g|_M^2 + alpha/(2 s) |x - x0|_M^2 + beta/(2 s) |x - x0|_K^2 +
///   contacts(x)
/// by Newton's method with a line search; K is the axial stiffness of the springs at the positions predicted by the
/// previous step. Backward Euler: s = dt, x0 and v0 the state. BDF2: s = 2/3 dt, x0 = (4 x - x_before) / 3, v0
/// likewise; its first step, and one after a shortened step, is backward Euler's. BDF2 rather than generalised-alpha:
/// it needs no accelerations, which jump when contact sets in, it damps unresolved frequencies without a parameter to
/// choose, and each step is a minimum of the same form. g includes all other loads, at the beginning of the step.
/// Contact with obstacles is ObstaclePotential's, that of bodies with each other and themselves, and glue,
/// SkinPotential's: bodies that may touch within a step share one minimisation. A step is shortened if nearby surfaces
/// would approach by more than half a brick. Deterministic for any number of threads. Body velocities are those of the
/// scheme after each step.
class ImplicitMotion {
 public:
  /// Throws Error(kBadInput) if check_implicit_support() finds an unsupported feature. The world must outlive it.
  ImplicitMotion(World& world, const ImplicitOptions& options);
  ~ImplicitMotion();

  /// Moves the world, its obstacles too, by `steps` of dt seconds. A step that finds no minimum, or creates energy, is
  /// halved recursively. Throws Diverged naming time and body if that does not help.
  void advance(double dt, long steps, double time);

  /// The state besides positions and velocities that the next step depends on: those of the previous step.
  void serialize(IntegratorState& state);

  struct Report {
    SolveReport solves;
    long steps = 0;
    long newton_iterations = 0;
    long halvings = 0;
  };
  [[nodiscard]] Report report() const;

 private:
  struct Together;
  struct Span {
    double elapsed;  // s, since obstacles had the world's poses
    double dt;       // s
    double begin;    // s, when obstacles had them
  };
  void advance(const Together& group, const Span& span);
  std::string try_step(const Together& group, double elapsed, double dt);

  World& world_;
  ImplicitOptions options_;
  long halvings_ = 0;
  std::unique_ptr<ImplicitCounts> counts_;
  std::vector<std::unique_ptr<ImplicitBody>> bodies_;  // by body
};

/// The features of a world that implicit steps do not support: obstacles with a restitution. Empty: none.
[[nodiscard]] std::string check_implicit_support(const World& world);

}  // namespace sprung
