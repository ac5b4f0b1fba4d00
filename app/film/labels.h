#pragma once
#include <optional>
#include <string>

#include "app/scene/scene.h"
#include "render/camera.h"
#include "render/legend.h"

namespace sprung {

/// What is written into the pictures of a film: legend, caption, number of the frame, bar of a round length.
class Labels {
 public:
  Labels(const SceneRender& render, std::optional<Legend> legend);

  /// The share of a picture's width that is kept free for the legend at its right.
  [[nodiscard]] double reserved() const { return legend_ ? kLegendShare : 0; }
  /// `frame` from 0 of that many, at `time` (s).
  void write_frame(Image& image, const Camera& camera, std::size_t frame, std::size_t frames, double time) const;
  void write_legend(Image& image) const;

 private:
  const SceneRender& render_;
  std::optional<Legend> legend_;
  std::optional<Font> font_;  // where anything is written
};

}  // namespace sprung
