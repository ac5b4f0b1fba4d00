#include "app/commands/simulate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <numeric>
#include <optional>
#include <set>

#include "app/commands/command_line.h"
#include "app/console/json_text.h"
#include "app/film/draw_diverged.h"
#include "app/film/film_output.h"
#include "app/inspect/forecast.h"
#include "app/scene/cached_film.h"
#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/files.h"
#include "core/simulation/run_cache.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "core/text.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

/// Where the results go.
struct Places {
  std::optional<fs::path> folder;  // of probes.csv, probes.json and manifest.json
  std::optional<fs::path> cache;
};

void refuse_existing(const fs::path& file, std::string_view remedy) {
  if (!fs::exists(file)) return;
  throw Error(ErrorKind::kUsage, fmt::format("'{}' exists; say {} to replace it", file.string(), remedy));
}

/// Where the files can be written, and would replace nothing that they may not.
Places places_of(const SceneOptions& options) {
  Places places;
  constexpr std::array<std::string_view, 1> kCaches{".h5"};
  for (const std::string& output : options.outputs) {
    if (!is_cache_file(output)) check_folder_name(output, kCaches, "give a cache, RUN.h5, or a folder");
    std::optional<fs::path>& place = is_cache_file(output) ? places.cache : places.folder;
    if (place) throw Error(ErrorKind::kUsage, "simulate writes one cache and one folder: -o RUN.h5 -o folder/");
    place = output;
  }
  if (options.resume && options.overwrite) throw Error(ErrorKind::kUsage, "give --resume or --overwrite, not both");
  if (options.resume && !places.cache) throw Error(ErrorKind::kUsage, "--resume goes on with a cache: -o RUN.h5");
  if (options.position_error > 0 && !places.cache) {
    throw Error(ErrorKind::kUsage, "--position-error is about a cache: -o RUN.h5");
  }
  if (places.cache) {
    if (!options.overwrite && !options.resume) {
      refuse_existing(*places.cache, "--resume to go on with it, or --overwrite");
    }
    check_writable(*places.cache);
  }
  if (places.folder) {
    for (const char* name : {"probes.csv", "probes.json", "manifest.json"}) {
      if (!options.overwrite && !options.resume) refuse_existing(*places.folder / name, "--overwrite");
    }
    check_writable(*places.folder / "probes.json");
  }
  return places;
}

fs::path picture_of_diverged(const Places& places) {
  if (places.folder) return *places.folder / "diverged.png";
  return fs::path(*places.cache).replace_extension("diverged.png");
}

/// The words that go on with what was begun.
std::string resuming_command(const SceneOptions& options) {
  if (options.resume) return options.command;
  std::string command = options.command;
  const std::string_view overwrite = " --overwrite";
  if (const auto place = command.find(overwrite); place != std::string::npos) command.erase(place, overwrite.size());
  return command + " --resume";
}

/// Does `work`; where it ends early, says how to go on.
Recording with_advice(const RunCache* cache, const SceneOptions& options, const Console& console,
                      const std::function<Recording()>& work) {
  try {
    return work();
  } catch (...) {
    if (cache != nullptr && cache->frame_count() > 0) {
      console.note(fmt::format("{} in {}; go on with: {}", count_of(cache->frame_count(), "frame is", "frames are"),
                               cache->file().string(), resuming_command(options)));
    }
    throw;
  }
}

void print_vector(std::string_view probe, std::string_view what, const Vec3& value, std::string_view unit) {
  fmt::print("{} {} [{:.6g}, {:.6g}, {:.6g}] {}\n", probe, what, value.x(), value.y(), value.z(), unit);
}

void print_summary(const Recording& recording) {
  fmt::print("state {:016x}\n", recording.state_hash);
  for (int i = 0; i < recording.frequencies.size(); ++i) {
    fmt::print("frequency {} {:.6g} Hz\n", i + 1, recording.frequencies[i]);
  }
  for (const ProbeTrack& track : recording.probes) {
    const ProbeSample& last = track.samples.back();
    print_vector(track.name, "position", last.position, "m");
    print_vector(track.name, "displacement", last.displacement, "m");
    if (!track.is_pin) continue;
    print_vector(track.name, "force", last.force, "N");
    print_vector(track.name, "torque", last.torque, "N m");
  }
}

}  // namespace

void run_simulation(const SceneOptions& options, const Console& console) {
  with_scene(options, [&](const Film& scene) {
    const Places places = places_of(options);
    std::optional<RunCache> cache;
    if (places.cache) {
      make_folder(places.cache->parent_path());
      cache.emplace(*places.cache, record_of(scene), options.resume, options.position_error);
    }
    Simulation simulation = prepare_simulation(scene, console);
    warn_of_memory(simulation, scene, console);
    RunCache* kept = cache ? &*cache : nullptr;
    const Recording recording = with_advice(kept, options, console, [&] {
      return with_picture_of_diverged(simulation.world, picture_of_diverged(places),
                                      [&] { return simulate(simulation, scene, console, kept); });
    });
    if (cache) cache->close();
    if (places.folder) {
      make_folder(*places.folder);
      write_file(*places.folder / "probes.csv", probes_csv(recording));
      write_file(*places.folder / "probes.json", probes_json(recording));
      write_file(*places.folder / "manifest.json", manifest_json(scene, recording));
    }
    print_summary(recording);
  });
}

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

namespace {

std::string mesh_hashes(const Film& scene) {
  std::set<std::string> files;
  for (const SceneBody& body : scene.bodies) files.insert(body.mesh.string());
  for (const SceneObstacle& obstacle : scene.obstacles) files.insert(obstacle.mesh.string());
  files.erase("");
  std::vector<std::string> lines;
  lines.reserve(files.size());
  for (const std::string& file : files) {
    lines.push_back(fmt::format("{}: \"{}\"", json_text(std::string_view(file)), file_hash(file)));
  }
  return fmt::format("{{{}}}", fmt::join(lines, ", "));
}

}  // namespace

std::string manifest_json(const Film& scene, const Recording& recording) {
  const double total = std::accumulate(recording.seconds.begin(), recording.seconds.end(), 0.0);
  return fmt::format(
      "{{\n  \"version\": \"{}\",\n  \"build\": \"{}\",\n  \"scene\": {},\n  \"mesh_hashes\": {},\n  \"frames\": {},\n"
      "  \"state_hash\": \"{:016x}\",\n  \"seconds\": {:.3f},\n  \"seconds_of_frames\": [{:.4f}]\n}}\n",
      SPRUNG_VERSION, build_of_this_program(), json_text(std::string_view(print_scene(with_defaults(scene)))),
      mesh_hashes(scene), recording.progress.size(), recording.state_hash, total, fmt::join(recording.seconds, ", "));
}

}  // namespace sprung
