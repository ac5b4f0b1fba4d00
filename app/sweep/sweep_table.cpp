#include "app/sweep/sweep_table.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/scene/cached_film.h"
#include "app/scene/probe_columns.h"
#include "app/scene/scene_reference.h"
#include "core/error.h"
#include "core/files.h"
#include "core/simulation/run_cache.h"
#include "core/units.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Column = SweepTable::Column;

Dimension dimension_of(const std::string& key) {
  try {
    return key_at(key).dimension;
  } catch (const Error&) {
    return Dimension::kNone;
  }
}

/// Converts a value to the unit of its column, if it is a quantity.
std::string in_base_unit(const std::string& value, Dimension dimension) {
  if (dimension == Dimension::kNone) return value;
  try {
    return fmt::format("{}", parse_quantity(value, dimension));
  } catch (const Error&) {
    return value;
  }
}

/// The table of a sweep without runs.
SweepTable empty_table(const Json& runs) {
  SweepTable table;
  table.columns.push_back({.name = "run", .unit = ""});
  for (const auto& [key, value] : runs.at(0).at("set").items()) {
    table.columns.push_back({.name = key, .unit = std::string(base_unit(dimension_of(key)))});
    ++table.swept;
  }
  return table;
}

void add_measurement_columns(const CacheHeader& header, SweepTable& table) {
  const auto add = [&](std::string name, std::string unit) {
    table.columns.push_back({std::move(name), std::move(unit)});
  };
  add("frames", "");
  add("seconds", "");
  add(header.progress_name, "");
  add("state_hash", "");
  for (const Probe& probe : cached_film(header).probes) {
    each_column(probe.kind(), [&](const ProbeQuantity& quantity, std::size_t number) {
      add(fmt::format("{}.{}", probe.name, quantity.label(number)), std::string(quantity.unit));
    });
  }
}

/// The cells of a run, from the first column on.
std::vector<std::string> row_of(const Json& run, const SweepTable& table, const CacheReader& cache) {
  std::vector<std::string> row{run.at("folder").get<std::string>()};
  for (std::size_t i = 0; i < table.swept; ++i) {
    const std::string& key = table.columns[1 + i].name;
    row.push_back(in_base_unit(run.at("set").at(key).get<std::string>(), dimension_of(key)));
  }
  const CachedFrame last = cache.frame(cache.frame_count() - 1);
  double seconds = 0;
  for (std::size_t frame = 0; frame < cache.frame_count(); ++frame) seconds += cache.frame(frame).seconds;
  row.push_back(fmt::format("{}", cache.frame_count()));
  row.push_back(fmt::format("{:.3f}", seconds));
  row.push_back(fmt::format("{}", last.progress));
  row.push_back(fmt::format("{:016x}", last.state_hash));
  const std::vector<Probe> probes = cached_film(cache.header()).probes;
  for (std::size_t probe = 0; probe < probes.size(); ++probe) {
    const ProbeSample sample = sample_of(last, probe);
    each_column(probes[probe].kind(), [&](const ProbeQuantity& quantity, std::size_t number) {
      row.push_back(fmt::format("{}", quantity.of(sample)[number]));
    });
  }
  return row;
}

Json read_runs(const fs::path& folder) {
  const fs::path file = folder / "runs.json";
  if (!fs::exists(file)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("'{}' is not the folder of a sweep: it has no runs.json", folder.string()));
  }
  Json runs = Json::parse(read_file(file), nullptr, false);
  if (!runs.is_array() || runs.empty()) {
    throw Error(ErrorKind::kBadInput, fmt::format("'{}' has no runs of a sweep", file.string()));
  }
  return runs;
}

/// RFC 4180.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted += letter == '"' ? "\"\"" : std::string(1, letter);
  return quoted + "\"";
}

}  // namespace

SweepTable read_sweep_table(const fs::path& folder, const Console& console) {
  const Json runs = read_runs(folder);
  SweepTable table = empty_table(runs);
  for (const Json& run : runs) {
    const std::string name = run.at("folder").get<std::string>();
    const fs::path file = folder / name / "run.h5";
    if (!fs::exists(file)) {
      console.warn(fmt::format("run {} is not begun", name));
      continue;
    }
    const CacheReader cache(file);
    const Film film = cached_film(cache.header());
    const int planned = frame_count(film);
    if (int(cache.frame_count()) < planned && !film.until_still) {
      console.warn(fmt::format("run {} has {} of its {} frames", name, cache.frame_count(), planned));
    }
    if (table.columns.size() == 1 + table.swept) add_measurement_columns(cache.header(), table);
    const std::vector<std::string> row = row_of(run, table, cache);
    if (row.size() != table.columns.size()) {
      throw Error(ErrorKind::kBadInput, fmt::format("run {} has other probes than those before it", name));
    }
    for (std::size_t i = 0; i < row.size(); ++i) table.columns[i].cells.push_back(row[i]);
  }
  return table;
}

std::string csv_text(const SweepTable& table) {
  std::string text;
  const auto add_line = [&](const auto& cell_of) {
    for (const Column& column : table.columns) {
      text += (&column == &table.columns.front() ? "" : ",") + csv_cell(cell_of(column));
    }
    text += "\n";
  };
  add_line([](const Column& column) { return column_name(column.name, column.unit); });
  for (std::size_t run = 0; run < table.columns.front().cells.size(); ++run) {
    add_line([run](const Column& column) { return column.cells[run]; });
  }
  return text;
}

}  // namespace sprung
