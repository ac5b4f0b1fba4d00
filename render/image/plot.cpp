#include "render/image/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/image/legend.h"

namespace sprung {

namespace {

constexpr double kMaxTicks = 4;
constexpr double kWidth = 0.26;   // of the picture's width
constexpr double kHeight = 0.22;  // of the picture's height

/// Maps values to pixels.
struct Frame {
  double left, top, right, bottom;
  double low, high;
  std::size_t frames;

  [[nodiscard]] double x(double frame) const {
    return left + (right - left) * frame / double(std::max<std::size_t>(frames - 1, 1));
  }
  [[nodiscard]] double y(double value) const { return bottom - (bottom - top) * (value - low) / (high - low); }
};

void dot(Image& image, double x, double y, double radius, const Ink& ink) {
  const int reach = int(std::ceil(radius)) + 1;
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      const double px = std::floor(x) + i;
      const double py = std::floor(y) + j;
      const double share = std::clamp(radius + 0.5 - std::hypot(px + 0.5 - x, py + 0.5 - y), 0.0, 1.0);
      mix_pixel(image, int(px), int(py), ink, share);
    }
  }
}

std::string text_of(double tick) { return fmt::format("{:.6g}", tick); }

/// Column by column, thick enough to stay connected where the curve is steep.
void draw_curve(Image& image, const Frame& frame, const Plot::Curve& curve, std::size_t now, double thick) {
  const double end = frame.x(double(now));
  const auto height = [&](double x) {
    const double at = std::clamp((x - frame.left) / (frame.right - frame.left), 0.0, 1.0) *
                      double(std::max<std::size_t>(frame.frames - 1, 1));
    const auto before = std::min(std::size_t(at), curve.values.size() - 1);
    const auto after = std::min(before + 1, curve.values.size() - 1);
    return frame.y(std::lerp(curve.values[before], curve.values[after], at - double(before)));
  };
  for (int x = int(std::ceil(frame.left)); x + 0.5 <= end; ++x) {
    const double from = height(x);
    const double to = height(x + 1);
    const double top = std::min(from, to) - thick / 2;
    const double bottom = std::max(from, to) + thick / 2;
    for (int y = int(std::floor(top)); y <= int(std::floor(bottom)); ++y) {
      mix_pixel(image, x, y, curve.ink, std::clamp(std::min(y + 1.0, bottom) - std::max(1.0 * y, top), 0.0, 1.0));
    }
  }
  dot(image, end, frame.y(curve.values[std::min(now, curve.values.size() - 1)]), 1.6 * thick, curve.ink);
}

void draw_axis(Image& image, const Frame& frame, double size, const Font& font) {
  const double line = std::max(1.0, image.height / 720.0);
  for (const double tick : round_ticks(frame.low, frame.high, kMaxTicks)) {
    const double y = frame.y(tick);
    fill_rectangle(image, frame.left, y - line / 2, frame.right, y + line / 2, kDarkInk, 0.18);
    const std::string text = text_of(tick);
    font.write(image, frame.left - 0.5 * size - font.width(text, size), y + 0.31 * size, size, text, kDarkInk);
  }
  fill_rectangle(image, frame.left - line, frame.top, frame.left, frame.bottom, kDarkInk, 0.75);
  fill_rectangle(image, frame.left - line, frame.bottom, frame.right, frame.bottom + line, kDarkInk, 0.75);
}

Frame values_of(const Plot& plot) {
  Frame frame{};
  frame.frames = plot.curves.front().values.size();
  for (const Plot::Curve& curve : plot.curves) {
    const auto [low, high] = std::minmax_element(curve.values.begin(), curve.values.end());
    frame.low = std::min(frame.low, *low);
    frame.high = std::max(frame.high, *high);
  }
  if (frame.high <= frame.low) frame.high = frame.low + 1;
  return frame;
}

/// Draws the panel with its title; returns the room for the curves.
void draw_panel(Image& image, const Plot& plot, Frame& frame, double size, const Font& font) {
  const double margin = kLabelMargin * image.height;
  const double bottom = image.height - margin - 1.8 * size;
  const double top = bottom - kHeight * image.height - 2.4 * size;
  double content = 1.2 * size + font.width(plot.title, size);
  for (const Plot::Curve& curve : plot.curves) content += size + font.width(curve.name, size);
  const double right = margin + std::max(kWidth * image.width, content);
  fill_panel(image, margin, top, right, bottom);
  double x = margin + 0.6 * size;
  const auto write = [&](const std::string& text, const Ink& ink) {
    font.write(image, x, top + 1.2 * size, size, text, ink);
    x += font.width(text, size) + size;
  };
  write(plot.title, kDarkInk);
  for (const Plot::Curve& curve : plot.curves) write(curve.name, curve.ink);
  double widest = 0;
  for (const double tick : round_ticks(frame.low, frame.high, kMaxTicks))
    widest = std::max(widest, font.width(text_of(tick), size));
  frame.left = margin + widest + 1.2 * size;
  frame.right = right - 0.8 * size;
  frame.top = top + 2 * size;
  frame.bottom = bottom - 0.7 * size;
}

}  // namespace

void draw_plot(Image& image, const Plot& plot, const Font& font) {
  if (plot.curves.empty() || plot.curves.front().values.empty()) return;
  const double size = letters_height(image.height);
  Frame frame = values_of(plot);
  draw_panel(image, plot, frame, size, font);
  draw_axis(image, frame, size, font);
  for (const Plot::Curve& curve : plot.curves) {
    draw_curve(image, frame, curve, plot.now, std::max(1.5, image.height / 300.0));
  }
}

}  // namespace sprung
