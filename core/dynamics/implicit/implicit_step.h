#pragma once
#include <vector>

#include "core/contact/skin_potential.h"
#include "core/dynamics/implicit/implicit_body.h"

namespace sprung {

/// Statistics of the minimisations so far.
struct ImplicitCounts {
  long steps = 0;
  long iterations = 0;
  SolveReport coupled;  // systems of several bodies
};

/// One implicit step of a group of bodies, see ImplicitMotion: a minimum by Newton's method with a line search.
class ImplicitStep {
 public:
  /// By body of the group; `glue` by its rows. All must outlive it.
  ImplicitStep(const World& world, std::vector<ImplicitBody*> bodies, const Group& group,
               const std::vector<GluedPoint>& glue, const ImplicitOptions& options, double dt);

  /// `elapsed`: how far obstacles have moved before it begins, s. False if no minimum was found; the bodies are then
  /// unchanged.
  [[nodiscard]] bool make(double elapsed, ImplicitCounts& counts);

 private:
  void begin(double elapsed);
  bool find_minimum(ImplicitCounts& counts);
  bool descend_to_minimum(ImplicitCounts& counts);
  [[nodiscard]] bool settle_friction();
  /// The potential (J) at the positions; stores the forces in the bodies.
  double evaluate();
  /// Takes a step from that potential, and leaves the new one and its forces.
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
