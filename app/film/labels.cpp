#include "app/film/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/film/film_cameras.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr double kLongestBar = 0.2;    // of the picture's width
constexpr double kMaxForLegend = 0.4;  // of the picture's width

}  // namespace

Labels::Labels(const SceneRender& render, std::optional<Legend> legend, bool names) : render_(render) {
  if (render.legend) legend_ = std::move(legend);
  if (legend_ || names || render.plots || !render.caption.empty() || render.frame_number || render.scale_bar ||
      render.sheet) {
    font_.emplace();
  }
}

int Labels::reserved(int width, int height) const {
  if (!legend_) return 0;
  return int(std::min(kMaxForLegend * width, legend_width(*legend_, height, *font_)));
}

void Labels::write_name(Image& image, const std::string& name) const {
  draw_name(image, name, *font_, !render_.caption.empty());
}

void Labels::write_frame(Image& image, const Camera& camera, std::size_t frame, std::size_t frames, double time) const {
  if (!render_.caption.empty()) draw_caption(image, render_.caption, *font_);
  double reserved = 0;
  if (render_.scale_bar) {
    const double scale = pixels_per_metre(camera, image.height);
    const double length = round_length(kLongestBar * image.width / scale);
    const std::string words = readable(length, Dimension::kLength);
    draw_scale_bar(image, length * scale, words, *font_);
    reserved = scale_bar_width(length * scale, words, image.height, *font_) + letters_height(image.height);
  }
  const std::string number = render_.frame_number ? fmt::format("{} / {}   ", frame + 1, frames) : "";
  if (render_.frame_number || render_.sheet) {
    draw_footer(image, fmt::format("{}{:.2f} s", number, time), *font_, reserved);
  }
}

void Labels::write_plot(Image& image, const Plot& plot) const { draw_plot(image, plot, *font_); }

void Labels::write_legend(Image& image, const std::optional<Legend>& legend) const {
  if (legend_ && legend) draw_legend(image, *legend, *font_);
}

namespace {

constexpr std::array<Ink, 4> kInks{{{26, 92, 168}, {196, 84, 20}, {32, 128, 72}, {132, 60, 150}}};

struct Unit {
  double from;  // m, smallest range shown in this unit
  double size;  // m
  const char* name;
};
constexpr std::array<Unit, 4> kUnits{{{1, 1, "m"}, {0.02, 0.01, "cm"}, {2e-4, 1e-3, "mm"}, {0, 1e-6, "um"}}};

}  // namespace

Eigen::Vector3f probe_color(std::size_t probe) {
  const Ink& ink = kInks[probe % kInks.size()];
  return Eigen::Vector3f(ink[0], ink[1], ink[2]) / 255.0F;
}

Plot plot_of(const Recording& recording, std::size_t now) {
  Plot plot{.title = {}, .curves = {}, .now = now};
  double furthest = 0;
  for (std::size_t probe = 0; probe < recording.probes.size(); ++probe) {
    const ProbeTrack& track = recording.probes[probe];
    Plot::Curve& curve = plot.curves.emplace_back();
    curve.name = track.name;
    curve.ink = kInks[probe % kInks.size()];
    for (const ProbeSample& sample : track.samples) curve.values.push_back(sample.displacement.norm());
    for (const double value : curve.values) furthest = std::max(furthest, value);
  }
  std::size_t unit = 0;
  while (unit + 1 < kUnits.size() && furthest < kUnits[unit].from) ++unit;
  for (Plot::Curve& curve : plot.curves) {
    for (double& value : curve.values) value /= kUnits[unit].size;
  }
  plot.title = fmt::format("Displacement, {}", kUnits[unit].name);
  return plot;
}

}  // namespace sprung
