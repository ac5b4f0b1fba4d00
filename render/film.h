#pragma once
#include <filesystem>
#include <memory>

#include "render/image/image.h"

namespace sprung {

/// True if `file` names a film by its ending: .mp4, .webm, .mov, .gif, .y4m (any case).
[[nodiscard]] bool is_film(const std::filesystem::path& file);

/// True if the film gets an extra column or row of pixels: MP4 and WebM need even sides.
[[nodiscard]] bool is_padded(const std::filesystem::path& file, int width, int height);

/// True if the film can be transparent: .webm (VP9) and .mov (ProRes 4444).
[[nodiscard]] bool holds_alpha(const std::filesystem::path& file);

/// True while a FilmWriter of any process writes that file.
[[nodiscard]] bool is_film_being_written(const std::filesystem::path& file);

/// Throws Error(kFailed) if ffmpeg is not on the path; the message says how to install it.
void require_ffmpeg();

/// Pipes raw pictures to an ffmpeg child process. BT.709, odd sizes padded. The film appears under its name when
/// close() returns; an unfinished film is removed. Only one process at a time may write a film. Rates like 23.976 are
/// those of NTSC, 24000/1001.
class FilmWriter {
 public:
  struct Format {
    int width;
    int height;
    double fps;
    bool has_alpha = false;
  };
  /// Throws Error(kFailed) if the file cannot be written or another process writes it, Error(kUsage) if it is not a
  /// film or cannot hold alpha.
  FilmWriter(const std::filesystem::path& file, const Format& format);
  /// YUV4MPEG2 (.y4m) to the standard output.
  [[nodiscard]] static FilmWriter to_standard_output(const Format& format);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;
  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) = delete;

  /// Throws Error(kFailed) with ffmpeg's message if the child has ended.
  void write(const Image& image);
  void close();

 private:
  struct Process;
  explicit FilmWriter(std::unique_ptr<Process> process);
  std::unique_ptr<Process> process_;
};

}  // namespace sprung
