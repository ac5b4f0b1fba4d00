#pragma once
#include <optional>

#include "app/scene/film.h"
#include "app/scene/scene_render.h"
#include "core/simulation/recorder.h"
#include "render/image/legend.h"

namespace sprung {

/// A field at the nodes of one actor in one frame, SI: displacement from the start (m), speed by differences between
/// frames (m/s), largest principal stretch, von Mises strain, von Mises stress (Pa), volume over volume at rest, fill,
/// or Young's modulus (Pa) for kRegion. Not for kSkin.
[[nodiscard]] Eigen::VectorXd field_values(Field field, const Simulation& simulation, const Recording& recording,
                                           std::size_t frame, std::size_t actor, double fps);

/// Whether it differs from frame to frame.
[[nodiscard]] bool is_moving(Field field);

/// What the colours of a film stand for: the same in all of its frames.
class FieldColors {
 public:
  /// Looks at all frames for the range, unless the scene has it. `recording` outlives it.
  FieldColors(const Film& scene, const Simulation& simulation, const Recording& recording);

  [[nodiscard]] bool is_mapped() const { return field_ != Field::kSkin; }
  [[nodiscard]] ColorMap map() const { return map_; }
  [[nodiscard]] double low() const { return low_; }    // SI; what the first colour stands for
  [[nodiscard]] double high() const { return high_; }  // the last
  /// Where the nodes of an actor are on the colour map in a frame, 0 to 1; beyond where they are outside the range.
  [[nodiscard]] Eigen::VectorXd shares(std::size_t frame, std::size_t actor) const;
  /// In a unit in which its numbers are short.
  [[nodiscard]] Legend legend() const;

 private:
  void find_range();

  Field field_;
  ColorMap map_;
  const Simulation& simulation_;
  const Recording& recording_;
  double fps_;
  double low_ = 0;  // SI
  double high_ = 0;
};

}  // namespace sprung
