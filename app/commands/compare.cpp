#include "app/commands/compare.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/files.h"
#include "render/image/compare.h"
#include "render/image/png.h"

namespace sprung {

bool compare(const CompareOptions& options) {
  if (!options.difference.empty() && !options.overwrite && std::filesystem::exists(options.difference)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("'{}' exists; say --overwrite to replace it", options.difference.string()));
  }
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

}  // namespace sprung
