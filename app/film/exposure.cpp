#include "app/film/exposure.h"

#include <algorithm>
#include <cmath>

#include "core/types.h"

namespace sprung {

void Exposure::add(const Image& image) {
  if (count_++ == 0) {
    first_ = image;
    light_.assign(image.pixels.size(), 0);
    alpha_.assign(image.alpha.size(), 0);
  }
  for (std::size_t i = 0; i < light_.size(); ++i) {
    const auto byte = float(image.pixels[i]);
    const float share = image.alpha.empty() ? 1 : float(image.alpha[i / 3]) / 255;
    light_[i] += share * byte * byte;
  }
  for (std::size_t i = 0; i < alpha_.size(); ++i) alpha_[i] += float(image.alpha[i]);
}

Image Exposure::mean() const {
  if (count_ == 1) return first_;
  Image image = first_;
  const auto count = float(count_);
  for (std::size_t i = 0; i < alpha_.size(); ++i)
    image.alpha[i] = static_cast<std::uint8_t>(std::lround(alpha_[i] / count));
  for (std::size_t i = 0; i < light_.size(); ++i) {
    const float share = alpha_.empty() ? count : std::max(alpha_[i / 3] / 255, 1e-3F);
    image.pixels[i] = static_cast<std::uint8_t>(std::clamp(std::lround(std::sqrt(light_[i] / share)), 0L, 255L));
  }
  return image;
}

Image sheet_of(const std::vector<Image>& pictures, int columns, int margin) {
  const Image& first = pictures.front();
  const int rows = (isize(pictures) + columns - 1) / columns;
  Image sheet(columns * first.width + margin, rows * first.height);
  if (!first.alpha.empty()) sheet.alpha.assign(sheet.pixels.size() / 3, 0);
  for (std::size_t number = 0; number < pictures.size(); ++number) {
    const int left = int(number) % columns * first.width;
    const int top = int(number) / columns * first.height;
    for (int y = 0; y < first.height; ++y) {
      const std::size_t to = (top + y) * sheet.width + left;
      const std::size_t from = y * first.width;
      const std::size_t width = first.width;
      std::copy_n(pictures[number].pixels.data() + 3 * from, 3 * width, sheet.pixels.data() + 3 * to);
      if (!first.alpha.empty()) {
        std::copy_n(pictures[number].alpha.data() + from, width, sheet.alpha.data() + to);
      }
    }
  }
  for (int y = 0; y < sheet.height; ++y) {  // what is left over is as the row begins, where no shadow falls
    const auto row = 3 * std::size_t(y * sheet.width);
    const auto used = 3 * std::size_t(columns * first.width);
    const auto end = 3 * std::size_t(sheet.width);
    for (std::size_t i = used; i < end; ++i) sheet.pixels[row + i] = sheet.pixels[row + i % 3];
  }
  return sheet;
}

}  // namespace sprung
