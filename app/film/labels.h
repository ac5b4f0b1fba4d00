#pragma once
#include <optional>
#include <string>

#include "app/scene/film.h"
#include "core/simulation/recorder.h"
#include "render/camera.h"
#include "render/image/legend.h"
#include "render/image/plot.h"

namespace sprung {

/// What is written into the pictures of a film: legend, caption, number of the frame, bar of a round length.
class Labels {
 public:
  /// With `names`, pictures get names.
  Labels(const SceneRender& render, std::optional<Legend> legend, bool names);

  /// Pixels that are kept free for the legend at the right of a picture of that size.
  [[nodiscard]] int reserved(int width, int height) const;
  void write_name(Image& image, const std::string& name) const;
  /// `frame` from 0 of that many, at `time` (s).
  void write_frame(Image& image, const Camera& camera, std::size_t frame, std::size_t frames, double time) const;
  void write_legend(Image& image) const;
  void write_plot(Image& image, const Plot& plot) const;

 private:
  SceneRender render_;
  std::optional<Legend> legend_;
  std::optional<Font> font_;  // where anything is written
};

/// sRGB, of a probe's trace and curve, by its place among the probes.
[[nodiscard]] Eigen::Vector3f probe_color(std::size_t probe);

/// How far each probe is from where it was in the first frame, in a unit in which the numbers are short.
[[nodiscard]] Plot plot_of(const Recording& recording, std::size_t now);

}  // namespace sprung
