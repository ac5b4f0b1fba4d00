#include "render/image/image.h"

#include <algorithm>

namespace sprung {

std::vector<std::uint8_t> interleaved(const Image& image) {
  if (image.alpha.empty()) return image.pixels;
  std::vector<std::uint8_t> bytes(4 * image.alpha.size());
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    std::copy_n(image.pixels.data() + 3 * i, 3, bytes.data() + 4 * i);
    bytes[4 * i + 3] = image.alpha[i];
  }
  return bytes;
}

}  // namespace sprung
