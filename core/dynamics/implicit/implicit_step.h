#pragma once
#include <vector>

#include "core/contact/skin_potential.h"
#include "core/dynamics/implicit/implicit_body.h"

namespace sprung {

/// How the search for minima went so far.
struct ImplicitCounts {
  long steps = 0;
  long iterations = 0;
  SolveReport coupled;  // systems of several bodies
};

/// One implicit step of a group of bodies, see ImplicitMotion: a minimum by Newton's method with a line search.
class ImplicitStep {
 public:
  /// By body of the group; `glue` by its rows. All have to outlive it.
  ImplicitStep(const World& world, std::vector<ImplicitBody*> bodies, const Group& group,
               const std::vector<GluedPoint>& glue, const ImplicitOptions& options, double dt);

  /// Obstacles have moved by themselves for `elapsed` (s) when it begins. False where no minimum was found; the bodies
  /// are then as before.
  [[nodiscard]] bool make(double elapsed, ImplicitCounts& counts);

 private:
  void begin(double elapsed);
  bool find_minimum(ImplicitCounts& counts);
  bool descend_to_minimum(ImplicitCounts& counts);
  [[nodiscard]] bool settle_friction();
  /// The potential (J) at the positions; forces into the bodies.
  double evaluate();
  /// Moves on from that potential, and leaves the new one and its forces.
  bool newton_step(double& potential, ImplicitCounts& counts);
  [[nodiscard]] Eigen::VectorXd direction(ImplicitCounts& counts);
  [[nodiscard]] Eigen::VectorXd direction(bool definite, const std::vector<Coupling>& couplings,
                                          ImplicitCounts& counts);
  [[nodiscard]] Eigen::VectorXd direction_apart(bool definite);
  [[nodiscard]] Eigen::VectorXd all_forces() const;
  void move_from(const std::vector<Points>& starts, const Eigen::VectorXd& way);

  std::vector<ImplicitBody*> bodies_;
  std::vector<Eigen::VectorXd*> pushed_in_;
  const ImplicitOptions& options_;
  double dt_;
  SkinPotential skins_;
  std::vector<Points*> forces_;
};

}  // namespace sprung
