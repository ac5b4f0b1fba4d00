#include "core/simulation/thin_part_error.h"

#include <algorithm>
#include <array>

namespace sprung {

double missing_bend_if_curved(double across) {
  constexpr double kSpacing = 0.25;  // bricks, from one value to the next
  constexpr std::array<double, 4> kMissing{0.24, 0.19, 0.17, 0.14};
  const double row = std::clamp(across / kSpacing - 1, 0.0, double(kMissing.size() - 1));
  const std::size_t low = std::min(static_cast<std::size_t>(row), kMissing.size() - 2);
  const double share = row - double(low);
  return (1 - share) * kMissing[low] + share * kMissing[low + 1];
}

}  // namespace sprung
