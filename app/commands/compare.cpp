#include "render/image/compare.h"

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "core/error.h"
#include "core/files.h"
#include "render/image/png.h"

namespace sprung {
namespace {

struct CompareOptions {
  std::filesystem::path first;
  std::filesystem::path second;
  std::filesystem::path difference;  // empty: none is written
  double mean = 0.4;                 // levels of 255 that the pictures may differ by on average ...
  double worst_block = 6;            // ... and in the worst 8 x 8 block
  bool overwrite = false;
};

/// Whether the pictures are alike.

bool compare(const CompareOptions& options) {
  if (options.second.empty()) {
    throw Error(ErrorKind::kUsage, "compare needs two pictures: sprung compare A.png B.png");
  }
  if (!options.difference.empty()) refuse_existing(options.difference, options.overwrite);
  const Image first = read_png(options.first);
  const Image second = read_png(options.second);
  if (!same_size(first, second)) {
    fmt::print("differ: {} x {} and {} x {} pixels\n", first.width, first.height, second.width, second.height);
    return false;
  }
  const ImageDifference difference = compare_images(first, second);
  const bool is_near = difference.mean <= options.mean && difference.worst_block <= options.worst_block;
  fmt::print("mean {:.4g} of 255 (at most {})\nworst block {:.4g} of 255 (at most {})\nSSIM {:.6f}\n{}\n",
             difference.mean, options.mean, difference.worst_block, options.worst_block,
             structural_similarity(first, second), is_near ? "alike" : "differ");
  if (!options.difference.empty()) {
    make_folder(options.difference.parent_path());
    write_png(difference_picture(first, second), options.difference);
  }
  return is_near;
}

}  // namespace

void add_compare(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("compare", "two pictures: how much they differ; exit code 1 if too much");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("A", options->first, "a PNG")->option_text("A.png");
  command->add_option("B", options->second, "another")->option_text("B.png");
  command->add_option("--mean", options->mean, "levels of 255 that they may differ by on average; default: 0.4")
      ->option_text("X")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--worst-block", options->worst_block, "the same in the worst 8 x 8 pixels; default: 6")
      ->option_text("X")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--difference", options->difference, "picture of the differences, 16 times as large")
      ->option_text("FILE.png");
  command->add_flag("--overwrite", options->overwrite, "replace a picture that exists");
  command->footer("Example:\n  sprung compare golden.png new.png --difference difference.png");
  command->callback([options, &invocation] {
    if (!compare(*options)) invocation.exit_code = int(ErrorKind::kFailed);
  });
}

}  // namespace sprung
