#include "app/inspect/inspect.h"

#include <fmt/format.h>

#include "app/cache/inspect_cache.h"
#include "app/inspect/brick_picture.h"
#include "app/inspect/inspection.h"
#include "app/with_scene.h"
#include "app/writable.h"
#include "core/error.h"
#include "core/io/cache.h"
#include "render/image/png.h"

namespace sprung {
namespace {

void check_picture(const SceneOptions& options) {
  if (options.picture.empty()) return;
  if (!options.overwrite && std::filesystem::exists(options.picture)) {
    throw Error(ErrorKind::kUsage, fmt::format("'{}' exists; say --overwrite to replace it", options.picture.string()));
  }
  check_writable(options.picture);
}

}  // namespace

void run_inspect(const SceneOptions& options, const Console& console) {
  if (is_cache_file(options.input)) return inspect_cache(options);
  with_scene(options, [&](const Scene& scene) {
    check_picture(options);
    std::vector<std::string> warnings;
    Console listening = console;
    listening.warnings = &warnings;
    const Preparation prepared = prepare(scene, listening);
    Inspection inspection = inspect(prepared, scene);
    if (inspection.forecast.plan) {
      if (const std::string text = warning_of(*inspection.forecast.plan); !text.empty()) listening.warn(text);
    }
    if (const std::string text = warning_of_memory(inspection.forecast.memory); !text.empty()) listening.warn(text);
    inspection.warnings = std::move(warnings);
    fmt::print("{}", options.json ? inspection_json(inspection) : inspection_text(inspection));
    if (options.picture.empty()) return;
    make_folder(options.picture.parent_path());
    write_png(draw_bricks(prepared), options.picture);
    console.note(
        fmt::format("{}: orange: parts thinner than a brick; blue: bricks that share a cell; purple: closed holes; "
                    "darker: less than half full",
                    options.picture.string()));
  });
}

}  // namespace sprung
