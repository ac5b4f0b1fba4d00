#pragma once
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "app/film/field_colors.h"
#include "render/renderer.h"

namespace sprung {

/// A colour as the renderer expects it: sRGB, 0 to 1.
[[nodiscard]] Eigen::Vector3f srgb(const Color& color);

/// The shape of a skin embedded in bricks, for these positions of their nodes (m).
[[nodiscard]] SkinShape shape_of(const BrickGrid& grid, const Skin& skin, const Embedding& embedding,
                                 const Points& nodes, SkinInterpolation interpolation = SkinInterpolation::kBricks);

/// The shape of an obstacle's skin at that time of the film (s).
[[nodiscard]] SkinShape shape_of(const StageObstacle& obstacle, const Skin& skin, double time);

/// Everything that a film shows, in any frame or between two: skins, or bricks or springs instead, obstacles, and
/// overlays.
class FilmStage {
 public:
  /// All must outlive it. `pixel`: size of a pixel at the nearest body, m; skins of coarse meshes are drawn smooth to
  /// within a fraction of it, if the scene asks for that; infinity: never. `ranges`: of the colours; none: those of the
  /// film.
  FilmStage(const Film& film, const Simulation& simulation, const Recording& recording,
            double pixel = std::numeric_limits<double>::infinity(), ColorRanges ranges = {});

  /// `bounds`: of the whole motion, m. Lit by the studio if there is no environment.
  [[nodiscard]] Stage stage(const AlignedBox& bounds, const std::optional<Environment>& environment) const;
  /// One shape for each of the stage's skins, interpolated by `part` (0 to 1) towards the next frame.
  [[nodiscard]] std::vector<SkinShape> shapes(std::size_t frame, double part = 0) const;
  /// Empty if colours show no field.
  [[nodiscard]] ColorRanges color_ranges() const;
  [[nodiscard]] std::optional<Legend> legend(std::size_t frame) const;

 private:
  /// The state of all bodies at one time.
  struct Moment {
    std::size_t frame;
    double time;                // s
    std::vector<Points> nodes;  // by body
  };
  /// A skin of the stage and its shape over time.
  struct StageItem {
    std::shared_ptr<const Skin> skin;
    Eigen::Vector3f color;  // sRGB
    Look look;
    bool is_ghost;
    int id;  // Stage::ids: bodies from 1, then obstacles; 0: overlays
    std::function<SkinShape(const Moment&)> shape;
    double mean_free_path = 0;  // m
  };

  /// The skin that is drawn for a body, and its embedding.
  struct DrawnSkin {
    std::shared_ptr<const Skin> skin;
    std::shared_ptr<const Embedding> embedding;
  };

  [[nodiscard]] bool is_smooth() const;
  [[nodiscard]] DrawnSkin drawn_skin(const SoftBody& body);
  [[nodiscard]] Moment moment(std::size_t frame, double part) const;
  [[nodiscard]] Eigen::VectorXd map_coordinates(const Moment& moment, std::size_t body) const;
  void add_skin(std::size_t body);
  void add_bricks(std::size_t body);
  void add_springs(std::size_t body);
  void add_nodes(std::size_t body);
  void add_pins(std::size_t body);
  void add_ghost(std::size_t body);
  void add_obstacle(const StageObstacle& obstacle, int id);
  void add_trace(const ProbeTrack& track, const Eigen::Vector3f& color);
  void add_contacts();
  void add_balls(std::size_t body, std::vector<int> nodes, double radius, const Eigen::Vector3f& color);
  void add_edges(std::size_t body);
  [[nodiscard]] ColorRanges stretch_ranges() const;

  const Film& film_;
  const Simulation& simulation_;
  const Recording& recording_;
  FieldColors colors_;
  double pixel_;
  std::map<const SurfaceMesh*, DrawnSkin> smooth_;  // by the surface of a body, which copies share
  ColorRanges stretches_;                           // of springs at the ends of their colours
  std::vector<StageItem> items_;
};

}  // namespace sprung
