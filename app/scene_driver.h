#pragma once
#include <map>
#include <optional>
#include <vector>

#include "app/build_world.h"
#include "app/load_driver.h"
#include "core/dynamics/integrator_state.h"
#include "core/world/keyframes.h"

namespace sprung {

/// Catches nodes, carries them and lets them go, as the pins of a scene say, while a world is in motion; moves its
/// obstacles, and lets its loads act. A pin that catches later than at the start takes its nodes where they then are,
/// and turns them about their middle.
class SceneDriver {
 public:
  /// Both have to outlive it. What acts at the start acts from now on.
  SceneDriver(const Scene& scene, Production& production);

  /// Ends (s, rising, the last is `end`) of the pieces that the time from `begin` to `end` falls into: between them no
  /// pin catches, lets go or comes through a keyframe, nor anything else through one, and loads hardly change.
  [[nodiscard]] std::vector<double> pieces(double begin, double end) const;

  /// Sets what acts and what is held from `begin` to `end` (s), and the even velocities that bring it, and obstacles,
  /// exactly to where they belong.
  void aim(double begin, double end);

  /// How nodes were caught by the pins that hold now.
  void serialize(IntegratorState& state);

 private:
  /// Nodes as a pin caught them.
  struct Catch {
    double time = 0;             // s
    Vec3 centre = Vec3::Zero();  // m
    Points positions;            // m, in the order of the nodes
  };
  /// A pin and those of its nodes that belong to one actor.
  struct FrictionPotential {
    const Pin* pin;
    const PinnedNodes* pinned;
    Movement movement;
    std::optional<Catch> caught{};
  };

  void carry(FrictionPotential& grip, Actor& actor, double begin, double end, std::map<int, KinematicNode>& held) const;

  const Scene& scene_;
  Production& production_;
  LoadDriver loads_;
  std::vector<std::vector<FrictionPotential>> grips_;  // by actor
  std::vector<double> moments_;                        // s, rising: where pieces end
};

}  // namespace sprung
