#pragma once
#include "core/body/kernel/springs.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// Which end of a spring is one further along x than the other.
enum class Shift { kNone, kTo, kFrom };

/// The rows of a spring's two ends.
template <Shift kShift>
struct Ends {
  Row from;
  Row to;

  [[nodiscard]] [[gnu::always_inline]] Ends seen_from(int x) const { return {from.seen_from(x), to.seen_from(x)}; }
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

/// Stretch and inverse length of a run of edges, kept in the row they begin in.
template <bool kDamped, int kAxis>
void measure_edges(const Kind& kind, const EdgeEnds<kAxis>& edges, const Run& run) {
  for (int place = 0; place < run.count; place += kLanes) {
    const EdgeEnds<kAxis> ends = edges.seen_from(run.x + place);
    const Pack3 d = ends.between(kPosition);
    const Pack q = dot(d, d) * kind.per_rest_squared;
    const Pack inverse = inverse_root(q);
    Pack stretch = q * inverse - 1.0;
    if constexpr (kDamped) stretch += kind.lag * inverse * dot(d, ends.between(kVelocity));
    store(stretch, ends.from.at(kStretch + kAxis));
    store(inverse, ends.from.at(kInverseLength + kAxis));
  }
}

/// `pack` in the first lanes, nothing in those behind `count`.
[[gnu::always_inline]] inline Pack first_lanes(const Pack& pack, int count) {
  Pack rest = pack;
  simd::where(Pack([](auto lane) { return static_cast<double>(static_cast<int>(lane)); }) >= static_cast<double>(count),
              rest) = 0.0;
  return rest;
}

/// Sums the tensions of a run of edges and pulls at their nodes. `stiffness` of a full edge spring; `shares` null where
/// edges have no springs of their own.
template <bool kEnergy, int kAxis>
void pull_edges(double stiffness, double rest_squared, const EdgeEnds<kAxis>& edges, const Run& run,
                const double* shares, Energy& energy) {
  for (int place = 0; place < run.count; place += kLanes) {
    const EdgeEnds<kAxis> ends = edges.seen_from(run.x + place);
    const Row& row = ends.from;
    Pack tension = load(row.at(kAxis == 0 ? kTensionX : (kAxis == 1 ? kTensionYLow : kTensionZLow)));
    if constexpr (kAxis != 0) tension += load(row.at(kAxis == 1 ? kTensionYHigh : kTensionZHigh, -1));
    const Pack stretch = load(row.at(kStretch + kAxis));
    if (shares != nullptr) tension += stiffness * load(shares + run.first + place) * stretch;
    if (run.count - place < kLanes) tension = first_lanes(tension, run.count - place);
    ends.pull(tension * load(row.at(kInverseLength + kAxis)) * ends.between(kPosition));
    if constexpr (kEnergy) add_energy(energy, place, 0.5 * rest_squared * tension * stretch);
  }
}

/// One diagonal of a run of faces.
template <bool kDamped, bool kEnergy, Shift kShift>
void pull_diagonals(const Kind& kind, double stiffness, const Ends<kShift>& diagonals, const Run& run,
                    const double* shares, Energy& energy) {
  for (int place = 0; place < run.count; place += kLanes) {
    const Ends<kShift> ends = diagonals.seen_from(run.x + place);
    const Pack share = stiffness * load(shares + run.first + place);
    const Pack3 d = ends.between(kPosition);
    const Answer result = answer<kDamped, kEnergy>(kind, d, [&] { return ends.between(kVelocity); });
    ends.pull(share * result.pull * d);
    if constexpr (kEnergy) {
      add_energy(energy, place, (0.5 / kind.per_rest_squared) * share * result.stretch * result.stretch);
    }
  }
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
