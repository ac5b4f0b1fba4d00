#include "app/export/export_files.h"

#include <fmt/format.h>

#include "app/console/interrupt.h"
#include "app/export/posed_meshes.h"
#include "core/error.h"
#include "core/io/mesh_export.h"
#include "core/text.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

std::string usage() {
  return fmt::format("give a name like {}; sprung export --list names the formats", example_targets());
}

[[noreturn]] void refuse(std::string_view words, std::string_view reason) {
  throw Error(ErrorKind::kUsage, fmt::format("--output {}: {}; {}", words, reason, usage()));
}

void export_numbered(const ExportTarget& target, const CachedFilmView& view, const FrameRange& range,
                     const Console& console) {
  for (const int frame : range.frames()) {
    stop_if_interrupted();
    const std::vector<PosedMesh> meshes =
        posed_meshes(view.simulation, view.film, view.cache.positions(std::size_t(frame) - 1));
    const fs::path file = target.numbered ? target.numbered->file(frame) : target.file;
    const std::string lost = frame == range.first ? lost_content(*find_mesh_format(file), meshes) : "";
    if (!lost.empty()) console.warn(fmt::format("{} files do not keep: {}", file.extension().string(), lost));
    export_meshes(meshes, file);
  }
}

}  // namespace

std::string example_targets() {
  std::string names = "skin_{:04}.obj";
  for (const AnimationFormat& format : animation_formats()) names += fmt::format(", {}", format.example);
  return names;
}

ExportTarget parse_export_target(std::string_view typed) {
  const std::string name = with_braces(typed);
  const std::string_view words = name;
  if (has_number(words)) {
    NumberedName numbered = parse_numbered_name(words, usage());
    if (find_mesh_format(numbered.file(1)) == nullptr) refuse(words, "no format of single frames");
    return {.file = {}, .numbered = std::move(numbered)};
  }
  const fs::path file(words);
  if (const AnimationFormat* animation = find_animation_format(file)) {
    return {.animation = animation, .file = file, .numbered = {}};
  }
  if (find_mesh_format(file) != nullptr) return {.file = file, .numbered = {}};
  std::vector<std::string_view> known;
  for (const AnimationFormat& format : animation_formats()) known.push_back(format.extension);
  for (const MeshFormat& format : mesh_formats()) known.push_back(format.extension);
  const std::string ending = file.extension().string();
  refuse(words, fmt::format("'{}' files cannot be written{}", ending, did_you_mean(ending, known)));
}

std::vector<fs::path> files_of(const ExportTarget& target, const Film& film, const FrameRange& range) {
  std::vector<fs::path> files;
  if (target.numbered) {
    for (const int frame : range.frames()) files.push_back(target.numbered->file(frame));
  } else if (target.animation != nullptr && target.animation->is_per_mesh) {
    for (std::size_t i = 0; i < mesh_count(film); ++i) files.push_back(file_of_mesh(target.file, i, mesh_count(film)));
  } else {
    files.push_back(target.file);
  }
  if (target.animation == nullptr && files.size() == 1 && range.count() > 1) {
    refuse(target.file.string(), fmt::format("one such file cannot hold {} frames", range.count()));
  }
  return files;
}

void export_files(const ExportTarget& target, std::span<const CachedFilmView> takes, const FrameRange& range,
                  const Console& console) {
  Progress progress(console, "export");
  if (target.animation != nullptr) {
    target.animation->write(
        {.file = target.file, .takes = takes, .range = range, .quantize = target.quantize, .console = console});
  } else {
    export_numbered(target, takes.front(), range, console);
  }
  const std::string name = target.numbered ? target.numbered->file(range.first).string() : target.file.string();
  progress.finish(fmt::format("{} to {}", count_of(range.count(), "frame"), name));
}

}  // namespace sprung
