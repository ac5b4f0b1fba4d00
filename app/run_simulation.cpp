#include "app/run_simulation.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <optional>

#include "app/cache/run_cache.h"
#include "app/draw_diverged.h"
#include "app/make_production.h"
#include "app/manifest.h"
#include "app/output.h"
#include "app/probe_files.h"
#include "app/report/whole_file.h"
#include "app/simulate.h"
#include "app/with_scene.h"
#include "app/writable.h"
#include "core/error.h"
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
  with_scene(options, [&](const Scene& scene) {
    const Places places = places_of(options);
    std::optional<RunCache> cache;
    if (places.cache) {
      make_folder(places.cache->parent_path());
      cache.emplace(*places.cache, options.resume, options.position_error);
    }
    Production production = make_production(scene, console);
    RunCache* kept = cache ? &*cache : nullptr;
    const Recording recording = with_advice(kept, options, console, [&] {
      return with_picture_of_diverged(production.world, picture_of_diverged(places),
                                      [&] { return simulate(production, scene, console, kept); });
    });
    if (cache) cache->close();
    if (places.folder) {
      make_folder(*places.folder);
      write_whole_file(*places.folder / "probes.csv", probes_csv(recording));
      write_whole_file(*places.folder / "probes.json", probes_json(recording));
      write_whole_file(*places.folder / "manifest.json", manifest_json(scene, recording));
    }
    print_summary(recording);
  });
}

}  // namespace sprung
