#pragma once
#include <string>
#include <vector>

#include "render/image/color_map.h"
#include "render/image/image.h"
#include "render/image/text.h"

namespace sprung {

/// What the colours of a picture stand for: a scale, or single colours with names.
struct Legend {
  struct Swatch {
    std::string name;
    Eigen::Vector3f color;  // sRGB, 0 to 1
  };
  std::string title;  // with the unit
  ColorMap map = ColorMap::kViridis;
  double low = 0;  // in the unit
  double high = 1;
  std::vector<Swatch> swatches;  // not empty: these in place of the scale
};

/// Height of the letters in a picture of that height, and the margin around labels as a share of it.
[[nodiscard]] double letters_height(int height);
inline constexpr double kLabelMargin = 0.035;

/// At the right side, in the middle of its height.
void draw_legend(Image& image, const Legend& legend, const Font& font);

/// Pixels that are to be kept free for it at the right side of a picture of that height.
[[nodiscard]] double legend_width(const Legend& legend, int height, const Font& font);

/// A line in the middle of the top.
void draw_name(Image& image, const std::string& text, const Font& font);

/// A line at the top left, one at the bottom left, and a bar of a length at the bottom right, `pixels` long.
void draw_caption(Image& image, const std::string& text, const Font& font);
void draw_footer(Image& image, const std::string& text, const Font& font);
void draw_scale_bar(Image& image, double pixels, const std::string& length, const Font& font);

/// 1, 2 or 5 times a power of ten, at most `most` (above 0).
[[nodiscard]] double round_length(double most);

/// Round numbers from low to high, about five of them, and no more than `most`.
[[nodiscard]] std::vector<double> round_ticks(double low, double high, double most = 10);

}  // namespace sprung
