#include "render/image/legend.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace sprung {

namespace {

constexpr double kLetters = 0.030;         // of the picture's height ...
constexpr double kSmallestLetters = 11.0;  // pixels
constexpr double kBarHeight = 0.46;        // of the picture's height
constexpr double kMinRoom = 0.285;         // of the picture's height, reserved for a legend
constexpr double kBarWidth = 0.024;        // of the picture's height

std::string tick_text(double tick) { return fmt::format("{:.6g}", tick); }

Ink ink_of(const Eigen::Vector3f& color) {
  Ink ink{};
  for (int c = 0; c < 3; ++c) {
    ink[c] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[c], 0.0F, 1.0F)));
  }
  return ink;
}

/// A rectangle with a thin dark line around it.
void fill_framed(Image& image, double left, double top, double right, double bottom, const Ink& ink) {
  const double line = std::max(1.0, image.height / 540.0);
  fill_rectangle(image, left - line, top - line, right + line, bottom + line, kDarkInk, 0.75);
  fill_rectangle(image, left, top, right, bottom, ink);
}

void draw_scale(Image& image, const Legend& legend, const Font& font, double left, double top) {
  const double size = letters_height(image.height);
  const double height = kBarHeight * image.height;
  const double width = kBarWidth * image.height;
  fill_framed(image, left, top, left + width, top + height, kDarkInk);
  const auto rows = int(std::lround(top + height) - std::lround(top));
  for (int row = 0; row < rows; ++row) {
    const double coordinate = 1 - (row + 0.5) / rows;
    const double y = double(std::lround(top)) + row;
    fill_rectangle(image, left, y, left + width, y + 1, ink_of(map_color(legend.map, coordinate)));
  }
  for (const double tick : round_ticks(legend.low, legend.high, height / (1.4 * size))) {
    const double y = top + height * (1 - (tick - legend.low) / (legend.high - legend.low));
    const double line = std::max(1.0, image.height / 540.0);
    fill_rectangle(image, left + width, y - line / 2, left + width + 0.3 * size, y + line / 2, kDarkInk, 0.75);
    font.write(image, left + width + 0.5 * size, y + 0.31 * size, size, tick_text(tick), kDarkInk);
  }
}

void draw_swatches(Image& image, const Legend& legend, const Font& font, double left, double top) {
  const double size = letters_height(image.height);
  double y = top;
  for (const Legend::Swatch& swatch : legend.swatches) {
    fill_framed(image, left, y, left + 1.1 * size, y + 0.9 * size, ink_of(swatch.color));
    font.write(image, left + 1.6 * size, y + 0.78 * size, size, swatch.name, kDarkInk);
    y += 1.5 * size;
  }
}

}  // namespace

void fill_panel(Image& image, double left, double top, double right, double bottom) {
  constexpr Ink kPaper{255, 255, 255};
  constexpr double kOpacity = 0.55;
  fill_rectangle(image, left, top, right, bottom, kPaper, kOpacity);
}

double letters_height(int height) { return std::max(kSmallestLetters, kLetters * height); }

double round_length(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= most * (1 + 1e-9)) return factor * power;
  }
  return power;
}

std::vector<double> round_ticks(double low, double high, double most) {
  if (!(high > low)) return {low};
  const double step = round_length((high - low) / 3.5);
  std::vector<double> ticks;
  for (double tick = std::ceil(low / step - 1e-6); tick * step <= high + 1e-6 * step; ++tick) {
    ticks.push_back(tick == 0 ? 0 : tick * step);
  }
  std::vector<double> few;
  const double stride = std::ceil(double(ticks.size()) / std::max(most, 1.0));
  for (std::size_t i = 0; i < ticks.size(); i += std::size_t(stride)) few.push_back(ticks[i]);
  return few;
}

namespace {

/// The width of its title, bar and numbers, or names.
double content_width(const Legend& legend, int height, const Font& font) {
  const double size = letters_height(height);
  double content = font.width(legend.title, size);
  const auto include = [&](double beside, const std::string& text) {
    content = std::max(content, beside + font.width(text, size));
  };
  if (legend.swatches.empty()) {
    for (const double tick : round_ticks(legend.low, legend.high)) {
      include(kBarWidth * height + 0.5 * size, tick_text(tick));
    }
  }
  for (const Legend::Swatch& swatch : legend.swatches) include(1.6 * size, swatch.name);
  return content;
}

}  // namespace

double legend_width(const Legend& legend, int height, const Font& font) {
  return std::max(content_width(legend, height, font) + 2 * kLabelMargin * height, kMinRoom * height);
}

void draw_legend(Image& image, const Legend& legend, const Font& font) {
  const double size = letters_height(image.height);
  const double left = image.width - legend_width(legend, image.height, font) + kLabelMargin * image.height;
  const double height =
      legend.swatches.empty() ? kBarHeight * image.height : 1.5 * size * double(legend.swatches.size());
  const double top = 0.5 * (image.height - height);
  const double around = 0.9 * size;
  const double edge = image.width - 0.4 * kLabelMargin * image.height;
  const double right = std::min(left + content_width(legend, image.height, font) + around, edge);
  fill_panel(image, left - around, top - 2.4 * size, right, top + height + around);
  font.write(image, left, top - 0.9 * size, size, legend.title, kDarkInk);
  if (legend.swatches.empty()) {
    draw_scale(image, legend, font, left, top);
  } else {
    draw_swatches(image, legend, font, left, top);
  }
}

namespace {

constexpr double kSmallest = 2.0 / 3;  // of the wanted size of letters
constexpr double kCaption = 1.35;      // size, in letters_height()
constexpr double kName = 1.2;
constexpr double kRounding = 0.01;  // pixels

bool is_first_byte(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

/// Its letters, of one or more bytes each.
std::vector<std::string> letters_of(const std::string& text) {
  std::vector<std::string> letters;
  for (const char byte : text) {
    if (letters.empty() || is_first_byte(byte)) letters.emplace_back();
    letters.back() += byte;
  }
  return letters;
}

double room_in(const Image& image) { return image.width - 2 * kLabelMargin * image.height; }

}  // namespace

FittedText fitted(const std::string& text, double size, double room, const Font& font) {
  const double width = font.width(text, size);
  if (width <= room) return {text, size};
  size *= std::max(kSmallest, room / width);
  const std::vector<std::string> letters = letters_of(text);
  for (std::size_t kept = letters.size(); kept > 0; --kept) {
    std::string shortened = text;
    if (kept < letters.size()) {
      const auto end = letters.end() - std::ptrdiff_t(kept / 2);
      shortened =
          fmt::format("{}\u2026{}", fmt::join(letters.begin(), letters.begin() + std::ptrdiff_t(kept - kept / 2), ""),
                      fmt::join(end, letters.end(), ""));
    }
    if (font.width(shortened, size) <= room + kRounding) return {shortened, size};
  }
  return {"", size};
}

void draw_name(Image& image, const std::string& text, const Font& font, bool has_caption) {
  const double letters = letters_height(image.height);
  const FittedText line = fitted(text, kName * letters, room_in(image), font);
  const double left = 0.5 * (image.width - font.width(line.text, line.size));
  const double above = has_caption ? 1.25 * kCaption * letters : 0;
  font.write(image, left, kLabelMargin * image.height + above + 0.8 * kName * letters, line.size, line.text, kDarkInk);
}

void draw_caption(Image& image, const std::string& text, const Font& font) {
  const double size = kCaption * letters_height(image.height);
  const FittedText line = fitted(text, size, room_in(image), font);
  const double margin = kLabelMargin * image.height;
  font.write(image, margin, margin + 0.8 * size, line.size, line.text, kDarkInk);
}

void draw_footer(Image& image, const std::string& text, const Font& font, double reserved) {
  const FittedText line = fitted(text, letters_height(image.height), room_in(image) - reserved, font);
  font.write(image, kLabelMargin * image.height, (1 - kLabelMargin) * image.height, line.size, line.text, kDarkInk);
}

double scale_bar_width(double pixels, const std::string& length, int height, const Font& font) {
  return std::max(pixels, font.width(length, letters_height(height)));
}

void draw_scale_bar(Image& image, double pixels, const std::string& length, const Font& font) {
  const double size = letters_height(image.height);
  const double right = image.width - kLabelMargin * image.height;
  const double bottom = (1 - kLabelMargin) * image.height;
  const double thick = std::max(2.0, 0.18 * size);
  fill_rectangle(image, right - pixels - 1, bottom - thick - 1, right + 1, bottom + 1, {255, 255, 255}, 0.6);
  fill_rectangle(image, right - pixels, bottom - thick, right, bottom, kDarkInk);
  const double width = font.width(length, size);
  font.write(image, right - std::max(0.5 * (pixels + width), width), bottom - thick - 0.45 * size, size, length,
             kDarkInk);
}

}  // namespace sprung
