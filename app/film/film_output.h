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

/// The destination of pictures: numbered PNG files in a folder, or a single one, or a film, or the standard output; or
/// of their passes: EXR files.
struct Output {
  enum class Kind { kPictures, kPasses, kFilm, kStream };
  enum class Stream { kAny, kPng, kY4m, kRgb };  // kAny: PNG of a single picture, else YUV4MPEG2
  Kind kind = Kind::kPictures;
  std::filesystem::path folder{};  // of the files
  std::string before{};            // a picture's name is before + number + after
  std::string after{};
  int digits = 0;                // padded with zeros to that many digits
  std::filesystem::path file{};  // of a film or of a single picture; empty: numbered files
  Stream stream = Stream::kAny;  // of kStream

  [[nodiscard]] bool is_numbered() const { return file.empty() && kind != Kind::kStream; }
  /// Returns whether all its pictures go to one file or stream, in order.
  [[nodiscard]] bool is_sequence() const { return kind == Kind::kFilm || kind == Kind::kStream; }
  /// The file of the picture, or of its passes, with this number; the first is 1.
  [[nodiscard]] std::filesystem::path picture(int number) const;
};

/// Throws Error(kUsage) if the value of --output has an ending but none of these, like "film.xyz", unless a folder of
/// that name exists. `examples` ends the message.
void check_folder_name(std::string_view words, std::span<const std::string_view> endings, std::string_view examples);

/// The value of --output: "dir/" or "dir" (frame_0001.png ... in it), "dir/f_{:04}.png" or "{:04d}" or
/// "{}" or "f_%04d.png" or "f_####.png", "still.png", the same with ".exr", "film.mp4", ".webm", ".mov", ".gif",
/// ".y4m", "-" for the standard output, "-.png", "-.y4m", "-.rgb". Throws Error(kUsage) for a name with any other
/// ending, unless such a folder exists.
[[nodiscard]] Output parse_output(std::string_view words);

/// Parses all of them. Throws Error(kUsage) if two would write to the same file.
[[nodiscard]] std::vector<Output> parse_outputs(const std::vector<std::string>& words);

/// The existing pictures of this output, sorted by name.
[[nodiscard]] std::vector<std::filesystem::path> existing_pictures(const Output& output);

/// Removes the numbered files of this output beyond `last`, which an earlier, longer film left. Returns how many.
int remove_beyond(const Output& output, int last);

/// Checks before any work is done that the output can be written; leaves no files. Throws Error(kUsage) if it exists
/// and `overwrite` is not set, Error(kFailed) if its folder cannot be written or ffmpeg is missing.
void check_output(const Output& output, bool overwrite);

/// One frame, as drawn.
struct Drawing {
  int number = 1;                  // of its files
  Image image{};                   // for pictures and films
  std::optional<Passes> passes{};  // for Output::Kind::kPasses
};

class SequenceWriter;

/// Encodes pictures in a thread of its own while others are drawn. Every output gets all pictures in order.
class PictureWriter {
 public:
  /// Makes the folders. Throws Error(kFailed).
  PictureWriter(std::vector<Output> outputs, const FilmWriter::Format& format);
  /// Stops; removes unfinished films.
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// Blocks while the queue is full. Throws what the thread threw.
  void write(Drawing drawing);
  /// Finishes the films. Does not touch pictures of other runs.
  void close();

 private:
  void run();
  void write_everywhere(const Drawing& drawing);

  std::vector<Output> outputs_;
  std::vector<std::unique_ptr<SequenceWriter>> sequences_;
  std::deque<Drawing> waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr failure_;
  bool is_closed_ = false;
  std::thread thread_;
};

}  // namespace sprung
