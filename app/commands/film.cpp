#include <fmt/format.h>

#include <algorithm>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/console/interrupt.h"
#include "app/film/film_output.h"
#include "core/error.h"
#include "core/text.h"
#include "render/image/png.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFrames = 1000000000;  // that --frames may name

struct FilmOptions {
  std::string input;  // the pictures
  OutputOptions outputs;
  std::string frames;  // "1:48:2"
  std::string fps;
  bool overwrite = false;
};

int last_number(const Output& pictures) {
  int last = 0;
  for (const fs::path& file : existing_pictures(pictures)) {
    const std::string name = file.filename().string();
    const auto digits = name.size() - pictures.before.size() - pictures.after.size();
    if (digits > 9) continue;
    last = std::max(last, std::stoi(name.substr(pictures.before.size(), digits)));
  }
  return last;
}

/// The missing pictures, "25:48, 70"; empty if there are none.
std::string gaps_in(const Output& pictures, const FrameRange& range) {
  std::string gaps;
  const auto is_missing = [&](int number) { return number <= range.last && !fs::exists(pictures.picture(number)); };
  for (int number = range.first; number <= range.last; number += range.step) {
    if (!is_missing(number)) continue;
    const int first = number;
    while (is_missing(number + range.step)) number += range.step;
    gaps += gaps.empty() ? "" : ", ";
    gaps += number == first ? fmt::format("{}", first) : fmt::format("{}:{}", first, number);
  }
  return gaps;
}

std::vector<Output> films_of(const FilmOptions& options) {
  std::vector<Output> films = parse_outputs(options.outputs.names);
  for (const Output& film : films) {
    if (film.kind != Output::Kind::kFilm) {
      throw Error(ErrorKind::kUsage, "film makes films of pictures: -o film.mp4, .webm, .mov or .gif");
    }
    check_output(film, options.overwrite);
  }
  return films;
}

bool all_hold_alpha(const std::vector<Output>& films) {
  return std::all_of(films.begin(), films.end(), [](const Output& film) { return holds_alpha(film.file); });
}

void make_film(const FilmOptions& options, double fps, const Console& console) {
  const std::vector<Output> films = films_of(options);
  const Output pictures = parse_output(options.input);
  const bool are_pictures = pictures.kind == Output::Kind::kPictures && pictures.is_numbered();
  const int last = are_pictures ? last_number(pictures) : 0;
  if (last == 0) throw Error(ErrorKind::kBadInput, fmt::format("'{}': no numbered pictures are there", options.input));
  const std::size_t count = options.frames.empty() ? std::size_t(last) : kMaxFrames;
  FrameRange range = parse_frame_range(options.frames, count);
  if (range.last == int(kMaxFrames)) range.last = last;
  if (const std::string gaps = gaps_in(pictures, range); !gaps.empty()) {
    throw Error(ErrorKind::kBadInput, fmt::format("'{}': these pictures are missing: {}", options.input, gaps));
  }
  Progress progress(console, "film", range.count(), 1, "frames/s");
  const Image first = read_png(pictures.picture(range.first));
  PictureWriter writer(films, {.width = first.width,
                               .height = first.height,
                               .fps = fps,
                               .has_alpha = !first.alpha.empty() && all_hold_alpha(films)});
  int done = 0;
  for (const int number : range.frames()) {
    stop_if_interrupted();
    Image image = read_png(pictures.picture(number));
    if (image.width != first.width || image.height != first.height) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("'{}' is {} x {} pixels, those before {} x {}", pictures.picture(number).string(),
                              image.width, image.height, first.width, first.height));
    }
    writer.write({.image = std::move(image)});
    progress.update(++done);
  }
  writer.close();
  progress.finish(count_of(range.count(), "picture"));
  options.outputs.print();
}

}  // namespace

void add_film(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("film", "numbered pictures in, a film out");
  const auto options = std::make_shared<FilmOptions>();
  command->add_option("INPUT", options->input, "folder/, or folder/frame_{:04}.png");
  options->outputs.add_to(*command, "film.mp4, .webm, .mov, .gif; may be given several times");
  command->add_option("--frames", options->frames, "these only; default: from 1 to the last that is there")
      ->option_text("A:B:STEP");
  const CLI::Option* fps =
      command->add_option("--fps", options->fps, "pictures a second; default: 24")->option_text("N");
  command->add_flag("--overwrite", options->overwrite, "replace films that exist");
  add_messages(*command, invocation.console);
  command->footer("Example:\n  sprung film frames/ -o film.mp4 --fps 24");
  command->callback([options, command, fps, &invocation] {
    require_input(*command, options->input, "a folder of pictures");
    options->outputs.require(*command, "-o film.mp4");
    make_film(*options, key_value<double>(*fps, "fps", options->fps).value_or(Film{}.fps), invocation.console);
  });
}

}  // namespace sprung
