#include "render/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "core/io/process.h"

namespace sprung {

namespace {

using RawOptions = std::vector<std::string>;

struct Container {
  std::string_view extension;
  bool holds_alpha;
  bool needs_even_sides;  // its chroma is subsampled
};
constexpr std::array<Container, 5> kContainers{{{".mp4", false, true},
                                                {".webm", true, true},
                                                {".mov", true, false},
                                                {".gif", false, false},
                                                {".y4m", false, false}}};

const Container* container_of(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  const auto found = std::find_if(kContainers.begin(), kContainers.end(),
                                  [&](const Container& one) { return one.extension == extension; });
  return found == kContainers.end() ? nullptr : found;
}

/// Converts to BT.709, with the last row and column repeated if sides have to be even. Left alone, ffmpeg would convert
/// by BT.601 and tag nothing, and players would guess.
RawOptions in_video_colors(const Container& container, const FilmWriter::Format& format, std::string_view pixels) {
  std::string filter;
  const int right = format.width % 2;
  const int bottom = format.height % 2;
  if (container.needs_even_sides && right + bottom > 0) {
    filter = fmt::format("pad=ceil(iw/2)*2:ceil(ih/2)*2,fillborders=right={}:bottom={}:mode=smear,", right, bottom);
  }
  // Some encoders read the colours of the frames, others the options below.
  filter += fmt::format(
      "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int,format={},"
      "setparams=range=tv:color_primaries=bt709:color_trc=bt709:colorspace=bt709",
      pixels);
  return {"-vf",   filter,       "-pix_fmt", std::string(pixels), "-colorspace", "bt709", "-color_primaries",
          "bt709", "-color_trc", "bt709",    "-color_range",      "tv"};
}

RawOptions joined(RawOptions words, const RawOptions& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

RawOptions encoder(const Container& container, const FilmWriter::Format& format) {
  const auto colors = [&](std::string_view opaque, std::string_view transparent) {
    return in_video_colors(container, format, format.has_alpha ? transparent : opaque);
  };
  if (container.extension == ".gif") {
    return {"-filter_complex", "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=sierra2_4a",
            "-loop", "0"};
  }
  if (container.extension == ".mov") {
    return joined(colors("yuv444p10le", "yuva444p10le"),
                  {"-c:v", "prores_ks", "-profile:v", "4444", "-vendor", "apl0", "-alpha_bits", "16"});
  }
  if (container.extension == ".y4m") return joined(colors("yuv444p", ""), {"-f", "yuv4mpegpipe"});
  if (container.extension == ".webm") {
    // The alternative reference frames of VP9 do not support films with alpha.
    return joined(colors("yuv420p", "yuva420p"), {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-cpu-used", "4",
                                                  "-row-mt", "1", "-auto-alt-ref", format.has_alpha ? "0" : "1"});
  }
  return joined(colors("yuv420p", ""),
                {"-c:v", "libx264", "-preset", "veryfast", "-crf", "16", "-movflags", "+faststart"});
}

/// 24000/1001 for 23.976 and 23.98, and so on: rates of NTSC are written in decimals, but mean these fractions.
std::string exact_rate(double fps) {
  const double base = std::round(fps * 1.001);
  const bool is_whole = std::abs(fps - std::round(fps)) < 1e-6;
  if (is_whole || std::abs(fps * 1.001 - base) > 0.005) return fmt::format("{:.6f}", fps);
  return fmt::format("{:.0f}/1001", 1000 * base);
}

RawOptions ffmpeg_command(const std::string& target, const Container& container, const FilmWriter::Format& format) {
  return joined(
      joined({"ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt",
              format.has_alpha ? "rgba" : "rgb24", "-video_size", fmt::format("{}x{}", format.width, format.height),
              "-framerate", exact_rate(format.fps), "-i", "pipe:0"},
             encoder(container, format)),
      {target});
}

/// a/film.mp4 -> a/film.partial.mp4: ffmpeg chooses the format by the ending.
std::filesystem::path partial_name(const std::filesystem::path& file) {
  return file.parent_path() / (file.stem().string() + ".partial" + file.extension().string());
}

}  // namespace

bool is_film(const std::filesystem::path& file) { return container_of(file) != nullptr; }

bool is_padded(const std::filesystem::path& file, int width, int height) {
  const Container* container = container_of(file);
  return container != nullptr && container->needs_even_sides && (width % 2 != 0 || height % 2 != 0);
}

bool holds_alpha(const std::filesystem::path& file) {
  const Container* container = container_of(file);
  return container != nullptr && container->holds_alpha;
}

bool is_film_being_written(const std::filesystem::path& file) { return is_being_written(partial_name(file)); }

void require_ffmpeg() {
  if (find_program("ffmpeg")) return;
  throw Error(ErrorKind::kFailed,
              "films need the program ffmpeg, which is not on the path; install it (apt install ffmpeg) or write "
              "pictures instead (-o FOLDER)");
}

struct FilmWriter::Process {
  std::string name;
  std::optional<FileLock> lock;     // of the partial film; reports a folder that cannot be written before ffmpeg does
  std::optional<PartialFile> file;  // none: the standard output
  Format format;
  ChildProcess child;

  Process(const std::filesystem::path& f, const Container& container, const Format& its_format)
      : name(f.string()),
        lock(std::in_place, partial_name(f)),
        file(std::in_place, f, partial_name(f)),
        format(its_format),
        child(ffmpeg_command("file:" + file->path().string(), container, format)) {}
  explicit Process(const Format& its_format)
      : name("standard output"),
        format(its_format),
        child(ffmpeg_command("pipe:1", kContainers.back(), format), ChildProcess::Output::kOurs) {}

  /// ffmpeg's first message is the cause, the others follow from it.
  [[noreturn]] void fail(int status) const {
    const std::string words = child.error_output();
    throw Error(ErrorKind::kFailed,
                fmt::format("{}: ffmpeg ended with status {}: {}", name, status, words.substr(0, words.find('\n'))));
  }
};

FilmWriter::FilmWriter(const std::filesystem::path& file, const Format& format) {
  const Container* container = container_of(file);
  if (container == nullptr) {
    throw Error(ErrorKind::kUsage, file.string() + ": a film ends in .mp4, .webm, .mov, .gif or .y4m");
  }
  if (format.has_alpha && !container->holds_alpha) {
    throw Error(ErrorKind::kUsage, file.string() + ": such films have no alpha; .mov and .webm have");
  }
  require_ffmpeg();
  process_ = std::make_unique<Process>(file, *container, format);
}

FilmWriter::FilmWriter(std::unique_ptr<Process> process) : process_(std::move(process)) {}

FilmWriter FilmWriter::to_standard_output(const Format& format) {
  require_ffmpeg();
  return FilmWriter(std::make_unique<Process>(format));
}

FilmWriter::~FilmWriter() = default;
FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;

void FilmWriter::write(const Image& image) {
  if (process_ == nullptr) throw Error(ErrorKind::kFailed, "a picture came after the film was closed");
  const Format& format = process_->format;
  if (image.width != format.width || image.height != format.height) {
    throw Error(ErrorKind::kFailed, fmt::format("{}: a picture of {}x{} in a film of {}x{}", process_->name,
                                                image.width, image.height, format.width, format.height));
  }
  std::vector<std::uint8_t> with_alpha;
  if (format.has_alpha) {
    Image whole = image;
    whole.alpha.resize(whole.pixels.size() / 3, 255);
    with_alpha = interleaved(whole);
  }
  const std::vector<std::uint8_t>& bytes = format.has_alpha ? with_alpha : image.pixels;
  if (!process_->child.write(std::as_bytes(std::span(bytes)))) process_->fail(process_->child.finish());
}

void FilmWriter::close() {
  if (process_ == nullptr) return;
  const auto process = std::move(process_);
  const int status = process->child.finish();
  if (status != 0) process->fail(status);
  if (process->file) process->file->publish();
}

}  // namespace sprung
