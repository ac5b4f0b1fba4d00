#include "render/decode.h"

#include <climits>
#include <memory>

#include "core/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // g++ 12 takes the fields of file input for used
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

namespace sprung {

Pixels decode_pixels(std::span<const std::byte> encoded, const std::string& name) {
  if (encoded.empty()) throw Error(ErrorKind::kBadInput, name + ": the picture is empty");
  if (encoded.size() > INT_MAX) throw Error(ErrorKind::kBadInput, name + ": the picture is larger than 2 GB");
  Pixels pixels;
  int channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> data(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(encoded.data()), static_cast<int>(encoded.size()),
                            &pixels.width, &pixels.height, &channels, STBI_rgb_alpha),
      stbi_image_free);
  if (data == nullptr) {
    throw Error(ErrorKind::kBadInput, name + ": not a picture that can be read (" + stbi_failure_reason() +
                                          "); PNG and JPEG are sure to work");
  }
  pixels.rgba.assign(
      data.get(), data.get() + 4U * static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height));
  return pixels;
}

}  // namespace sprung
