#pragma once
#include <string>
#include <vector>

#include "render/image/image.h"
#include "render/image/text.h"

namespace sprung {

/// Values over time, as far as a film has come.
struct Plot {
  struct Curve {
    std::string name;
    std::vector<double> values;  // one a frame, all of the film
    Ink ink{};
  };
  std::string title;  // with the unit
  std::vector<Curve> curves;
  std::size_t now = 0;  // the last frame that shows
};

/// At the left side, above the footer: a panel with an axis for the values, whose range is that of the whole film, the
/// curves up to now and a dot at their ends.
void draw_plot(Image& image, const Plot& plot, const Font& font);

}  // namespace sprung
