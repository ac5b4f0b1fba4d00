#pragma once
#include <array>

#include "core/body/kernel/pack.h"
#include "core/body/kernel/tile.h"
#include "core/body/kernel/tile_pass.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// The arrays of a row of the scratch, for each node along x. Those it owns are the springs to higher
/// nodes. What pulls at a brick's or edge's node on the high side in x is kept apart, one place lower, so that no sum
/// waits for its neighbour's.
enum RowArray : int {
  kForceLow = 0,   // x y z
  kForceHigh = 3,  // x y z; on node x + 1
  kTensionX = 6,   // of edges along x, over their length at rest, N/m
  kTensionYLow = 7,
  kTensionYHigh = 8,  // on the edge at x + 1
  kTensionZLow = 9,
  kTensionZHigh = 10,
  kSums = 11,          // the arrays above begin at zero
  kPosition = 11,      // x y z
  kVelocity = 14,      // x y z
  kStretch = 17,       // of edges along x, y and z, over their length at rest; beta times its rate included
  kInverseLength = 20  // of edges along x, y and z, times their length at rest
};
static_assert(kInverseLength + 3 == kRowArrays);

struct Row {
  double* values;

  /// The row as seen from a place along x. The compiler is kept from knowing where that is: it would keep a hundred
  /// addresses at hand instead of one and the distances from it.
  [[nodiscard]] [[gnu::always_inline]] Row seen_from(int x) const {
    double* place = values + x;
    asm("" : "+r"(place));
    return {place};
  }
  [[nodiscard]] [[gnu::always_inline]] double* at(int array, int x = 0) const { return values + array * kPitch + x; }
  [[nodiscard]] [[gnu::always_inline]] Pack3 three(int array, int x = 0) const {
    return {load(at(array, x)), load(at(array + 1, x)), load(at(array + 2, x))};
  }
  [[gnu::always_inline]] void set_three(int array, const Pack3& pack) const {
    store(pack.x, at(array));
    store(pack.y, at(array + 1));
    store(pack.z, at(array + 2));
  }
};

using Energy = EnergyLanes;
[[gnu::always_inline]] inline void add_energy(Energy& sums, int place, const Pack& energy) {
  add(energy, sums.data() + place % kRunPadding);
}

/// All springs of one length at rest.
struct Kind {
  double per_rest_squared;  // 1/m^2
  double lag;               // beta / rest^2

  Kind(double rest_squared, double beta) : per_rest_squared(1 / rest_squared), lag(beta / rest_squared) {}
};

/// What a spring without coupling makes of its ends: tension / length over its stiffness, (L - rest) / L + damping. And
/// stretch / rest, for the energy.
struct Answer {
  Pack pull;
  Pack stretch;
};

/// `rate` gives the ends' difference of velocity, where it is asked.
template <bool kDamped, bool kEnergy, class Rate>
[[gnu::always_inline]] inline Answer answer(const Kind& kind, const Pack3& d, const Rate& rate) {
  const Pack q = dot(d, d) * kind.per_rest_squared;
  const Pack inverse = inverse_root(q);
  Answer result{1.0 - inverse, {}};
  if constexpr (kEnergy) result.stretch = q * inverse - 1.0;
  if constexpr (kDamped) result.pull += kind.lag * (inverse * inverse) * dot(d, rate());
  return result;
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
