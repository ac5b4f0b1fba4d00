#include "core/law/solid/uniaxial.h"

#include <cmath>
#include <limits>

namespace sprung {

UniaxialState uniaxial_state(const StrainEnergy& psi, double stretch) {
  constexpr int kMaxDoublings = 20;
  constexpr int kMaxSteps = 200;
  const auto stress = [&](double sideways) { return psi.principal_stress(Vec3(stretch, sideways, sideways)); };
  double low = 1 / std::sqrt(stretch);
  double high = low;
  int doublings = 0;
  while (stress(low)[1] > 0 && ++doublings < kMaxDoublings) low /= 2;
  while (stress(high)[1] < 0 && ++doublings < kMaxDoublings) high *= 2;
  if (doublings == kMaxDoublings) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone};
  }
  // Regula falsi in the Illinois form: it keeps the zero between its ends.
  double low_stress = stress(low)[1];
  double high_stress = stress(high)[1];
  double at = low;
  int last = 0;  // the end that moved
  for (int step = 0; step < kMaxSteps && high_stress > low_stress; ++step) {
    const double before = at;
    at = (low * high_stress - high * low_stress) / (high_stress - low_stress);
    const double here = stress(at)[1];
    if (here == 0 || (step > 0 && std::abs(at - before) <= 1e-15 * at)) break;
    if (here < 0) {
      low = at;
      low_stress = here;
      if (last == -1) high_stress /= 2;
      last = -1;
    } else {
      high = at;
      high_stress = here;
      if (last == 1) low_stress /= 2;
      last = 1;
    }
  }
  return {at, stress(at)[0]};
}

}  // namespace sprung
