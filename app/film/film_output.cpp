#include "app/film/film_output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "render/film.h"
#include "render/image/exr.h"
#include "render/image/png.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExamples =
    "give a folder, a pattern like frame_{:04}.png, a picture (.png), or a film (.mp4, .webm, .mov, .gif)";
constexpr std::array<std::string_view, 7> kEndings{".mp4", ".webm", ".mov", ".gif", ".y4m", ".png", ".exr"};

[[noreturn]] void refuse(std::string_view words, std::string_view reason) {
  throw Error(ErrorKind::kUsage, fmt::format("--output {}: {}; {}", words, reason, kExamples));
}

/// The kind of files with that ending; none if these hold no pictures.
std::optional<Output::Kind> kind_of(const std::string& name) {
  const std::string ending = lower_extension(name);
  if (ending == ".png") return Output::Kind::kPictures;
  if (ending == ".exr") return Output::Kind::kPasses;
  return std::nullopt;
}

/// The format of the standard output; none if that is not meant.
std::optional<Output::Stream> stream_of(std::string_view words) {
  if (words == "-") return Output::Stream::kAny;
  if (words == "-.png") return Output::Stream::kPng;
  if (words == "-.y4m") return Output::Stream::kY4m;
  if (words == "-.rgb") return Output::Stream::kRgb;
  return std::nullopt;
}

Output parse_pattern(std::string_view words) {
  NumberedName name = parse_numbered_name(words, kExamples);
  const std::optional<Output::Kind> kind = kind_of("f" + name.after);
  if (!kind) refuse(words, "pictures are PNG files, their passes EXR files");
  return {.kind = *kind, .folder = name.folder, .before = name.before, .after = name.after, .digits = name.digits};
}

bool is_number(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

fs::path or_here(const fs::path& folder) { return folder.empty() ? fs::path(".") : folder; }

/// The canonical path, whatever its spelling.
fs::path canonical_path(const fs::path& path) {
  std::error_code ignored;
  fs::path full = fs::weakly_canonical(fs::absolute(path, ignored), ignored).lexically_normal();
  return full.has_filename() ? full : full.parent_path();
}

bool is_below(const fs::path& path, const fs::path& above) {
  return std::mismatch(above.begin(), above.end(), path.begin(), path.end()).first == above.end();
}

/// True if one would replace the other or block its path.
bool collide(const Output& a, const Output& b) {
  const bool a_is_stream = a.kind == Output::Kind::kStream;
  const bool b_is_stream = b.kind == Output::Kind::kStream;
  if (a_is_stream || b_is_stream) return a_is_stream && b_is_stream;
  if (!a.is_numbered() && !b.is_numbered()) return canonical_path(a.file) == canonical_path(b.file);
  if (!a.is_numbered()) return is_below(canonical_path(or_here(b.folder)), canonical_path(a.file));
  if (!b.is_numbered()) return collide(b, a);
  return canonical_path(or_here(a.folder)) == canonical_path(or_here(b.folder)) && a.before == b.before &&
         a.after == b.after;
}

}  // namespace

fs::path Output::picture(int number) const {
  return is_numbered() ? NumberedName{folder, before, after, digits}.file(number) : file;
}

void check_folder_name(std::string_view words, std::span<const std::string_view> endings, std::string_view examples) {
  const fs::path path(words);
  const std::string ending = lower_extension(path);
  if (ending.empty() || words.ends_with('/') || fs::is_directory(path)) return;
  throw Error(ErrorKind::kUsage,
              fmt::format("--output {0}: '{1}' files cannot be written{2} (a folder of that name: {0}/); {3}", words,
                          ending, did_you_mean(ending, endings), examples));
}

Output parse_output(std::string_view typed) {
  const std::string name = with_braces(typed);
  const std::string_view words = name;
  if (words.empty()) refuse("''", "the name is empty");
  if (const auto stream = stream_of(words)) return {.kind = Output::Kind::kStream, .stream = *stream};
  const bool is_folder = words.ends_with('/');
  if (!is_folder && words.find_first_of("{}") != std::string_view::npos) return parse_pattern(words);
  const fs::path path(words);
  if (!is_folder && is_film(path)) return {.kind = Output::Kind::kFilm, .folder = path.parent_path(), .file = path};
  const std::optional<Output::Kind> kind = kind_of(path.filename().string());
  if (!is_folder && kind && !fs::is_directory(path)) {
    if (words.find('%') != std::string_view::npos) refuse(words, "the number after a % must look like %04d");
    return {.kind = *kind, .folder = path.parent_path(), .file = path};
  }
  check_folder_name(words, kEndings, kExamples);
  return {.kind = Output::Kind::kPictures, .folder = path, .before = "frame_", .after = ".png", .digits = 4};
}

std::vector<fs::path> existing_pictures(const Output& output) {
  std::vector<fs::path> found;
  if (!output.is_numbered() || !fs::is_directory(or_here(output.folder))) return found;
  for (const fs::directory_entry& entry : fs::directory_iterator(or_here(output.folder))) {
    const std::string name = entry.path().filename().string();
    if (name.size() <= output.before.size() + output.after.size()) continue;
    if (!name.starts_with(output.before) || !name.ends_with(output.after)) continue;
    const auto digits = name.size() - output.before.size() - output.after.size();
    if (is_number(std::string_view(name).substr(output.before.size(), digits))) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

int remove_beyond(const Output& output, int last) {
  int removed = 0;
  for (const fs::path& picture : existing_pictures(output)) {
    const std::string name = picture.filename().string();
    int number = 0;
    std::from_chars(name.data() + output.before.size(), name.data() + name.size() - output.after.size(), number);
    if (number > last && fs::remove(picture)) ++removed;
  }
  return removed;
}

std::vector<Output> parse_outputs(const std::vector<std::string>& words) {
  std::vector<Output> outputs;
  for (const std::string& word : words) {
    outputs.push_back(parse_output(word));
    for (std::size_t other = 0; other + 1 < outputs.size(); ++other) {
      if (!collide(outputs[other], outputs.back())) continue;
      throw Error(ErrorKind::kUsage,
                  fmt::format("--output {} and --output {} would write to the same place; give only one of them",
                              words[other], word));
    }
  }
  return outputs;
}

void check_output(const Output& output, bool overwrite) {
  if (output.kind == Output::Kind::kStream) {
    if (::isatty(STDOUT_FILENO) != 0) refuse("-", "the standard output is a terminal; pipe it into a program");
    return;
  }
  if (!output.is_numbered()) {
    if (fs::is_directory(output.file)) refuse(output.file.string(), "it is a folder");
    if (output.kind == Output::Kind::kFilm) {
      require_ffmpeg();
      if (is_film_being_written(output.file)) refuse_second_run(output.file);
    }
    if (!overwrite && fs::exists(output.file)) {
      throw Error(ErrorKind::kUsage, fmt::format("'{}' exists; say --overwrite to replace it", output.file.string()));
    }
    check_writable(output.file);
    return;
  }
  const std::vector<fs::path> pictures = existing_pictures(output);
  if (!overwrite && !pictures.empty()) {
    const auto more = long(pictures.size()) - 1;
    throw Error(ErrorKind::kUsage,
                more == 0 ? fmt::format("'{}' exists; say --overwrite to replace it", pictures.front().string())
                          : fmt::format("'{}' and {} exist; say --overwrite to replace them", pictures.front().string(),
                                        count_of(more, "more picture")));
  }
  check_writable(output.picture(1));
}

namespace {

constexpr std::size_t kMaxWaiting = 4;

}  // namespace

/// Writes successive pictures to one file or stream.
class SequenceWriter {
 public:
  virtual ~SequenceWriter() = default;
  virtual void write(const Image& image) = 0;
  virtual void close() = 0;
};

namespace {

/// A film, through ffmpeg.
class EncodedSequence : public SequenceWriter {
 public:
  explicit EncodedSequence(FilmWriter film) : film_(std::move(film)) {}
  void write(const Image& image) override { film_.write(image); }
  void close() override { film_.close(); }

 private:
  FilmWriter film_;
};

/// Writes to the standard output, picture by picture.
class StreamedPictures : public SequenceWriter {
 public:
  explicit StreamedPictures(bool as_png) : as_png_(as_png) {}
  void write(const Image& image) override {
    const std::vector<std::uint8_t> bytes = as_png_ ? encode_png(image) : interleaved(image);
    const bool is_written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
    if (!is_written || std::fflush(stdout) != 0) {
      throw Error(ErrorKind::kFailed, fmt::format("cannot write to the standard output: {}", std::strerror(errno)));
    }
  }
  void close() override {}

 private:
  bool as_png_;
};

std::unique_ptr<SequenceWriter> sequence_writer(const Output& output, const FilmWriter::Format& format) {
  if (output.kind == Output::Kind::kFilm) return std::make_unique<EncodedSequence>(FilmWriter(output.file, format));
  if (output.stream == Output::Stream::kY4m) {
    return std::make_unique<EncodedSequence>(FilmWriter::to_standard_output(format));
  }
  return std::make_unique<StreamedPictures>(output.stream == Output::Stream::kPng);
}

}  // namespace

PictureWriter::PictureWriter(std::vector<Output> outputs, const FilmWriter::Format& format)
    : outputs_(std::move(outputs)) {
  for (const Output& output : outputs_) {
    make_folder(output.folder);
    if (output.is_sequence()) sequences_.push_back(sequence_writer(output, format));
  }
  thread_ = std::thread([this] { run(); });
}

PictureWriter::~PictureWriter() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    is_closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void PictureWriter::write(Drawing drawing) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kMaxWaiting || failure_; });
  if (failure_) std::rethrow_exception(failure_);
  waiting_.push_back(std::move(drawing));
  changed_.notify_all();
}

void PictureWriter::close() {
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
  thread_.join();
  if (failure_) std::rethrow_exception(failure_);
  for (const auto& sequence : sequences_) sequence->close();
}

void PictureWriter::run() {
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !waiting_.empty() || is_closed_; });
    if (waiting_.empty()) return;
    const Drawing drawing = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    changed_.notify_all();
    try {
      write_everywhere(drawing);
    } catch (...) {
      lock.lock();
      failure_ = std::current_exception();
      changed_.notify_all();
      return;
    }
  }
}

void PictureWriter::write_everywhere(const Drawing& drawing) {
  for (const Output& output : outputs_) {
    if (output.kind == Output::Kind::kPictures) write_png(drawing.image, output.picture(drawing.number));
    if (output.kind == Output::Kind::kPasses) write_exr(drawing.passes.value(), output.picture(drawing.number));
  }
  for (const auto& sequence : sequences_) sequence->write(drawing.image);
}

}  // namespace sprung
