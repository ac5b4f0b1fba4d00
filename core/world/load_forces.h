#pragma once
#include "core/world/world.h"

namespace sprung {

/// The forces of an actor's loads and of the wind on its nodes. What presses on the skin is computed anew every few
/// steps only: it changes as slowly as the skin turns.
class LoadForces {
 public:
  /// Both have to outlive it.
  LoadForces(const SoftBody& actor, const World& world) : actor_(actor), world_(world) {}

  /// Whether there is anything at all.
  [[nodiscard]] bool any() const { return !actor_.loads.empty() || world_.wind.blows(); }

  /// For the positions and velocities that the body has; m x 3, N. Call once a step.
  [[nodiscard]] const Points& forces();
  /// The same without muscles, for steps that have those as an energy.
  [[nodiscard]] const Points& forces_beside_muscles();

 private:
  void find_skin_forces();
  void add_muscle(const Muscle& muscle);

  const SoftBody& actor_;
  const World& world_;
  Points skin_forces_;  // m x 3, N
  Points forces_;       // m x 3, N
  int steps_to_update_ = 0;
};

}  // namespace sprung
