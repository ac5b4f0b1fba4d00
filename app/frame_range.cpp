#include "app/frame_range.h"

#include <fmt/format.h>

#include <charconv>

#include "core/error.h"

namespace sprung {
namespace {

int number_in(std::string_view text, std::string_view words) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  throw Error(ErrorKind::kUsage, fmt::format("--frames: '{}' is not like 1:48, 12:, :12 or 7", words));
}

}  // namespace

FrameRange whole_film(std::size_t frames) { return {.first = 1, .last = int(frames)}; }

FrameRange parse_frame_range(std::string_view words, std::size_t frames) {
  FrameRange range = whole_film(frames);
  if (words.empty()) return range;
  const auto colon = words.find(':');
  const std::string_view before = words.substr(0, colon);
  const std::string_view after = colon == std::string_view::npos ? before : words.substr(colon + 1);
  if (!before.empty()) range.first = number_in(before, words);
  if (!after.empty()) range.last = number_in(after, words);
  if (range.first >= 1 && range.first <= range.last && range.last <= int(frames)) return range;
  throw Error(ErrorKind::kUsage, fmt::format("--frames: {} is not within the {} frames that there are", words, frames));
}

}  // namespace sprung
