#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

namespace sprung {

/// Every `step`th frame of a part of a film, numbered from 1, ends included.
struct FrameRange {
  int first = 1;
  int last = 1;
  int step = 1;

  [[nodiscard]] int count() const { return (last - first) / step + 1; }
  [[nodiscard]] std::vector<int> frames() const;
  /// Its frames that a shorter film has, or else that film's last.
  [[nodiscard]] FrameRange within(int frames_in_film) const;
};

/// Frames 1 to `frames`.
[[nodiscard]] FrameRange whole_film(std::size_t frames);

/// "1:48", "12:", ":12", "1:48:2", "7", or "" for all. Throws Error(kUsage) for anything else, and for frames that the
/// film does not have.
[[nodiscard]] FrameRange parse_frame_range(std::string_view words, std::size_t frames);

/// The frame at a time ("0.5 s") of a film of that many frames at that rate. Throws Error(kUsage) as above.
[[nodiscard]] FrameRange parse_frame_time(std::string_view words, std::size_t frames, double fps);

/// Frames of a film that are drawn, and the numbers of their pictures.
struct FrameChoice {
  FrameRange range;
  int start_number = 1;         // of the pictures of the film's first frame
  bool skips_existing = false;  // draws only frames whose picture or passes are missing

  [[nodiscard]] int number(int frame) const { return frame + start_number - 1; }
};

}  // namespace sprung
