#include "app/validate/quantity.h"

#include <fmt/format.h>

#include <array>

#include "core/error.h"
#include "core/units.h"

namespace sprung {
namespace {

struct ProbeField {
  std::string_view name;
  std::string_view unit;
  Vec3 ProbeSample::*value;
};

constexpr std::array<ProbeField, 4> kFields{{{"position", "m", &ProbeSample::position},
                                             {"displacement", "m", &ProbeSample::displacement},
                                             {"force", "N", &ProbeSample::force},
                                             {"torque", "N m", &ProbeSample::torque}}};

[[noreturn]] void refuse(const std::string& quantity) {
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("expect.quantity: the scene measures no '{}'; write PROBE.displacement.y (or position, force, "
                  "torque), frequency.1 with solver.scheme modes, or nodes.max_error (or mean_error, rms_error) with "
                  "experiment.nodes",
                  quantity));
}

Quantity measure_nodes(const NodeErrors& errors, const std::string& which, const std::string& quantity) {
  if (which == "mean_error") return {.value = 100 * errors.mean_error(), .unit = "%"};
  if (which == "max_error") return {.value = 100 * errors.max_error(), .unit = "%"};
  if (which == "rms_error") return {.value = 100 * errors.rms_error(), .unit = "%"};
  refuse(quantity);
}

}  // namespace

Quantity measure(const Recording& recording, const NodeErrors* errors, const std::string& quantity) {
  const auto last_dot = quantity.rfind('.');
  if (last_dot == std::string::npos) refuse(quantity);
  const std::string end = quantity.substr(last_dot + 1);
  const std::string start = quantity.substr(0, last_dot);
  if (start == "nodes" && errors != nullptr) return measure_nodes(*errors, end, quantity);
  if (start == "frequency") {
    const int mode = parse_whole(end);
    if (mode < 1 || mode > recording.frequencies.size()) refuse(quantity);
    return {.value = recording.frequencies[mode - 1], .unit = "Hz"};
  }
  const auto axis = std::string_view("xyz").find(end);
  const auto field_dot = start.rfind('.');
  if (end.size() != 1 || axis == std::string_view::npos || field_dot == std::string::npos) refuse(quantity);
  for (const ProbeTrack& track : recording.probes) {
    if (track.name != start.substr(0, field_dot)) continue;
    for (const ProbeField& field : kFields) {
      if (field.name != start.substr(field_dot + 1)) continue;
      const Vec3& value = track.samples.back().*field.value;
      return {.value = value[axis], .unit = std::string(field.unit)};
    }
  }
  refuse(quantity);
}

}  // namespace sprung
