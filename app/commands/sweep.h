#pragma once
#include "app/commands/command_line.h"
#include "app/console/console.h"

namespace sprung {

/// `sprung sweep SCENE --set KEY=A,B,C ... -o FOLDER`: every combination of the values as a run of its own. Writes
/// FOLDER/001/scene.toml ..., the scenes as resolved, FOLDER/runs.json, which says what differs, and FOLDER/commands,
/// one line a run for a shell, GNU parallel or a scheduler; prints that file's name. Each run leaves its cache, probes
/// and a manifest in its folder. FOLDER/run, for a shell, does them all and writes FOLDER/table.csv.
/// `sprung sweep FOLDER --table`: how long the runs took and what their probes saw last, as CSV to stdout; runs that
/// are not done are named on stderr. Throws Error.
void sweep(const SceneOptions& options, const Console& console);

/// The values of "a,b,[0,0,1]": commas in brackets do not count.
[[nodiscard]] std::vector<std::string> values_in(std::string_view text);

}  // namespace sprung
