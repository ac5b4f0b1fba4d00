#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/console/console.h"

namespace sprung {

/// The runs of a sweep: what was set, and the last measurements.
struct SweepTable {
  struct Column {
    std::string name;                  // "body.material.young", "tip.displacement.y"
    std::string unit;                  // SI; empty: none
    std::vector<std::string> cells{};  // by run; numbers in that unit
  };
  std::vector<Column> columns;
  std::size_t swept = 0;  // of these: the keys that were set, after the column of the runs' names
};

/// The table of the runs that have begun; warns about the others. Throws Error(kBadInput) if the folder is not that of
/// a sweep.
[[nodiscard]] SweepTable read_sweep_table(const std::filesystem::path& folder, const Console& console);

/// A line of names with units, then a line per run.
[[nodiscard]] std::string csv_text(const SweepTable& table);

}  // namespace sprung
