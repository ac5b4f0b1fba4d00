#pragma once
#include <vector>

#include "app/scene/film.h"
#include "app/scene/scene_render.h"
#include "core/simulation/recorder.h"
#include "render/image/legend.h"

namespace sprung {

/// A field at the nodes of one body in one frame, SI: displacement from the first frame (m), speed by differences
/// between frames (m/s), largest principal stretch, von Mises strain, von Mises stress (Pa), volume over rest volume,
/// fill, or Young's modulus (Pa) for kRegion. Not for kSkin. `measure`: of the strain from which the stress is
/// computed.
[[nodiscard]] Eigen::VectorXd field_values(Field field, const Simulation& simulation, const Recording& recording,
                                           std::size_t frame, std::size_t body, double fps,
                                           StrainMeasure measure = StrainMeasure::kFinite);

/// True if the field changes over time.
[[nodiscard]] bool is_moving(Field field);

/// The values of the first and the last colour, SI.
struct ColorRange {
  double low;
  double high;
};

/// One for the whole film, or one for each of its frames.
using ColorRanges = std::vector<ColorRange>;

[[nodiscard]] const ColorRange& range_in(const ColorRanges& ranges, std::size_t frame);
/// Ranges that cover both; the last one of a shorter film applies to the frames after it.
[[nodiscard]] ColorRanges merged(const ColorRanges& a, const ColorRanges& b);
/// Returns whether each frame has its own range.
[[nodiscard]] bool has_range_per_frame(const SceneRender& render);

/// Maps a field to colours.
class FieldColors {
 public:
  /// Finds the range over all frames or over each of them, unless the scene states it. All must outlive it.
  FieldColors(const Film& film, const Simulation& simulation, const Recording& recording);
  FieldColors(const Film& film, const Simulation& simulation, const Recording& recording, ColorRanges ranges);

  [[nodiscard]] bool is_mapped() const { return field_ != Field::kSkin; }
  [[nodiscard]] ColorMap map() const { return map_; }
  [[nodiscard]] const ColorRanges& ranges() const { return ranges_; }
  /// Coordinates of a body's nodes on the colour map, 0 to 1 within the range.
  [[nodiscard]] Eigen::VectorXd map_coordinates(std::size_t frame, std::size_t body) const;
  /// In a unit that keeps numbers short, the same in all frames.
  [[nodiscard]] Legend legend(std::size_t frame) const;

 private:
  [[nodiscard]] ColorRange range_over(std::size_t first, std::size_t last) const;

  Field field_;
  ColorMap map_;
  const Simulation& simulation_;
  const Recording& recording_;
  double fps_;
  StrainMeasure measure_;
  ColorRanges ranges_;
};

}  // namespace sprung
