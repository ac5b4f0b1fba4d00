#pragma once
#include <cstddef>
#include <string_view>

namespace sprung {

/// Frames of a film, counted from 1 as pictures are, both ends included.
struct FrameRange {
  int first = 1;
  int last = 1;

  [[nodiscard]] int count() const { return last - first + 1; }
};

/// All that many.
[[nodiscard]] FrameRange whole_film(std::size_t frames);

/// "1:48", "12:", ":12", "7", or all where nothing is said. Throws Error(kUsage) for other words, or where the film has
/// no such frames.
[[nodiscard]] FrameRange parse_frame_range(std::string_view words, std::size_t frames);

}  // namespace sprung
