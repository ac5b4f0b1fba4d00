#pragma once
#include <filesystem>
#include <memory>

#include "render/image/image.h"

namespace sprung {

/// True where `file` names a film by its ending: .mp4, .webm, .gif (any case).
[[nodiscard]] bool is_film(const std::filesystem::path& file);

/// True where a film of pictures of that size would be a column or a row larger: MP4 and WebM take even sides only.
[[nodiscard]] bool is_padded(const std::filesystem::path& file, int width, int height);

/// True while a FilmWriter of any process writes that film.
[[nodiscard]] bool is_film_being_written(const std::filesystem::path& file);

/// Throws Error(kFailed) with the remedy where the ffmpeg program is not on the path.
void require_ffmpeg();

/// A film being written by an ffmpeg child process that is fed raw pictures through a pipe. BT.709, odd sizes padded.
/// The film appears under its name when close() returns; an unfinished film is removed. One process at a time writes a
/// film.
class FilmWriter {
 public:
  /// Throws Error(kFailed) where the file cannot be written or another process writes it.
  FilmWriter(const std::filesystem::path& file, int width, int height, double fps);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  /// Throws Error(kFailed) with ffmpeg's last words where the child has died.
  void write(const Image& image);
  void close();

 private:
  struct Process;
  std::unique_ptr<Process> process_;
};

}  // namespace sprung
