#pragma once
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/simulation/soft_body.h"
#include "render/image/image.h"

namespace sprung {

/// A world that a script builds, moves and looks at while others hold views of its state: the memory of a body's state,
/// bricks and skin stays where it is as long as the world is there. Where something throws, the world is as it was.
class LiveWorld {
 public:
  /// Called every now and then while the world moves; may throw to stop it.
  using Between = std::function<void()>;

  /// gravity in m/s^2; ground: the height of level ground, m, or none. Throws Error(kBadInput).
  LiveWorld(const Vec3& gravity, std::optional<double> ground);

  /// A script has several threads: one at a time does anything here, and holds this meanwhile.
  [[nodiscard]] std::unique_lock<std::mutex> take_turn() { return std::unique_lock(turn_); }

  /// Adds every solid of a mesh, `name` of it for messages; returns their rows. Throws Error(kBadInput).
  std::vector<std::size_t> add(SurfaceMesh mesh, const std::string& name, const FillOptions& options);

  /// `duration` s by steps that are stable, halved where that is not enough. Throws Error(kBadInput, kDiverged).
  void advance(double duration, const Between& between);
  /// `count` explicit steps of `dt` (s) as they are. Throws Error(kBadInput, kDiverged).
  void step(double dt, long count, const Between& between);
  /// Moves a body into equilibrium with gravity and its pinned nodes; `linear`: for small displacements.
  /// Throws Error(kBadInput) where nothing holds it, Error(kDiverged).
  void settle(std::size_t body, bool linear);
  /// Holds these nodes where they are, and no others. Throws Error(kBadInput).
  void pin(std::size_t body, const std::vector<long>& nodes);

  /// A picture of all bodies from azimuth and elevation (degrees). Throws Error(kUsage, kBadInput, kFailed).
  [[nodiscard]] Image draw(int width, int height, double azimuth, double elevation) const;
  /// Vertices of a body's skin, v x 3, m.
  [[nodiscard]] Points skin_positions(std::size_t body) const;

  /// Longest explicit step that is stable now, s; infinite where there is no body.
  [[nodiscard]] double stable_step() const { return sprung::stable_step(world_); }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] Body& body(std::size_t row) { return world_.actors[row].body; }
  [[nodiscard]] const Skin& skin(std::size_t row) const { return drawn_[row].skin; }

 private:
  struct Drawn {
    Skin skin;
    Embedding embedding;
    double guard;  // of the body's volume, before it was braced
  };
  /// Does `work`, with the memory of all bodies' states where it was before.
  template <class Work>
  void keep_memory(const Work& work);
  void stiffen_volume_guards();

  World world_;
  std::deque<Drawn> drawn_;  // by actor
  double time_ = 0;          // s
  bool is_braced_ = false;
  std::mutex turn_;
};

}  // namespace sprung
