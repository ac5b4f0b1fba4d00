#pragma once
#include <array>
#include <cmath>

#include "core/body/kernel/pack.h"
#include "core/body/kernel/tile.h"
#include "core/body/kernel/tile_pass.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// The arrays of a plane of the scratch, for each node. Those it owns are the springs to higher nodes. What a brick
/// adds at its corners on the high side in x is kept apart, one place lower, so that no sum waits for its neighbour's.
enum PlaneArray : int {
  kForceLow = 0,       // x y z
  kTensionLow = 3,     // of edges along x, y and z, over their length at rest
  kForceHigh = 6,      // x y z; on the next node along x
  kTensionHigh = 9,    // of edges along y and z that begin at the next node along x
  kSums = 11,          // the arrays above begin at zero
  kPosition = 11,      // x y z
  kVelocity = 14,      // x y z; where there is damping
  kStretch = 17,       // of edges along x, y and z, over their length at rest; beta times its rate included
  kInverseLength = 20  // of edges along x, y and z, times their length at rest
};
static_assert(kInverseLength + 3 == kPlaneArrays);

/// A plane of nodes as seen from a place in it.
struct Place {
  double* values;

  /// The compiler is kept from knowing where that is: it would keep a hundred addresses at hand instead of one and the
  /// distances from it.
  [[nodiscard]] [[gnu::always_inline]] Place seen_from(int place) const {
    double* there = values + place;
    asm("" : "+r"(there));
    return {there};
  }
  [[nodiscard]] [[gnu::always_inline]] double* at(int array, int place = 0) const {
    return values + array * kArraySize + place;
  }
  [[nodiscard]] [[gnu::always_inline]] Pack3 three(int array, int place = 0) const {
    return {load(at(array, place)), load(at(array + 1, place)), load(at(array + 2, place))};
  }
  [[gnu::always_inline]] void set_three(int array, const Pack3& pack) const {
    store(pack.x, at(array));
    store(pack.y, at(array + 1));
    store(pack.z, at(array + 2));
  }
};

using Energy = EnergyLanes;
[[gnu::always_inline]] inline void add_energy(Energy& sums, int place, const Pack& energy) {
  add(energy, sums.data() + place % kPackPadding);
}

/// All springs of one length at rest.
struct Kind {
  double rest;      // m
  double per_rest;  // 1/m
  double shortest;  // m^2, added to squared lengths: none is zero, and what is no number stays none
  double lag;       // beta / rest, s/m

  Kind(double rest_squared, double beta)
      : rest(std::sqrt(rest_squared)), per_rest(1 / rest), shortest(kShortest * rest_squared), lag(beta * per_rest) {}

  static constexpr double kShortest = 1e-20;
};

/// What of the springs is asked for.
enum class Part { kElastic, kElasticAndDamping, kDamping, kEnergy };

constexpr bool is_damped(Part part) { return part == Part::kElasticAndDamping || part == Part::kDamping; }

/// What a spring without coupling makes of its ends: tension / length over its stiffness, (L - rest) / L + damping. And
/// stretch / rest, for the energy.
struct Answer {
  Pack pull;
  Pack stretch;
};

/// `rate` gives the ends' difference of velocity, where it is asked.
template <Part kPart, class Rate>
[[gnu::always_inline]] inline Answer answer(const Kind& kind, const Pack3& d, const Rate& rate) {
  const Pack squared = dot(d, d) + kind.shortest;
  const Pack inverse = inverse_root(squared);
  Answer result{kPart == Part::kDamping ? Pack(0.0) : 1.0 - kind.rest * inverse, {}};
  if constexpr (kPart == Part::kEnergy) result.stretch = kind.per_rest * (squared * inverse) - 1.0;
  if constexpr (is_damped(kPart)) result.pull += (kind.lag * kind.rest) * (inverse * inverse) * dot(d, rate());
  return result;
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
