#include "app/film/film_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

/// Depth of the lowest vertex in any frame, m; none without a ground.
std::optional<double> depth_below_ground(const Simulation& simulation, double lowest) {
  const std::optional<double> ground = ground_height(simulation.world.obstacles);
  if (!ground) return std::nullopt;
  return std::max(0.0, *ground - lowest);
}

/// Warns if that is visible.
void warn_of_depth(const Simulation& simulation, double lowest, const Console& console) {
  constexpr double kSeen = 0.01;  // of the size
  const double depth = depth_below_ground(simulation, lowest).value_or(0);
  if (!(depth > kSeen * simulation.size)) return;
  console.warn(
      fmt::format("the drawn skin reaches {} below the ground, {:.1f} % of the size: smaller bricks (bricks) or "
                  "slower impacts keep it up",
                  readable(depth, Dimension::kLength), 100 * depth / simulation.size));
}

/// The deepest penetration of the ground by any vertex in any frame.
std::string ground_report(const Simulation& simulation, double lowest) {
  const std::optional<double> depth_below = depth_below_ground(simulation, lowest);
  if (!depth_below) return "";
  const double depth = *depth_below;
  return fmt::format(", lowest vertex {} below the ground ({:.2f} % of the size)", readable(depth, Dimension::kLength),
                     100 * depth / simulation.size);
}

}  // namespace

void finish_drawing(Progress& progress, const FilmTask& task, const Simulation& simulation, double lowest,
                    const Console& console, const std::string& remark) {
  const FilmWriter::Format format = task.format();
  const std::string made = task.is_sheet() ? count_of(task.frames().size(), "moment") + " in one"
                                           : count_of(task.frames().size(), "picture");
  progress.finish(fmt::format("{} of {} x {} pixels{}{}", made, format.width, format.height, remark,
                              ground_report(simulation, lowest)));
  warn_of_depth(simulation, lowest, console);
}

}  // namespace sprung
