#pragma once
#include <vector>

#include "app/build_world.h"
#include "core/world/keyframes.h"

namespace sprung {

/// Forces, muscles, wind and gravity of a scene over time.
class LoadDriver {
 public:
  /// Both have to outlive it.
  LoadDriver(const Scene& scene, Production& production);

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
  Production& production_;
  std::vector<Curve> gravity_;  // one, or none: it stays
  std::vector<Curve> wind_;     // the same
  std::vector<BodyCurves> bodies_;
  std::vector<double> moments_;
};

/// Of the scene's steady forces on the nodes of an actor (m x 3, N); pressures are left out.
[[nodiscard]] Points steady_forces(const Scene& scene, const Production& production, std::size_t actor);

}  // namespace sprung
