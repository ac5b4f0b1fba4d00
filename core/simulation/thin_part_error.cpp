#include "core/simulation/thin_part_error.h"

#include <algorithm>
#include <array>

namespace sprung {
namespace {

struct Entry {
  double across;
  double missing;
};

constexpr std::array kMissing{Entry{0.25, 0.24}, Entry{0.5, 0.19}, Entry{0.75, 0.17},          Entry{1, 0.165},
                              Entry{2, 0.13},    Entry{4, 0.065},  Entry{kResolvedWall, 0.035}};

}  // namespace

double missing_bend(double across) {
  const double inside = std::clamp(across, kMissing.front().across, kMissing.back().across);
  const auto* high = std::find_if(kMissing.begin() + 1, kMissing.end() - 1,
                                  [&](const Entry& entry) { return entry.across >= inside; });
  const Entry& low = *(high - 1);
  const double share = (inside - low.across) / (high->across - low.across);
  return low.missing + share * (high->missing - low.missing);
}

}  // namespace sprung
