#pragma once
#include <optional>
#include <string>

#include "app/scene/film.h"
#include "core/simulation/recorder.h"
#include "render/image/legend.h"
#include "render/image/plot.h"
#include "render/stage/camera.h"

namespace sprung {

/// The labels of a film's pictures: legend, caption, frame number, scale bar, names, plots.
class Labels {
 public:
  /// `names`: write_name() will be called.
  Labels(const SceneRender& render, std::optional<Legend> legend, bool names);

  /// Pixels reserved for the legend at the right edge of a picture of that size.
  [[nodiscard]] int reserved(int width, int height) const;
  void write_name(Image& image, const std::string& name) const;
  /// `frame` counts from 0; `time` in s. A sheet always shows the time.
  void write_frame(Image& image, const Camera& camera, std::size_t frame, std::size_t frames, double time) const;
  /// Draws the legend as wide as the one passed to the constructor.
  void write_legend(Image& image, const std::optional<Legend>& legend) const;
  void write_plot(Image& image, const Plot& plot) const;

 private:
  SceneRender render_;
  std::optional<Legend> legend_;
  std::optional<Font> font_;  // none if nothing is written
};

/// sRGB of a probe's trace and curve, by its index.
[[nodiscard]] Eigen::Vector3f probe_color(std::size_t probe);

/// Distance of each probe from its position in the first frame, in a unit with short numbers.
[[nodiscard]] Plot plot_of(const Recording& recording, std::size_t now);

}  // namespace sprung
