#pragma once
#include <map>
#include <optional>
#include <vector>

#include "core/dynamics/integrator_state.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/simulation/body_loads.h"
#include "core/simulation/simulation.h"
#include "core/simulation/skin_supports.h"
#include "core/world/keyframes.h"

namespace sprung {

/// The forces, muscles, wind and gravity of a scene over time.
class LoadDriver {
 public:
  /// Both must outlive it.
  LoadDriver(const Scene& scene, Simulation& simulation);

  /// The times of keyframes, s.
  [[nodiscard]] const std::vector<double>& moments() const { return moments_; }

  /// The longest interval (s) around `time` on which loads may be taken as constant; infinite while nothing changes.
  [[nodiscard]] double longest_piece(double time) const;

  /// Sets the world's loads from `begin` to `end` (s) to those at the midpoint.
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
  /// The curves of one body of the scene.
  struct BodyCurves {
    std::vector<Curve> forces;
    std::vector<Curve> muscles;
  };

  [[nodiscard]] Loads loads_at(std::size_t body, double time) const;

  const Scene& scene_;
  Simulation& simulation_;
  std::vector<Curve> gravity_;  // one, or none: constant
  std::vector<Curve> wind_;     // the same
  std::vector<BodyCurves> bodies_;
  std::vector<std::vector<ForcedWhole>> wholes_;  // by body of the world
  std::vector<double> moments_;
};

/// Drives a moving world by its scene: pins catch, move and release nodes, obstacles move, loads act. A pin that
/// catches its nodes later than at the start takes them where they are and rotates them about their centroid.
class SceneDriver {
 public:
  /// Both must outlive it. Applies the loads of the start.
  SceneDriver(const Scene& scene, Simulation& simulation);

  /// Divides the time from `begin` to `end` into pieces in which no pin catches or releases its nodes, no keyframe is
  /// passed and loads hardly change. Returns their ends (s, ascending, the last one is `end`).
  [[nodiscard]] std::vector<double> pieces(double begin, double end) const;

  /// Sets the loads and pinned nodes from `begin` to `end` (s), and the constant velocities that take pinned nodes and
  /// obstacles exactly to their positions at `end`.
  void aim(double begin, double end);

  /// The state of the pins that hold nodes now.
  void serialize(IntegratorState& state);

 private:
  /// The nodes, or the points of the skin, as a pin caught them.
  struct Capture {
    double time = 0;             // s
    Vec3 centre = Vec3::Zero();  // m
    Points positions;            // m, in the order of the nodes or points
  };
  struct PinMotion {
    const Pin* source;
    Movement movement;
    std::optional<Capture> capture{};
  };
  /// A pin and its nodes of one body.
  struct NodePin {
    PinMotion motion;
    const PinnedNodes* pinned;
  };
  /// A pin and its skin of one body.
  struct SkinPin {
    PinMotion motion;
    const PinnedSkin* skin;
    std::vector<SpringSupport> springs;  // at rest
  };

  void drive_nodes(std::size_t row, double begin, double end);
  void drive_skins(std::size_t row, double begin, double end);
  void carry(NodePin& pin, SoftBody& body, double begin, double end, std::map<int, KinematicNode>& pinned) const;

  const Scene& scene_;
  Simulation& simulation_;
  LoadDriver loads_;
  std::vector<std::vector<NodePin>> pins_;       // by body
  std::vector<std::vector<SkinPin>> skin_pins_;  // by body, as its foundations
  std::vector<double> moments_;                  // s, ascending: where pieces end
};

/// The movement of a pin: by its keyframes, or linear from the start of the film to its end.
[[nodiscard]] Movement movement_of(const Pin& pin, const Scene& scene);

/// The centre of rotation (m) of a pin at a time (s) of the film; with `small`, at rest. `at_rest`: m.
[[nodiscard]] Vec3 centre_of(const Vec3& at_rest, const Pin& pin, const Scene& scene, double time, bool small);

/// The displacement of each node of a body (m x 3, m) by pins that hold from the start, at a time (s) of the film; zero
/// along free axes. With `small`, to first order: rotated nodes move along tangents.
[[nodiscard]] Points pin_movements(const Scene& scene, const Simulation& simulation, std::size_t body, double time,
                                   bool small);

/// The supports by the pins of a body, and by its foundations.
[[nodiscard]] Supports supports_of(const SoftBody& body);

}  // namespace sprung
