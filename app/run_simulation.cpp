#include "app/run_simulation.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/draw_diverged.h"
#include "app/make_production.h"
#include "app/probe_files.h"
#include "app/report/whole_file.h"
#include "app/simulate.h"
#include "app/with_scene.h"
#include "app/writable.h"
#include "core/error.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

/// Where the files can be written, and would replace nothing that they may not.
fs::path output_folder(const SceneOptions& options) {
  if (options.outputs.size() != 1) throw Error(ErrorKind::kUsage, "simulate writes into one folder: -o DIR");
  fs::path folder = options.outputs.front();
  for (const char* name : {"probes.csv", "probes.json"}) {
    if (options.overwrite || !fs::exists(folder / name)) continue;
    throw Error(ErrorKind::kUsage, fmt::format("'{}' exists; say --overwrite to replace it", (folder / name).string()));
  }
  check_writable(folder / "probes.json");
  return folder;
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
    const fs::path folder = output_folder(options);
    Production production = make_production(scene, console);
    const Recording recording = with_picture_of_diverged(production.world, folder / "diverged.png",
                                                         [&] { return simulate(production, scene, console); });
    make_folder(folder);
    write_whole_file(folder / "probes.csv", probes_csv(recording));
    write_whole_file(folder / "probes.json", probes_json(recording));
    print_summary(recording);
  });
}

}  // namespace sprung
