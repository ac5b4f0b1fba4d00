#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/film/field_colors.h"
#include "render/renderer.h"

namespace sprung {

/// What the ends of colours stand for, SI.
struct ColorRange {
  double low;
  double high;
};

/// Everything that a film shows: skins or what stands for them, obstacles, and what is laid over them; in any frame, or
/// between two.
class FilmStage {
 public:
  /// All three outlive it.
  FilmStage(const Film& scene, const Simulation& simulation, const Recording& recording);

  /// `bounds` of the whole motion, m.
  [[nodiscard]] Stage stage(const AlignedBox& bounds) const;
  /// One shape for each of the stage's skins. `part` of the way to the next frame, 0 to 1.
  [[nodiscard]] std::vector<SkinShape> shapes(std::size_t frame, double part = 0) const;
  /// Of colours that stand for something.
  [[nodiscard]] std::optional<ColorRange> color_range() const;
  [[nodiscard]] std::optional<Legend> legend() const;

 private:
  /// How the nodes of every actor stand.
  struct Moment {
    std::size_t frame;
    double time;                // s
    std::vector<Points> nodes;  // by actor
  };
  /// A skin of the stage and what becomes of it.
  struct StageItem {
    std::shared_ptr<const Skin> skin;
    Eigen::Vector3f color;  // sRGB
    Look look;
    bool is_ghost;
    int id;  // in passes: bodies from 1, then obstacles; 0: neither
    std::function<SkinShape(const Moment&)> shape;
  };

  [[nodiscard]] Moment moment(std::size_t frame, double part) const;
  [[nodiscard]] Eigen::VectorXd shares(const Moment& moment, std::size_t actor) const;
  void add_skin(std::size_t actor);
  void add_bricks(std::size_t actor);
  void add_springs(std::size_t actor);
  void add_nodes(std::size_t actor);
  void add_pins(std::size_t actor);
  void add_ghost(std::size_t actor);
  void add_obstacle(const StageObstacle& obstacle, int id);
  void add_trace(const ProbeTrack& track, const Eigen::Vector3f& color);
  void add_contacts();
  void add_balls(std::size_t actor, std::vector<int> nodes, double radius, const Eigen::Vector3f& color);
  [[nodiscard]] double furthest_stretch() const;

  const Film& scene_;
  const Simulation& simulation_;
  const Recording& recording_;
  FieldColors colors_;
  double stretch_ = 0;  // of springs, to both sides: the ends of their colours
  std::vector<StageItem> items_;
};

}  // namespace sprung
