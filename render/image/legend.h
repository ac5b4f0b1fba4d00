#pragma once
#include <string>
#include <vector>

#include "render/image/color_map.h"
#include "render/image/image.h"
#include "render/image/text.h"

namespace sprung {

/// An explanation of the colours of a picture: a colour bar, or single colours with names.
struct Legend {
  struct Swatch {
    std::string name;
    Eigen::Vector3f color;  // sRGB, 0 to 1
  };
  std::string title;  // with the unit
  ColorMap map = ColorMap::kViridis;
  double low = 0;  // in the unit
  double high = 1;
  std::vector<Swatch> swatches;  // if any, replace the colour bar
};

/// Height (pixels) of the letters in a picture of that height, and the margin around labels over the picture's height.
[[nodiscard]] double letters_height(int height);
inline constexpr double kLabelMargin = 0.035;

/// A pale panel behind labels; pixels.
void fill_panel(Image& image, double left, double top, double right, double bottom);

/// Draws it at the right edge, centred vertically, on a panel.
void draw_legend(Image& image, const Legend& legend, const Font& font);

/// Pixels to reserve for it at the right edge of a picture of that height.
[[nodiscard]] double legend_width(const Legend& legend, int height, const Font& font);

/// A line of text made to fit into that many pixels: in letters down to two thirds of the size, then with "\u2026"
/// instead of its middle.
struct FittedText {
  std::string text;
  double size;  // pixels
};
[[nodiscard]] FittedText fitted(const std::string& text, double size, double room, const Font& font);

/// A line of text at the top, centred; below the caption, if there is one.
void draw_name(Image& image, const std::string& text, const Font& font, bool has_caption);

/// A line of text at the top left, one at the bottom left, and at the bottom right a scale bar `pixels` long; none
/// extends beyond the picture. `reserved`: pixels at the right edge that the footer leaves to the scale bar.
void draw_caption(Image& image, const std::string& text, const Font& font);
void draw_footer(Image& image, const std::string& text, const Font& font, double reserved = 0);
void draw_scale_bar(Image& image, double pixels, const std::string& length, const Font& font);
[[nodiscard]] double scale_bar_width(double pixels, const std::string& length, int height, const Font& font);

/// 1, 2 or 5 times a power of ten, at most `most` (above 0).
[[nodiscard]] double round_length(double most);

/// About five round numbers from low to high, `most` at most.
[[nodiscard]] std::vector<double> round_ticks(double low, double high, double most = 10);

}  // namespace sprung
