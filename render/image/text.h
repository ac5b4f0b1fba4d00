#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "render/image/image.h"

namespace sprung {

/// 8-bit sRGB.
using Ink = std::array<std::uint8_t, 3>;

/// Inter, a typeface for screens under the SIL Open Font License, which Debian packages.
class Font {
 public:
  /// Throws Error(kFailed) if the font is not installed.
  Font();
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  /// Advance width of `text` (UTF-8) in pixels; `size`: from descender to ascender, pixels.
  [[nodiscard]] double width(std::string_view text, double size) const;
  /// Writes with the origin at x and the baseline at y (pixels from the top left). A pale halo keeps dark letters
  /// readable on any background.
  void write(Image& image, double x, double y, double size, std::string_view text, const Ink& ink) const;

 private:
  struct Outlines;
  void blend(Image& image, double x, double y, double size, std::string_view text, const Ink& ink,
             double strength) const;

  std::unique_ptr<Outlines> outlines_;
};

/// Blends a pixel with an ink of opacity `share`, alpha included.
void mix_pixel(Image& image, int x, int y, const Ink& ink, double share);

/// Mixes the pixels of a rectangle, whose sides are rounded to whole pixels, with an ink by that share.
void fill_rectangle(Image& image, double left, double top, double right, double bottom, const Ink& ink,
                    double share = 1);

inline constexpr Ink kDarkInk{38, 40, 44};  // letters and lines on a picture

}  // namespace sprung
