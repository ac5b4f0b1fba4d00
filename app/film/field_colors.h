#pragma once
#include <optional>

#include "app/scene/film.h"
#include "app/scene/scene_render.h"
#include "core/simulation/recorder.h"
#include "render/image/legend.h"

namespace sprung {

/// A field at the nodes of one body in one frame, SI: displacement from the first frame (m), speed by differences
/// between frames (m/s), largest principal stretch, von Mises strain, von Mises stress (Pa), volume over rest volume,
/// fill, or Young's modulus (Pa) for kRegion. Not for kSkin. `measure`: of the strain that the stress follows from.
[[nodiscard]] Eigen::VectorXd field_values(Field field, const Simulation& simulation, const Recording& recording,
                                           std::size_t frame, std::size_t actor, double fps,
                                           StrainMeasure measure = StrainMeasure::kFinite);

/// True where the field changes over time.
[[nodiscard]] bool is_moving(Field field);

/// Maps a field to colours, with one range for the whole film.
class FieldColors {
 public:
  /// Finds the range over all frames, unless the scene states it. All must outlive it.
  FieldColors(const Film& scene, const Simulation& simulation, const Recording& recording);

  [[nodiscard]] bool is_mapped() const { return field_ != Field::kSkin; }
  [[nodiscard]] ColorMap map() const { return map_; }
  [[nodiscard]] double low() const { return low_; }    // SI, first colour
  [[nodiscard]] double high() const { return high_; }  // last colour
  /// Coordinates of a body's nodes on the colour map, 0 to 1 within the range.
  [[nodiscard]] Eigen::VectorXd map_coordinates(std::size_t frame, std::size_t actor) const;
  /// In a unit with short numbers.
  [[nodiscard]] Legend legend() const;

 private:
  void find_range();

  Field field_;
  ColorMap map_;
  const Simulation& simulation_;
  const Recording& recording_;
  double fps_;
  StrainMeasure measure_;
  double low_ = 0;  // SI
  double high_ = 0;
};

}  // namespace sprung
