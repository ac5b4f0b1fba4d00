#pragma once
#include <filesystem>
#include <memory>

#include "render/image/image.h"

namespace sprung {

/// True where `file` names a film by its ending: .mp4, .webm, .gif (any case).
[[nodiscard]] bool is_film(const std::filesystem::path& file);

/// True where the film gets an extra column or row of pixels: MP4 and WebM need even sides.
[[nodiscard]] bool is_padded(const std::filesystem::path& file, int width, int height);

/// True while a FilmWriter of any process writes that file.
[[nodiscard]] bool is_film_being_written(const std::filesystem::path& file);

/// Throws Error(kFailed) where ffmpeg is not on the path; the message says how to install it.
void require_ffmpeg();

/// Pipes raw pictures to an ffmpeg child process. BT.709, odd sizes padded. The film appears under its name when
/// close() returns; an unfinished film is removed. Only one process at a time may write a film.
class FilmWriter {
 public:
  /// Throws Error(kFailed) where the file cannot be written or another process writes it.
  FilmWriter(const std::filesystem::path& file, int width, int height, double fps);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  /// Throws Error(kFailed) with ffmpeg's message where the child has ended.
  void write(const Image& image);
  void close();

 private:
  struct Process;
  std::unique_ptr<Process> process_;
};

}  // namespace sprung
