#pragma once
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "render/film.h"
#include "render/image/image.h"

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

/// Where pictures go: numbered PNG files in a folder, or a film; or where their passes go, numbered EXR files.
struct Output {
  enum class Kind { kPictures, kPasses, kFilm };
  Kind kind = Kind::kPictures;
  std::filesystem::path folder{};  // that the pictures or the film lie in
  std::string before{};            // a picture's name is before + number + after
  std::string after{};
  int digits = 0;                // leading zeros up to that many digits
  std::filesystem::path film{};  // the file of a film

  /// The file of the picture, or of its passes, with this number; the first is 1.
  [[nodiscard]] std::filesystem::path picture(int number) const;
};

/// Throws Error(kUsage) where the words after --output, which name none of the files with these endings, look like a
/// file and not like a folder: "film.xyz", unless there is such a folder. `examples` says what to give.
void check_folder_name(std::string_view words, std::span<const std::string_view> endings, std::string_view examples);

/// What the words after --output mean: "dir/" or "dir" (frame_0001.png ... in it), "dir/f_{:04}.png" or "{:04d}" or
/// "{}", the same with ".exr", "film.mp4", ".webm", ".gif". Throws Error(kUsage) for a name with any other ending,
/// unless such a folder exists.
[[nodiscard]] Output parse_output(std::string_view words);

/// All of them. Throws Error(kUsage) where two are the same place in whatever spelling.
[[nodiscard]] std::vector<Output> parse_outputs(const std::vector<std::string>& words);

/// The numbered pictures of this output that exist, in order of their names.
[[nodiscard]] std::vector<std::filesystem::path> existing_pictures(const Output& output);

/// Throws where the output cannot be made, before any work is lost: Error(kUsage) where it exists and `overwrite` is
/// not set, Error(kFailed) where its folder cannot be made or written, or a film's ffmpeg is missing. Leaves nothing.
void check_output(const Output& output, bool overwrite);

/// What there is of a frame.
struct Drawing {
  Image image{};                   // for pictures and films
  std::optional<Passes> passes{};  // for outputs of that kind
};

/// Encodes pictures in a thread of its own, so that drawing does not wait for it. Pictures go to every output in the
/// order in which they come.
class PictureWriter {
 public:
  /// Makes the folders. Pictures have the numbers first, first + step, ... Throws Error(kFailed).
  PictureWriter(std::vector<Output> outputs, int width, int height, double fps, int first = 1, int step = 1);
  /// Stops; films that are not finished disappear.
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// Waits where too many pictures are waiting already. Throws what went wrong in the thread.
  void write(Drawing drawing);
  /// Finishes the films. Pictures that this run did not write are left alone, whatever their names.
  void close();

 private:
  void run();
  void write_everywhere(const Drawing& drawing);

  std::vector<Output> outputs_;
  std::vector<std::unique_ptr<FilmWriter>> films_;
  std::deque<Drawing> waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr failure_;
  bool is_closed_ = false;
  int next_;  // number of the next picture
  int step_;
  std::thread thread_;
};

}  // namespace sprung
