#include "render/image/text.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "core/error.h"

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

namespace sprung {

namespace {

constexpr Ink kHalo{255, 255, 255};
constexpr double kHaloReach = 0.06;  // of the letters' size
constexpr double kHaloStrength = 0.16;
constexpr int kUnknown = 0xfffd;

/// Removes and returns the first code point of a text in UTF-8.
int take_letter(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  const int more = first < 0x80 ? 0 : first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
  int letter = first < 0x80 ? first : first & (0x3f >> more);
  for (int i = 0; i < more; ++i) {
    if (text.empty() || (static_cast<unsigned char>(text.front()) & 0xc0) != 0x80) return kUnknown;
    letter = letter << 6 | (static_cast<unsigned char>(text.front()) & 0x3f);
    text.remove_prefix(1);
  }
  return letter;
}

}  // namespace

struct Font::Outlines {
  std::vector<unsigned char> bytes;
  stbtt_fontinfo info{};
};

Font::Font() : outlines_(std::make_unique<Outlines>()) {
  std::ifstream in(SPRUNG_FONT, std::ios::binary);
  outlines_->bytes = {std::istreambuf_iterator<char>(in), {}};
  if (outlines_->bytes.empty() || stbtt_InitFont(&outlines_->info, outlines_->bytes.data(), 0) == 0) {
    throw Error(ErrorKind::kFailed, "cannot read the font " SPRUNG_FONT "; is the package fonts-inter installed?");
  }
}

Font::~Font() = default;

double Font::width(std::string_view text, double size) const {
  const stbtt_fontinfo* info = &outlines_->info;
  double width = 0;
  while (!text.empty()) {
    int advance = 0;
    stbtt_GetCodepointHMetrics(info, take_letter(text), &advance, nullptr);
    width += advance * double(stbtt_ScaleForPixelHeight(info, float(size)));
  }
  return width;
}

void Font::write(Image& image, double x, double y, double size, std::string_view text, const Ink& ink) const {
  const double reach = std::max(1.0, kHaloReach * size);
  for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
    blend(image, x + reach * dx, y + reach * dy, size, text, kHalo, kHaloStrength);
  }
  blend(image, x, y, size, text, ink, 1);
}

void Font::blend(Image& image, double x, double y, double size, std::string_view text, const Ink& ink,
                 double strength) const {
  const stbtt_fontinfo* info = &outlines_->info;
  const float scale = stbtt_ScaleForPixelHeight(info, float(size));
  std::vector<unsigned char> glyph;
  while (!text.empty()) {
    const int letter = take_letter(text);
    const double left = std::floor(x);
    const double top = std::floor(y);
    const auto shift_x = float(x - left);
    const auto shift_y = float(y - top);
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;
    stbtt_GetCodepointBitmapBoxSubpixel(info, letter, scale, scale, shift_x, shift_y, &x0, &y0, &x1, &y1);
    const int columns = x1 - x0;
    const int rows = y1 - y0;
    glyph.assign(std::max(columns * rows, 0), 0);
    stbtt_MakeCodepointBitmapSubpixel(info, glyph.data(), columns, rows, columns, scale, scale, shift_x, shift_y,
                                      letter);
    for (std::size_t i = 0; i < glyph.size(); ++i) {
      const int column = int(i) % columns;
      const int row = int(i) / columns;
      mix_pixel(image, int(left) + x0 + column, int(top) + y0 + row, ink, strength * glyph[i] / 255);
    }
    int advance = 0;
    stbtt_GetCodepointHMetrics(info, letter, &advance, nullptr);
    x += double(scale) * advance;
  }
}

void mix_pixel(Image& image, int x, int y, const Ink& ink, double share) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height || share <= 0) return;
  const auto at = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
  double before = 1;  // opacity so far
  if (!image.alpha.empty()) {
    before = image.alpha[at] / 255.0;
    image.alpha[at] = static_cast<std::uint8_t>(std::lround(255 * (share + before * (1 - share))));
  }
  const double whole = share + before * (1 - share);
  for (std::size_t c = 0; c < 3; ++c) {
    std::uint8_t& byte = image.pixels[3 * at + c];
    byte = static_cast<std::uint8_t>(std::lround((share * ink[c] + before * (1 - share) * byte) / whole));
  }
}

void fill_rectangle(Image& image, double left, double top, double right, double bottom, const Ink& ink, double share) {
  for (int y = int(std::lround(top)); y < std::lround(bottom); ++y) {
    for (int x = int(std::lround(left)); x < std::lround(right); ++x) mix_pixel(image, x, y, ink, share);
  }
}

}  // namespace sprung
