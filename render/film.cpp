#include "render/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "core/io/process.h"

namespace sprung {

namespace {

using RawOptions = std::vector<std::string>;

/// To BT.709 with even sides (4:2:0 needs them), the last row and column repeated where they are odd. Left alone,
/// ffmpeg would convert by BT.601 and tag nothing, and players would guess.
std::string video_filter(int width, int height) {
  std::string filter;
  if (width % 2 != 0 || height % 2 != 0) {
    filter =
        fmt::format("pad=ceil(iw/2)*2:ceil(ih/2)*2,fillborders=right={}:bottom={}:mode=smear,", width % 2, height % 2);
  }
  return filter + "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int,format=yuv420p";
}

RawOptions encoder(const std::string& extension, int width, int height) {
  if (extension == ".gif") {
    return {"-filter_complex", "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=sierra2_4a",
            "-loop", "0"};
  }
  RawOptions words{"-vf",
                   video_filter(width, height),
                   "-pix_fmt",
                   "yuv420p",
                   "-colorspace",
                   "bt709",
                   "-color_primaries",
                   "bt709",
                   "-color_trc",
                   "bt709",
                   "-color_range",
                   "tv"};
  const RawOptions codec =
      extension == ".webm"
          ? RawOptions{"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-cpu-used", "4", "-row-mt", "1"}
          : RawOptions{"-c:v", "libx264", "-preset", "veryfast", "-crf", "16", "-movflags", "+faststart"};
  words.insert(words.end(), codec.begin(), codec.end());
  return words;
}

RawOptions ffmpeg_command(const std::filesystem::path& file, int width, int height, double fps) {
  RawOptions words{"ffmpeg",
                   "-hide_banner",
                   "-loglevel",
                   "error",
                   "-y",
                   "-f",
                   "rawvideo",
                   "-pix_fmt",
                   "rgb24",
                   "-video_size",
                   fmt::format("{}x{}", width, height),
                   "-framerate",
                   fmt::format("{:.6f}", fps),
                   "-i",
                   "pipe:0"};
  const RawOptions rest = encoder(lower_extension(file), width, height);
  words.insert(words.end(), rest.begin(), rest.end());
  words.push_back("file:" + file.string());
  return words;
}

/// a/film.mp4 -> a/film.partial.mp4: ffmpeg chooses the format by the ending.
std::filesystem::path partial_name(const std::filesystem::path& file) {
  return file.parent_path() / (file.stem().string() + ".partial" + file.extension().string());
}

}  // namespace

bool is_film(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".mp4" || extension == ".webm" || extension == ".gif";
}

bool is_padded(const std::filesystem::path& file, int width, int height) {
  return lower_extension(file) != ".gif" && (width % 2 != 0 || height % 2 != 0);
}

bool is_film_being_written(const std::filesystem::path& file) { return is_being_written(partial_name(file)); }

void require_ffmpeg() {
  if (find_program("ffmpeg")) return;
  throw Error(ErrorKind::kFailed,
              "films need the program ffmpeg, which is not on the path; install it (apt install ffmpeg) or write "
              "pictures instead (-o FOLDER)");
}

struct FilmWriter::Process {
  FileLock lock;  // of the partial film; reports a folder that cannot be written before ffmpeg does in its own words
  PartialFile file;
  int width;
  int height;
  ChildProcess child;

  Process(const std::filesystem::path& f, int w, int h, double fps)
      : lock(partial_name(f)),
        file(f, partial_name(f)),
        width(w),
        height(h),
        child(ffmpeg_command(file.path(), w, h, fps)) {}

  /// ffmpeg's first message is the cause, the others follow from it.
  [[noreturn]] void fail(int status) const {
    const std::string words = child.error_output();
    throw Error(ErrorKind::kFailed, fmt::format("{}: ffmpeg ended with status {}: {}", file.final_path().string(),
                                                status, words.substr(0, words.find('\n'))));
  }
};

FilmWriter::FilmWriter(const std::filesystem::path& file, int width, int height, double fps) {
  if (!is_film(file)) {
    throw Error(ErrorKind::kUsage, file.string() + ": a film ends in .mp4, .webm or .gif");
  }
  require_ffmpeg();
  process_ = std::make_unique<Process>(file, width, height, fps);
}

FilmWriter::~FilmWriter() = default;

void FilmWriter::write(const Image& image) {
  if (process_ == nullptr) throw Error(ErrorKind::kFailed, "a picture came after the film was closed");
  if (image.width != process_->width || image.height != process_->height) {
    throw Error(ErrorKind::kFailed,
                fmt::format("{}: a picture of {}x{} in a film of {}x{}", process_->file.final_path().string(),
                            image.width, image.height, process_->width, process_->height));
  }
  if (!process_->child.write(std::as_bytes(std::span(image.pixels)))) process_->fail(process_->child.finish());
}

void FilmWriter::close() {
  if (process_ == nullptr) return;
  const auto process = std::move(process_);
  const int status = process->child.finish();
  if (status != 0) process->fail(status);
  process->file.publish();
}

}  // namespace sprung
