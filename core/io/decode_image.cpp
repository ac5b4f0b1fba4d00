#include "core/io/decode_image.h"

#include <climits>
#include <memory>

#include "core/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // g++ 12, in code for file input
#endif
#include <stb/stb_image.h>

#include "core/types.h"
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

namespace sprung {

namespace {

template <class Value>
using Decoded = std::unique_ptr<Value, void (*)(void*)>;

/// `load`: one of stb_image's functions that read from memory.
template <class Value>
Decoded<Value> decode(Value* (*load)(const stbi_uc*, int, int*, int*, int*, int), std::span<const std::byte> encoded,
                      int channels, int& width, int& height, const std::string& name) {
  if (encoded.empty()) throw Error(ErrorKind::kBadInput, name + ": the picture is empty");
  if (encoded.size() > INT_MAX) throw Error(ErrorKind::kBadInput, name + ": the picture is larger than 2 GB");
  int found = 0;
  Decoded<Value> data(
      load(reinterpret_cast<const stbi_uc*>(encoded.data()), isize(encoded), &width, &height, &found, channels),
      stbi_image_free);
  if (data != nullptr) return data;
  throw Error(ErrorKind::kBadInput,
              name + ": not a picture that can be read (" + stbi_failure_reason() + "); use PNG or JPEG");
}

}  // namespace

Pixels decode_pixels(std::span<const std::byte> encoded, const std::string& name) {
  Pixels pixels;
  const auto data = decode(stbi_load_from_memory, encoded, STBI_rgb_alpha, pixels.width, pixels.height, name);
  pixels.rgba.assign(data.get(), data.get() + 4U * std::size_t(pixels.width) * std::size_t(pixels.height));
  return pixels;
}

Panorama decode_panorama(std::span<const std::byte> encoded, const std::string& name) {
  Panorama panorama;
  const auto data = decode(stbi_loadf_from_memory, encoded, STBI_rgb, panorama.width, panorama.height, name);
  const auto count = std::size_t(panorama.width) * std::size_t(panorama.height);
  for (std::size_t i = 0; i < count; ++i) panorama.light.emplace_back(data.get() + 3 * i);
  return panorama;
}

}  // namespace sprung
