#include "app/film/frame_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/units.h"

namespace sprung {
namespace {

int number_in(std::string_view text, std::string_view words) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  throw Error(ErrorKind::kUsage, fmt::format("--frames: '{}' is not a range like 1:48, 12:, :12, 1:48:2 or 7", words));
}

}  // namespace

std::vector<int> FrameRange::frames() const {
  std::vector<int> numbers;
  for (int number = first; number <= last; number += step) numbers.push_back(number);
  return numbers;
}

FrameRange FrameRange::within(int frames_in_film) const {
  return {.first = std::min(first, frames_in_film), .last = std::min(last, frames_in_film), .step = step};
}

FrameRange whole_film(std::size_t frames) { return {.first = 1, .last = int(frames), .step = 1}; }

FrameRange parse_frame_range(std::string_view words, std::size_t frames) {
  FrameRange range = whole_film(frames);
  if (words.empty()) return range;
  const auto colon = words.find(':');
  const std::string_view before = words.substr(0, colon);
  std::string_view after = colon == std::string_view::npos ? before : words.substr(colon + 1);
  if (const auto second = after.find(':'); second != std::string_view::npos) {
    range.step = number_in(after.substr(second + 1), words);
    after = after.substr(0, second);
  }
  if (!before.empty()) range.first = number_in(before, words);
  if (!after.empty()) range.last = number_in(after, words);
  if (range.step < 1) throw Error(ErrorKind::kUsage, fmt::format("--frames: {} has a step below 1", words));
  if (range.first >= 1 && range.first <= range.last && range.last <= int(frames)) return range;
  throw Error(ErrorKind::kUsage, fmt::format("--frames: {} is not within the {} frames that there are", words, frames));
}

FrameRange parse_frame_time(std::string_view words, std::size_t frames, double fps) {
  double time = 0;
  try {
    time = parse_quantity(words, Dimension::kTime);
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("--time: {}", error.what()));
  }
  const double row = std::floor(time * fps + 0.5);
  if (row >= 0 && row < double(frames)) return {.first = int(row) + 1, .last = int(row) + 1, .step = 1};
  throw Error(ErrorKind::kUsage, fmt::format("--time: {} is not within the film, which ends at {}", words,
                                             readable(double(frames - 1) / fps, Dimension::kTime)));
}

}  // namespace sprung
