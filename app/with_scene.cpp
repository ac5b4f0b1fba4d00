#include "app/with_scene.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <optional>

#include "app/scene/make_scene.h"
#include "app/scene/scene_file.h"

namespace sprung {

void with_scene(const SceneOptions& options, const std::function<void(const Scene&)>& work) {
  const Scene scene = make_scene(options);
  if (options.print_scene) {
    fmt::print("{}", print_scene(with_defaults(scene)));
    return;
  }
  std::optional<tbb::global_control> threads;
  if (options.threads > 0) {
    threads.emplace(tbb::global_control::max_allowed_parallelism, options.threads);
  }
  work(scene);
}

}  // namespace sprung
