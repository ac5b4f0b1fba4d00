#include "app/film/labels.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/film/film_cameras.h"
#include "app/units.h"

namespace sprung {
namespace {

constexpr double kLongestBar = 0.2;     // of the picture's width
constexpr double kMostForLegend = 0.4;  // of the picture's width

}  // namespace

Labels::Labels(const SceneRender& render, std::optional<Legend> legend, bool names) : render_(render) {
  if (render.legend) legend_ = std::move(legend);
  if (legend_ || names || render.plots || !render.caption.empty() || render.frame_number || render.scale_bar)
    font_.emplace();
}

int Labels::reserved(int width, int height) const {
  if (!legend_) return 0;
  return int(std::min(kMostForLegend * width, legend_width(*legend_, height, *font_)));
}

void Labels::write_name(Image& image, const std::string& name) const { draw_name(image, name, *font_); }

void Labels::write_frame(Image& image, const Camera& camera, std::size_t frame, std::size_t frames, double time) const {
  if (!render_.caption.empty()) draw_caption(image, render_.caption, *font_);
  if (render_.frame_number) draw_footer(image, fmt::format("{} / {}   {:.2f} s", frame + 1, frames, time), *font_);
  if (render_.scale_bar) {
    const double pixels = pixels_per_metre(camera, image.height);
    const double length = round_length(kLongestBar * image.width / pixels);
    draw_scale_bar(image, length * pixels, readable(length, Dimension::kLength), *font_);
  }
}

void Labels::write_plot(Image& image, const Plot& plot) const { draw_plot(image, plot, *font_); }

void Labels::write_legend(Image& image) const {
  if (legend_) draw_legend(image, *legend_, *font_);
}

}  // namespace sprung
