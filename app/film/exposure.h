#pragma once
#include <vector>

#include "render/image/image.h"

namespace sprung {

/// The mean of pictures of the same size, in light (its root is what sRGB keeps, nearly): what an open shutter sees.
class Exposure {
 public:
  void add(const Image& image);
  [[nodiscard]] Image mean() const;

 private:
  Image first_;
  std::vector<float> light_;
  std::vector<float> alpha_;
  int count_ = 0;
};

/// Pictures of the same size in rows of `columns`, from the top left. `margin` pixels are free at the
/// right side, like the left ends of the rows.
[[nodiscard]] Image sheet_of(const std::vector<Image>& pictures, int columns, int margin);

}  // namespace sprung
