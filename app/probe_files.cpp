#include "app/probe_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "app/json_text.h"

namespace sprung {
namespace {

/// What a probe measures, in the order of its columns.
struct Column {
  std::string_view name;
  std::string_view unit;
  Vec3 ProbeSample::*value;
  bool is_of_pin;
};

constexpr std::array<Column, 4> kColumns{{{"position", "m", &ProbeSample::position, false},
                                          {"displacement", "m", &ProbeSample::displacement, false},
                                          {"force", "N", &ProbeSample::force, true},
                                          {"torque", "Nm", &ProbeSample::torque, true}}};

std::string json_track(const ProbeTrack& track) {
  std::vector<std::string> fields{fmt::format("\"name\": {}", json_text(track.name))};
  for (const Column& column : kColumns) {
    if (column.is_of_pin && !track.is_pin) continue;
    std::vector<std::string> values;
    for (const ProbeSample& sample : track.samples) values.push_back(json_text(sample.*column.value));
    fields.push_back(fmt::format("\"{}_{}\": [{}]", column.name, column.unit, fmt::join(values, ", ")));
  }
  return fmt::format("    {{{}}}", fmt::join(fields, ", "));
}

}  // namespace

std::string probes_csv(const Recording& recording) {
  std::string text = recording.progress_name;
  for (const ProbeTrack& track : recording.probes) {
    for (const Column& column : kColumns) {
      if (column.is_of_pin && !track.is_pin) continue;
      for (const char axis : {'x', 'y', 'z'})
        text += fmt::format(",{}.{}.{}_{}", track.name, column.name, axis, column.unit);
    }
  }
  text += "\n";
  for (std::size_t frame = 0; frame < recording.progress.size(); ++frame) {
    text += fmt::format("{}", recording.progress[frame]);
    for (const ProbeTrack& track : recording.probes) {
      for (const Column& column : kColumns) {
        if (column.is_of_pin && !track.is_pin) continue;
        const Vec3& value = track.samples[frame].*column.value;
        text += fmt::format(",{},{},{}", value.x(), value.y(), value.z());
      }
    }
    text += "\n";
  }
  return text;
}

std::string probes_json(const Recording& recording) {
  std::vector<std::string> tracks;
  for (const ProbeTrack& track : recording.probes) tracks.push_back(json_track(track));
  std::vector<std::string> progress;
  for (const double value : recording.progress) progress.push_back(json_text(value));
  std::vector<std::string> frequencies;
  for (const double value : recording.frequencies) frequencies.push_back(json_text(value));
  return fmt::format(
      "{{\n  \"state_hash\": \"{:016x}\",\n  \"{}\": [{}],\n  \"frequencies_Hz\": [{}],\n  \"probes\": "
      "[\n{}\n  ]\n}}\n",
      recording.state_hash, recording.progress_name, fmt::join(progress, ", "), fmt::join(frequencies, ", "),
      fmt::join(tracks, ",\n"));
}

}  // namespace sprung
