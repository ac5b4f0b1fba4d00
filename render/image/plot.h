#pragma once
#include <string>
#include <vector>

#include "render/image/image.h"
#include "render/image/text.h"

namespace sprung {

/// Curves over time, up to the current frame.
struct Plot {
  struct Curve {
    std::string name;
    std::vector<double> values;  // one per frame of the film
    Ink ink{};
  };
  std::string title;  // with the unit
  std::vector<Curve> curves;
  std::size_t now = 0;  // current frame
};

/// A panel at the left edge, above the footer: an axis with the range of the whole film, the curves up to the current
/// frame and a dot at their ends.
void draw_plot(Image& image, const Plot& plot, const Font& font);

}  // namespace sprung
