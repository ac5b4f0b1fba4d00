#pragma once
#include <map>
#include <optional>
#include <vector>

#include "core/dynamics/integrator_state.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/simulation/simulation.h"
#include "core/world/keyframes.h"

namespace sprung {

/// Forces, muscles, wind and gravity of a scene over time.
class LoadDriver {
 public:
  /// Both have to outlive it.
  LoadDriver(const Scene& scene, Simulation& simulation);

  /// When keyframes are, s.
  [[nodiscard]] const std::vector<double>& moments() const { return moments_; }

  /// Longest time (s) for which what acts may be taken as even around `time`; infinite while nothing changes.
  [[nodiscard]] double longest_piece(double time) const;

  /// Lets the world have what acts from `begin` to `end` (s): what it is in the middle.
  void aim(double begin, double end);

 private:
  /// A number or vector over time.
  class Curve {
   public:
    explicit Curve(const StrengthCurve& course);
    explicit Curve(const std::vector<GravityKeyframe>& keyframes);
    [[nodiscard]] Vec3 at(double time) const { return movement_.placement(time).shift; }
    [[nodiscard]] double strength(double time) const { return at(time).x(); }
    [[nodiscard]] bool changes_at(double time) const;
    void add_moments(std::vector<double>& moments) const;

   private:
    Movement movement_;  // whose shift is the value
  };
  /// Of one body of the scene.
  struct BodyCurves {
    std::vector<Curve> forces;
    std::vector<Curve> muscles;
    std::vector<double> volumes;  // m^3, all that each force acts on
  };

  [[nodiscard]] Loads loads_at(std::size_t actor, double time) const;

  const Scene& scene_;
  Simulation& simulation_;
  std::vector<Curve> gravity_;  // one, or none: it stays
  std::vector<Curve> wind_;     // the same
  std::vector<BodyCurves> bodies_;
  std::vector<double> moments_;
};

/// Of the scene's steady forces on the nodes of an actor (m x 3, N); pressures are left out.
[[nodiscard]] Points steady_forces(const Scene& scene, const Simulation& simulation, std::size_t actor);

/// Catches nodes, carries them and lets them go, as the pins of a scene say, while a world is in motion; moves its
/// obstacles, and lets its loads act. A pin that catches later than at the start takes its nodes where they then are,
/// and turns them about their middle.
class SceneDriver {
 public:
  /// Both have to outlive it. What acts at the start acts from now on.
  SceneDriver(const Scene& scene, Simulation& simulation);

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
  struct Capture {
    double time = 0;             // s
    Vec3 centre = Vec3::Zero();  // m
    Points positions;            // m, in the order of the nodes
  };
  /// A pin and those of its nodes that belong to one actor.
  struct PinMotion {
    const Pin* source;
    const PinnedNodes* pinned;
    Movement movement;
    std::optional<Capture> capture{};
  };

  void carry(PinMotion& pin, SoftBody& actor, double begin, double end, std::map<int, KinematicNode>& held) const;

  const Scene& scene_;
  Simulation& simulation_;
  LoadDriver loads_;
  std::vector<std::vector<PinMotion>> pins_;  // by actor
  std::vector<double> moments_;               // s, rising: where pieces end
};

/// The way of a pin: its keyframes, or even from the start of the film to its end.
[[nodiscard]] Movement movement_of(const Pin& pin, const Scene& scene);

/// How far pins that hold from the start have carried each node of an actor (m x 3, m) by a time (s) of the film; zero
/// along free axes. With `small`, as if the movement were infinitely small: turned nodes move along tangents.
[[nodiscard]] Points pin_movements(const Scene& scene, const Simulation& simulation, std::size_t actor, double time,
                                   bool small);

/// What the pins of an actor hold.
[[nodiscard]] Supports supports_of(const SoftBody& actor);

}  // namespace sprung
