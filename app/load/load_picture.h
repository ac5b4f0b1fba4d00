#pragma once
#include <array>
#include <memory>
#include <optional>

#include "app/load/load_answer_text.h"
#include "app/load/sight_lines.h"
#include "app/load/symbols.h"
#include "render/image/image.h"
#include "render/renderer.h"

namespace sprung {

/// Draws a loaded part: its magnified shape coloured by von Mises stress, a ghost of its rest shape, arrows where loads
/// act, cones at supports, and the location of the largest stress.
class LoadPicture {
 public:
  /// `solution`: the finest. All must outlive it.
  LoadPicture(const PartReport& report, const PartSolution& solution, int width = 1600, int height = 900);

  /// Seen from the side of the largest stress, as large as fits.
  [[nodiscard]] Image draw();
  /// Rotated from there by some degrees about the vertical, as large as fits at any angle.
  [[nodiscard]] Image draw_turned(double degrees);

  /// The factor by which displacements are drawn.
  [[nodiscard]] double magnification() const { return magnification_; }

 private:
  /// A point of a drawn skin.
  struct Spot {
    Vec3 position;  // m
    Vec3 outward;   // unit
  };

  void add_bodies();
  void add_supports();
  void add_loads();
  void add_worst_place();
  void add(Skin skin, const Eigen::Vector3f& color, bool is_ghost);
  /// Spread over the parts of the skins that a face covers.
  [[nodiscard]] std::vector<Spot> spots_on(const PartFace& face) const;
  /// Returns whether it is visible from far away in the direction `viewer` (unit).
  [[nodiscard]] bool is_seen(const Spot& spot, const Vec3& viewer) const;
  void choose_direction();
  /// A camera that sees everything, at any rotation about the vertical if it `turns`.
  [[nodiscard]] Camera framed(bool turns) const;
  [[nodiscard]] Image draw(const Camera& camera);
  /// The axes of the file, at the lower left of the picture.
  void add_axes();
  void place_axes(const Camera& camera);
  /// A point of the stage in the picture, pixels from the top left.
  [[nodiscard]] Eigen::Vector2d projected(const Vec3& position, const Camera& camera) const;
  void write_labels(Image& image, const Camera& camera) const;

  const PartReport& report_;
  const PartSolution& solution_;
  int width_;
  int height_;
  double magnification_ = 1;
  double highest_ = 0;           // Pa, of the last colour
  double longest_ = 0;           // m, side of the part
  std::vector<Points> drawn_;    // by body: skin vertices as drawn, m
  std::vector<Points> at_rest_;  // by body: in the frame of LoadedBody, m
  std::vector<Skin> skins_;      // of the stage
  std::vector<SkinShape> shapes_;
  Stage stage_;
  Points axes_;                    // their vertices, m, of length 1
  std::array<Vec3, 3> axis_tips_;  // as drawn
  double azimuth_ = 0;             // degrees
  double elevation_ = 0;           // degrees
  Vec3 middle_ = Vec3::Zero();
  std::optional<SightLines> sight_;  // to the bodies
  std::optional<Spot> worst_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace sprung
