#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/dynamics/integrator_state.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/world/world.h"

namespace sprung {

/// How a world is moved by implicit steps.
enum class ImplicitScheme {
  kEuler,  // backward Euler: first order; damps what it does not resolve, and slow motion too
  kBdf2    // second order
};

struct ImplicitOptions {
  ImplicitScheme scheme = ImplicitScheme::kBdf2;
  double tolerance = 1e-4;  // forces left over on a body in a step, relative to those at work (Euclidean norms)
  int max_iterations = 30;  // of Newton's method
};

class ImplicitBody;
struct ImplicitCounts;

/// Moves a world by implicit steps, which may be as long as the motion that is to be seen allows, however stiff the
/// bricks. Each step is the minimum over the positions x of the incremental potential
///   W(x) + muscles(x) + 1/(2 s^2) |x - x0 - s v0 - s^2 g|_M^2 + alpha/(2 s) |x - x0|_M^2 + beta/(2 s) |x - x0|_K^2 +
///   contacts(x)
/// by Newton's method with a line search; K is the stiffness of the springs along themselves where the step before
/// points to. Backward Euler: s = dt, x0 and v0 the state. BDF2: s = 2/3 dt, x0 = (4 x - x_before) / 3, v0 likewise;
/// its first step, and one after a step cut short, is backward Euler's.
/// BDF2 and not generalised-alpha: it needs no accelerations, which jump where contact sets in, it damps the
/// frequencies it does not resolve without a parameter to choose, and each step is a minimum of the same form.
/// g holds all other loads, as they are when the step begins. Contact with
/// obstacles is ObstaclePotential's, that of bodies with each other and themselves, and glue, SkinPotential's: what may
/// touch within a step is one minimum. A step is cut where surfaces that are near each other would come closer by more
/// than half a brick. Deterministic for any number of threads. Body velocities are those of the scheme after each step.
class ImplicitMotion {
 public:
  /// Throws Error(kBadInput) where check_implicit_support() finds what it cannot do. The world must outlive it.
  ImplicitMotion(World& world, const ImplicitOptions& options);
  ~ImplicitMotion();

  /// Moves the world, its obstacles too, by `steps` of dt seconds. A step that finds no minimum, or gives energy from
  /// nowhere, is made in two halves, and so on. Throws Diverged naming time and body where that does not help.
  void advance(double dt, long steps, double time);

  /// What the next step depends on beside positions and velocities: those of the step before.
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
    double elapsed;  // s, since obstacles were where the world has them
    double dt;       // s
    double begin;    // s, when obstacles were there
  };
  void advance(const Together& group, const Span& span);
  std::string try_step(const Together& group, double elapsed, double dt);

  World& world_;
  ImplicitOptions options_;
  long halvings_ = 0;
  std::unique_ptr<ImplicitCounts> counts_;
  std::vector<std::unique_ptr<ImplicitBody>> bodies_;  // by body
};

/// What a world has that implicit steps cannot do: obstacles with a restitution. Empty: nothing.
[[nodiscard]] std::string check_implicit_support(const World& world);

}  // namespace sprung
