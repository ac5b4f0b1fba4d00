#include "app/animate.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "app/make_production.h"
#include "app/make_scene.h"
#include "app/output.h"
#include "app/render_film.h"
#include "app/scene_file.h"
#include "app/simulate.h"

namespace sprung {
namespace {

std::vector<Output> parse_outputs(const SceneOptions& options) {
  std::vector<Output> outputs;
  for (const std::string& words : options.outputs) {
    outputs.push_back(parse_output(words));
    check_output(outputs.back(), options.overwrite);
  }
  return outputs;
}

}  // namespace

void animate(const SceneOptions& options, const Console& console) {
  const Scene scene = make_scene(options);
  if (options.print_scene) {
    fmt::print("{}", print_scene(with_defaults(scene)));
    return;
  }
  std::optional<tbb::global_control> threads;
  if (options.threads > 0) {
    threads.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  }
  const std::vector<Output> outputs = parse_outputs(options);
  Production production = make_production(scene, console);
  const Recording recording = simulate(production, scene, console);
  render_film(production, recording, scene, outputs, console);
  for (const std::string& output : options.outputs) fmt::print("{}\n", output);
}

}  // namespace sprung
