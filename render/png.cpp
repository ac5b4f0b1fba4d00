#include "render/png.h"

#include <libdeflate.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>

#include "core/error.h"
#include "render/decode.h"

namespace {

/// zlib stream of `data` for stb, which frees it. libdeflate is several times quicker than stb's own and packs better.
unsigned char* compress_for_stb(unsigned char* data, int size, int* packed_size, int level) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (compressor == nullptr) return nullptr;
  const auto count = static_cast<std::size_t>(size);
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), count);
  auto* packed = static_cast<unsigned char*>(std::malloc(bound));
  if (packed == nullptr) return nullptr;
  *packed_size = static_cast<int>(libdeflate_zlib_compress(compressor.get(), data, count, packed, bound));
  return packed;
}

}  // namespace

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#define STBIW_ZLIB_COMPRESS compress_for_stb
#include <stb/stb_image_write.h>

namespace sprung {

namespace {

constexpr int kCompressionLevel = 6;  // of libdeflate: beyond it a per cent less for several times the time
constexpr int kSubFilter = 1;         // difference to the left neighbour; trying all filters gains little on renders

using Bytes = std::unique_ptr<unsigned char, void (*)(void*)>;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw Error(ErrorKind::kFailed, file.string() + ": cannot write the picture: " + reason);
}

void write_bytes(const std::filesystem::path& file, const unsigned char* data, std::size_t size) {
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) fail(file, std::strerror(errno));
  const bool written = std::fwrite(data, 1, size, out) == size;
  const int write_error = errno;
  if (std::fclose(out) == 0 && written) return;
  const int reason = written ? errno : write_error;
  std::remove(file.c_str());
  fail(file, std::strerror(reason));
}

}  // namespace

void write_png(const Image& image, const std::filesystem::path& file) {
  stbi_write_png_compression_level = kCompressionLevel;
  stbi_write_force_png_filter = kSubFilter;
  int size = 0;
  const Bytes encoded(stbi_write_png_to_mem(image.pixels.data(), 3 * image.width, image.width, image.height, 3, &size),
                      std::free);
  if (encoded == nullptr) fail(file, "no memory");

  std::filesystem::path partial = file;
  partial += ".partial";
  write_bytes(partial, encoded.get(), static_cast<std::size_t>(size));
  std::error_code error;
  std::filesystem::rename(partial, file, error);
  if (!error) return;
  std::remove(partial.c_str());
  fail(file, error.message());
}

Image read_png(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in || bytes.empty()) throw Error(ErrorKind::kBadInput, file.string() + ": cannot read the picture");
  const Pixels pixels = decode_pixels(std::as_bytes(std::span(bytes)), file.string());
  Image image(pixels.width, pixels.height);
  for (std::size_t p = 0; p < image.pixels.size() / 3; ++p) {
    for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * p + c] = pixels.rgba[4 * p + c];
  }
  return image;
}

}  // namespace sprung
