#pragma once
#include "core/body/kernel/run_cursor.h"
#include "core/body/kernel/springs.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// Which end of a spring is one further along x than the other.
enum class Shift { kNone, kTo, kFrom };

/// The rows of a spring's two ends.
template <Shift kShift>
struct Ends {
  Place from;
  Place to;

  [[nodiscard]] [[gnu::always_inline]] Ends seen_from(int place) const {
    return {from.seen_from(place), to.seen_from(place)};
  }
  [[nodiscard]] [[gnu::always_inline]] Pack3 between(int array) const {
    return to.three(array, kShift == Shift::kTo ? 1 : 0) - from.three(array, kShift == Shift::kFrom ? 1 : 0);
  }
  [[gnu::always_inline]] void pull(const Pack3& force) const {
    constexpr int kFrom = kShift == Shift::kFrom ? kForceHigh : kForceLow;
    constexpr int kTo = kShift == Shift::kTo ? kForceHigh : kForceLow;
    from.set_three(kFrom, from.three(kFrom) + force);
    to.set_three(kTo, to.three(kTo) - force);
  }
};

/// Edges along an axis.
template <int kAxis>
using EdgeEnds = Ends<kAxis == 0 ? Shift::kTo : Shift::kNone>;

/// Stretch and inverse length of a pack of edges, kept where they begin.
template <Part kPart, int kAxis>
[[gnu::always_inline]] inline void measure_edges(const Kind& kind, const EdgeEnds<kAxis>& ends) {
  const Pack3 d = ends.between(kPosition);
  const Pack squared = dot(d, d) + kind.shortest;
  const Pack inverse = inverse_root(squared);
  Pack stretch = kPart == Part::kDamping ? Pack(0.0) : kind.per_rest * (squared * inverse) - 1.0;
  if constexpr (is_damped(kPart)) stretch += kind.lag * (inverse * dot(d, ends.between(kVelocity)));
  store(stretch, ends.from.at(kStretch + kAxis));
  store(kind.rest * inverse, ends.from.at(kInverseLength + kAxis));
}

/// Pulls at both ends of the edges that begin at a pack of nodes, once all bricks have added their tensions.
template <bool kUpward>
[[gnu::always_inline]] inline void pull_edges(const Place& here, const Place& next_row, const Place& above) {
  const Pack3 position = here.three(kPosition);
  const auto force = [&](int axis, const Pack3& end) {
    Pack tension = load(here.at(kTensionLow + axis));
    if (axis > 0) tension += load(here.at(kTensionHigh + axis - 1, -1));
    return (tension * load(here.at(kInverseLength + axis))) * (end - position);
  };
  const Pack3 x = force(0, here.three(kPosition, 1));
  const Pack3 y = force(1, next_row.three(kPosition));
  Pack3 own = here.three(kForceLow) + x + y;
  if constexpr (kUpward) {
    const Pack3 z = force(2, above.three(kPosition));
    own = own + z;
    above.set_three(kForceLow, above.three(kForceLow) - z);
  }
  here.set_three(kForceLow, own);
  here.set_three(kForceHigh, here.three(kForceHigh) - x);
  next_row.set_three(kForceLow, next_row.three(kForceLow) - y);
}

/// One diagonal of a run of faces.
template <Part kPart, Shift kShift>
void pull_diagonals(const Kind& kind, double stiffness, const Ends<kShift>& diagonals, const RunPart& part,
                    const double* shares, Energy& energy) {
  for (int i = part.begin; i < part.end; i += kLanes) {
    const Ends<kShift> ends = diagonals.seen_from(part.run.place + i);
    const Pack share = stiffness * load(shares + part.run.first + i);
    const Pack3 d = ends.between(kPosition);
    const Answer result = answer<kPart>(kind, d, [&] { return ends.between(kVelocity); });
    ends.pull(share * result.pull * d);
    if constexpr (kPart == Part::kEnergy) {
      add_energy(energy, i, (0.5 * kind.rest * kind.rest) * share * result.stretch * result.stretch);
    }
  }
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
