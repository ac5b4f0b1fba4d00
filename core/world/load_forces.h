#pragma once
#include "core/world/world.h"

namespace sprung {

/// The surface that pressures act on: the contact surface of a body that may touch others, else its drawn skin.
struct LoadedSkin {
  const Embedding& points;
  const Triangles& triangles;
};

[[nodiscard]] LoadedSkin loaded_skin(const SoftBody& body);

/// The nodal forces of pressures on a body at its current positions; m x 3, N.
[[nodiscard]] Points pressure_forces(const SoftBody& body, const std::vector<SkinPressure>& pressures);

/// The nodal forces of a body's loads and of the wind. Those on the skin are updated every few steps only, since they
/// change as slowly as the skin turns.
class LoadForces {
 public:
  /// Both must outlive it.
  LoadForces(const SoftBody& body, const World& world) : body_(body), world_(world) {}

  /// Returns whether there are any loads or wind.
  [[nodiscard]] bool any() const { return !body_.loads.empty() || world_.wind.blows(); }

  /// For the body's current positions and velocities; m x 3, N. Call once per step.
  [[nodiscard]] const Points& forces();
  /// The same without muscles, for steps that treat those as an energy.
  [[nodiscard]] const Points& forces_beside_muscles();

 private:
  void find_skin_forces();
  void add_muscle(const Muscle& muscle);

  const SoftBody& body_;
  const World& world_;
  Points skin_forces_;  // m x 3, N
  Points forces_;       // m x 3, N
  int steps_to_update_ = 0;
};

}  // namespace sprung
