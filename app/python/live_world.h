#pragma once
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "core/simulation/motion.h"
#include "core/simulation/scene.h"
#include "core/simulation/simulation.h"
#include "render/image/image.h"

namespace sprung {

/// A scene that a script builds, moves and reads while it holds views of its state: the memory of a body's state,
/// bricks and skin never moves. If a call throws, the world is left unchanged.
class LiveWorld {
 public:
  /// Called regularly while the world moves; may throw to stop it.
  using Between = std::function<void()>;

  /// gravity in m/s^2; ground: the height of level ground, m, or none. Throws Error(kBadInput).
  LiveWorld(const Vec3& gravity, std::optional<double> ground);
  /// Everything in the scene, at time 0. Throws Error(kBadInput).
  explicit LiveWorld(Scene scene);

  /// A thread must hold this lock while it uses the world.
  [[nodiscard]] std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }

  /// Adds a body for every solid; returns their rows. Throws Error(kBadInput).
  std::vector<std::size_t> add(const SceneBody& body);

  /// Advances by `duration` (s), with the scheme, pins, loads and obstacles of the scene. Throws Error(kBadInput,
  /// kDiverged).
  void advance(double duration, const Between& between);
  /// Exactly `count` explicit steps of `dt` (s); pins and loads do not follow their keyframes. Throws Error(kBadInput,
  /// kDiverged).
  void step(double dt, long count, const Between& between);
  /// Moves a body into equilibrium under gravity and the constant forces of the scene, its pinned nodes fixed where
  /// they are; `linear`: for small displacements. Throws Error(kBadInput) if no node is pinned, or the scene has other
  /// loads, Error(kDiverged).
  void settle(std::size_t body, bool linear, const Between& between);
  /// Fixes these nodes where they are, and no others. Throws Error(kBadInput).
  void pin(std::size_t body, const std::vector<long>& nodes);

  /// A picture of all bodies from azimuth and elevation (degrees). Throws Error(kUsage, kBadInput, kFailed).
  [[nodiscard]] Image draw(int width, int height, double azimuth, double elevation) const;
  /// Vertices of a body's skin, v x 3, m.
  [[nodiscard]] Points skin_positions(std::size_t row) const;

  /// Longest stable explicit step in the present state, s; infinite without bodies.
  [[nodiscard]] double stable_step() const { return sprung::stable_step(simulation_.world); }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] std::size_t body_count() const { return simulation_.world.bodies.size(); }
  [[nodiscard]] SoftBody& body(std::size_t row) { return simulation_.world.bodies[row]; }

 private:
  /// Runs `work`, which may reallocate states, and moves them back into their old memory.
  template <class Work>
  void keep_memory(const Work& work);
  /// The integrator of the present bodies.
  SceneMotion& motion();

  Scene scene_;
  Simulation simulation_;
  std::optional<SceneMotion> motion_;
  double time_ = 0;  // s
  std::mutex mutex_;
};

}  // namespace sprung
