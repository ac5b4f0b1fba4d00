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

/// A scene that a script builds, moves and looks at while others hold views of its state: the memory of a body's state,
/// bricks and skin stays where it is as long as the world is there. Where something throws, the world is as it was.
class LiveWorld {
 public:
  /// Called every now and then while the world moves; may throw to stop it.
  using Between = std::function<void()>;

  /// gravity in m/s^2; ground: the height of level ground, m, or none. Throws Error(kBadInput).
  LiveWorld(const Vec3& gravity, std::optional<double> ground);
  /// All that the scene has. Throws Error(kBadInput).
  explicit LiveWorld(Scene scene);

  /// A script has several threads: one at a time does anything here, and holds this meanwhile.
  [[nodiscard]] std::unique_lock<std::mutex> take_turn() { return std::unique_lock(turn_); }

  /// Adds every solid of a body; returns their rows. Throws Error(kBadInput).
  std::vector<std::size_t> add(const SceneBody& body);

  /// `duration` s by the scheme of the scene, as its pins, loads and obstacles say. Throws Error(kBadInput, kDiverged).
  void advance(double duration, const Between& between);
  /// `count` explicit steps of `dt` (s) as they are; pins and loads stay what they were. Throws Error(kBadInput,
  /// kDiverged).
  void step(double dt, long count, const Between& between);
  /// Moves a body into equilibrium with gravity and its pinned nodes, where those are; `linear`: for small
  /// displacements. Throws Error(kBadInput) where nothing holds it, Error(kDiverged).
  void settle(std::size_t body, bool linear);
  /// Holds these nodes where they are, and no others. Throws Error(kBadInput).
  void pin(std::size_t body, const std::vector<long>& nodes);

  /// A picture of all bodies from azimuth and elevation (degrees). Throws Error(kUsage, kBadInput, kFailed).
  [[nodiscard]] Image draw(int width, int height, double azimuth, double elevation) const;
  /// Vertices of a body's skin, v x 3, m.
  [[nodiscard]] Points skin_positions(std::size_t row) const;

  /// Longest explicit step that is stable now, s; infinite where there is no body.
  [[nodiscard]] double stable_step() const { return sprung::stable_step(simulation_.world); }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] std::size_t body_count() const { return simulation_.world.bodies.size(); }
  [[nodiscard]] SoftBody& body(std::size_t row) { return simulation_.world.bodies[row]; }

 private:
  /// Does `work`, with the memory of all bodies' states where it was before.
  template <class Work>
  void keep_memory(const Work& work);
  /// What moves the bodies that are there now.
  SceneMotion& motion();

  Scene scene_;
  Simulation simulation_;
  std::optional<SceneMotion> motion_;
  double time_ = 0;  // s
  std::mutex turn_;
};

}  // namespace sprung
