#pragma once
#include "core/body/brick_topology.h"
#include "core/body/kernel/brick_springs.h"
#include "core/body/kernel/run_cursor.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// The four rows of nodes of a row of bricks: 0, +y, +z, +y+z.
struct BrickRows {
  std::array<Place, 4> rows;

  BrickRows(const Place& low, const Place& high, int pitch)
      : rows{low, {low.values + pitch}, high, {high.values + pitch}} {}

  [[nodiscard]] [[gnu::always_inline]] BrickRows seen_from(int place) const {
    BrickRows seen = *this;
    for (Place& row : seen.rows) row = row.seen_from(place);
    return seen;
  }
  [[nodiscard]] [[gnu::always_inline]] Place operator[](std::size_t row) const { return rows[row]; }
};

/// What a pack of bricks pulls at its corners, in an order that needs few registers: the force at a corner goes to the
/// node's sum as soon as it is whole.
template <Layout kLayout, Part kPart>
class PackForces {
 public:
  [[gnu::always_inline]] PackForces(const BrickSprings& springs, const BrickRows& rows, const Pack& share, int place,
                                    Energy& energy)
      : springs_(springs), rows_(rows), share_(share), place_(place), energy_(energy) {}

  /// Stiffnesses of the low faces in N/m.
  [[gnu::always_inline]] void pull(const Pack& xy, const Pack& zx, const Pack& yz) {
    add_tensions();
    pull_inner();
    read_again();
    give(7);
    pull_face({0, 6}, yz);
    give(6);
    pull_face({0, 5}, zx);
    give(5);
    pull_face({0, 3}, xy);
    give(3);
    give(0);
    pull_face({1, 4}, zx);
    pull_face({1, 2}, xy);
    give(1);
    pull_face({2, 4}, yz);
    give(2);
    give(4);
  }

 private:
  [[nodiscard]] [[gnu::always_inline]] Pack3 between(CornerPair pair, int values) const {
    const auto at = [&](int corner) { return rows_[static_cast<std::size_t>(corner) >> 1].three(values, corner & 1); };
    return at(pair.to) - at(pair.from);
  }

  /// The compiler forgets which positions it has in registers: they are short, loads are not.
  [[gnu::always_inline]] void read_again() { rows_ = rows_.seen_from(0); }

  /// To the sum at the node.
  [[gnu::always_inline]] void give(int corner) const {
    const int array = (corner & 1) == 0 ? kForceLow : kForceHigh;
    const Place row = rows_[static_cast<std::size_t>(corner) >> 1];
    row.set_three(array, row.three(array) + forces_[static_cast<std::size_t>(corner)]);
  }

  /// To the sums at the edges.
  [[gnu::always_inline]] void add_tensions() const {
    std::array<Pack, 12> stretches;
#pragma GCC unroll 12
    for (std::size_t edge = 0; edge < 12; ++edge) {
      const auto from = static_cast<std::size_t>(kEdges[edge].from);
      const int axis = static_cast<int>(edge / 4);
      stretches[edge] = load(rows_[from >> 1].at(kStretch + axis, static_cast<int>(from & 1)));
    }
    const std::array<Pack, 12> tensions = edge_tensions<kLayout>(springs_, stretches);
#pragma GCC unroll 12
    for (std::size_t edge = 0; edge < 12; ++edge) {
      const Pack tension = share_ * tensions[edge];
      if constexpr (kPart == Part::kEnergy) {
        add_energy(energy_, place_, 0.5 * springs_.size_squared * tension * stretches[edge]);
      } else {
        const auto from = static_cast<std::size_t>(kEdges[edge].from);
        const int axis = static_cast<int>(edge / 4);
        add(tension, rows_[from >> 1].at((from & 1) == 0 ? kTensionLow + axis : kTensionHigh + axis - 1));
      }
    }
  }

  /// Force of a spring without coupling, from its low end to its high one.
  [[nodiscard]] [[gnu::always_inline]] Pack3 force_of(const Kind& kind, CornerPair pair, const Pack3& d,
                                                      const Pack& stiffness) const {
    const Answer result = answer<kPart>(kind, d, [&] { return between(pair, kVelocity); });
    if constexpr (kPart == Part::kEnergy) {
      add_energy(energy_, place_, (0.5 * kind.rest * kind.rest) * stiffness * result.stretch * result.stretch);
    }
    return (stiffness * result.pull) * d;
  }

  [[gnu::always_inline]] void pull_face(CornerPair pair, const Pack& stiffness) {
    if constexpr (!kLayout.faces) return;
    const Pack3 force = force_of(springs_.face, pair, between(pair, kPosition), stiffness);
    Pack3& from = forces_[static_cast<std::size_t>(pair.from)];
    Pack3& to = forces_[static_cast<std::size_t>(pair.to)];
    from = from + force;
    to = to - force;
  }

  /// All that pulls the same at both ends of an inner diagonal: their springs, the mean axes, the guard.
  [[gnu::always_inline]] void pull_inner() {
    const Pack stiffness = springs_.law.inner * share_;
    Diagonals d;
    Diagonals forces;
#pragma GCC unroll 12
    for (std::size_t i = 0; i < 4; ++i) {
      d[i] = between(kInnerDiagonals[i], kPosition);
      forces[i] = kLayout.inner ? force_of(springs_.inner, kInnerDiagonals[i], d[i], stiffness)
                                : Pack3{Pack(0.0), Pack(0.0), Pack(0.0)};
    }
    if constexpr (kLayout.axes) pull_mean_axes(axes_of(d), forces);
    if constexpr (kPart != Part::kDamping) guard(d, forces);
#pragma GCC unroll 12
    for (std::size_t i = 0; i < 4; ++i) {
      forces_[static_cast<std::size_t>(kInnerDiagonals[i].from)] = forces[i];
      forces_[static_cast<std::size_t>(kInnerDiagonals[i].to)] = -forces[i];
    }
  }

  /// The law's own spring of the three mean axes together.
  [[gnu::always_inline]] void pull_mean_axes(const Axes& axes, Diagonals& forces) const {
    const Kind& kind = springs_.axis;
    Pack stretch(kPart == Part::kDamping ? 0.0 : -3.0);
    // 1 / length, and what it adds to the stretch.
    const auto measure = [&](const Pack3& axis) {
      const Pack squared = dot(axis, axis) + kind.shortest;
      const Pack inverse = inverse_root(squared);
      if constexpr (kPart != Part::kDamping) stretch += kind.per_rest * (squared * inverse);
      return inverse;
    };
    const Pack x = measure(axes.x);
    const Pack y = measure(axes.y);
    const Pack z = measure(axes.z);
    if constexpr (is_damped(kPart)) {
      Diagonals rates_between;
#pragma GCC unroll 12
      for (std::size_t i = 0; i < 4; ++i) rates_between[i] = between(kInnerDiagonals[i], kVelocity);
      const Axes rates = axes_of(rates_between);
      stretch += kind.lag * (x * dot(axes.x, rates.x) + y * dot(axes.y, rates.y) + z * dot(axes.z, rates.z));
    }
    const Pack tension = share_ * springs_.law.axes * stretch;
    if constexpr (kPart == Part::kEnergy) add_energy(energy_, place_, 0.5 * springs_.size_squared * tension * stretch);
    // A quarter for each edge of an axis, and a quarter for the axes being four together.
    const Pack quarter = (0.0625 * kind.rest) * tension;
    add_axes({quarter * x * axes.x, quarter * y * axes.y, quarter * z * axes.z}, forces);
  }

  /// The guard of brick_kernel.h. Where no brick of the pack is squeezed that far, it ends with the one comparison.
  [[gnu::always_inline]] void guard(const Diagonals& d, Diagonals& forces) const {
    const Axes axes = axes_of(d);
    const Pack3 area_x = cross(axes.y, axes.z);
    const Pack strength = share_ * springs_.law.guard;
    const Pack lack = springs_.law.guard_ratio - dot(axes.x, area_x) * (springs_.per_volume / 64);
    if (simd::none_of(strength * lack > 0.0)) [[likely]]
      return;
    const Pack active = simd::max(lack, Pack(0.0));
    const Pack size = -0.25 / 16 * springs_.per_volume * strength * active;
    add_axes({size * area_x, size * cross(axes.z, axes.x), size * cross(axes.x, axes.y)}, forces);
    if constexpr (kPart == Part::kEnergy) add_energy(energy_, place_, 0.5 * strength * active * active);
  }

  const BrickSprings& springs_;
  BrickRows rows_;
  Pack share_;
  int place_;
  Energy& energy_;
  std::array<Pack3, 8> forces_;  // at the corners
};

/// Bricks of a run.
template <Layout kLayout, Part kPart>
void brick_run(const BrickSprings& springs, const BrickRows& rows, const RunPart& part, const TileView& tile,
               Energy& energy) {
  for (int i = part.begin; i < part.end; i += kLanes) {
    const BrickRows here = rows.seen_from(part.run.place + i);
    const double* own = tile.shares + tile.packs[part.run.first + i / kPackPadding] + i % kPackPadding;
    const auto face = [&](int list) {
      return kLayout.faces ? Pack(springs.law.face * load(own + list * kPackPadding)) : Pack();
    };
    PackForces<kLayout, kPart>(springs, here, load(own), i, energy).pull(face(1), face(2), face(3));
  }
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
