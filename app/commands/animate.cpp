#include "app/commands/animate.h"

#include <fmt/format.h>

#include "app/commands/command_line.h"
#include "app/film/draw_diverged.h"
#include "app/film/film_output.h"
#include "app/film/film_pipeline.h"
#include "app/film/render_film.h"
#include "app/inspect/forecast.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "render/film.h"

namespace sprung {
namespace {

/// The film formats with compressed colour take even sides only.
void note_padding(const std::vector<Output>& outputs, const SceneRender& render, const Console& console) {
  const auto [width, height] = render.resolution;
  for (const Output& output : outputs) {
    if (output.kind != Output::Kind::kFilm || !is_padded(output.film, width, height)) continue;
    console.note(
        fmt::format("size: {} gets {} x {} pixels, since its format takes even sides only; the last column or "
                    "row of {} x {} is repeated",
                    output.film.string(), width + width % 2, height + height % 2, width, height));
  }
}

std::filesystem::path picture_of_diverged(const Output& output) {
  if (output.kind == Output::Kind::kFilm) return std::filesystem::path(output.film).replace_extension("diverged.png");
  return output.folder / "diverged.png";
}

}  // namespace

void animate(const SceneOptions& options, const Console& console) {
  with_scene(options, [&](const Film& scene) {
    const std::vector<Output> outputs = parse_outputs(options.outputs);
    for (const Output& output : outputs) check_output(output, options.overwrite);
    note_padding(outputs, scene.render, console);
    const std::optional<Environment> surroundings = read_surroundings(scene.render);  // before any work is lost
    Simulation simulation = prepare_simulation(scene, console);
    warn_of_memory(simulation, scene, console);
    const Recording recording = with_picture_of_diverged(simulation.world, picture_of_diverged(outputs.front()),
                                                         [&] { return simulate(simulation, scene, console); });
    render_film({{scene, simulation, recording}}, surroundings, whole_film(recording.progress.size()), outputs, console,
                options.jobs);
    for (const std::string& output : options.outputs) fmt::print("{}\n", output);
  });
}

}  // namespace sprung
