#pragma once
#include "core/body/brick_topology.h"
#include "core/body/kernel/springs.h"

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

struct BrickSprings {
  BrickLaw law;
  Kind face;
  Kind inner;
  Kind axis;             // four mean axes together
  double per_volume;     // 1 / h^3
  double size_squared;   // h^2
  double axial_cross;    // over 16: mean and bending stretches and their shares are sums of four here
  double axial_rest;     // (self - cross) / 16
  double bending_self;   // over 16
  double bending_cross;  // over 16

  BrickSprings(const BrickLaw& brick_law, double h, double beta)
      : law(brick_law),
        face(2 * h * h, beta),
        inner(3 * h * h, beta),
        axis(16 * h * h, beta),
        per_volume(1 / (h * h * h)),
        size_squared(h * h),
        axial_cross(law.axial_cross / 16),
        axial_rest((law.axial_self - law.axial_cross) / 16),
        bending_self(law.bending_self / 16),
        bending_cross(law.bending_cross / 16) {}
};

/// Sums and signed sums over the four edges along an axis.
struct FourEdges {
  Pack sum;
  Pack in_j;
  Pack in_k;

  [[gnu::always_inline]] explicit FourEdges(const Pack* s) {
    const Pack low = s[0] + s[1];
    const Pack high = s[2] + s[3];
    sum = low + high;
    in_k = high - low;
    in_j = (s[1] - s[0]) + (s[3] - s[2]);
  }
};

/// Tensions of a brick's twelve edges for their stretches: their own springs, and the axial and bending corrections
/// (brick_law.h), see edge_tensions() of brick_kernel.h for the numbering.
template <bool kBends>
[[gnu::always_inline]] inline std::array<Pack, 12> edge_tensions(const BrickSprings& springs,
                                                                 const std::array<Pack, 12>& stretches) {
  const FourEdges along_x(&stretches[0]);
  const FourEdges along_y(&stretches[4]);
  const FourEdges along_z(&stretches[8]);
  const Pack all = springs.axial_cross * (along_x.sum + along_y.sum + along_z.sum);
  std::array<Pack, 12> tensions;
  // Of the edges on sides (j, k) = (-, -), (+, -), (-, +), (+, +).
  const auto give = [&](std::size_t first, const FourEdges& own, const Pack& partner_j, const Pack& partner_k) {
    const Pack axial = all + springs.axial_rest * own.sum;
    const auto set = [&](std::size_t edge, const Pack& corrected) {
      tensions[edge] = springs.law.edge * stretches[edge] + corrected;
    };
    if constexpr (kBends) {
      const Pack in_j = springs.bending_self * own.in_j + springs.bending_cross * partner_j;
      const Pack in_k = springs.bending_self * own.in_k + springs.bending_cross * partner_k;
      const Pack low = axial - in_k;
      const Pack high = axial + in_k;
      set(first, low - in_j);
      set(first + 1, low + in_j);
      set(first + 2, high - in_j);
      set(first + 3, high + in_j);
    } else {
#pragma GCC unroll 12
      for (std::size_t edge = first; edge < first + 4; ++edge) set(edge, axial);
    }
  };
  give(0, along_x, along_z.in_k, along_y.in_j);
  give(4, along_y, along_x.in_k, along_z.in_j);
  give(8, along_z, along_y.in_k, along_x.in_j);
  return tensions;
}

/// Three vectors, one for each mean axis.
struct Axes {
  Pack3 x;
  Pack3 y;
  Pack3 z;
};

/// Values of a pack of bricks at their eight corners.
class Corners {
 public:
  Corners() {
#pragma GCC unroll 12
    for (Pack3& value : values_) value = {Pack(0.0), Pack(0.0), Pack(0.0)};
  }
  [[gnu::always_inline]] Corners(const BrickRows& rows, int values) {
#pragma GCC unroll 12
    for (std::size_t corner = 0; corner < 8; ++corner) {
      values_[corner] = rows[corner >> 1].three(values, static_cast<int>(corner & 1));
    }
  }

  [[nodiscard]] [[gnu::always_inline]] Pack3 between(CornerPair pair) const {
    return values_[static_cast<std::size_t>(pair.to)] - values_[static_cast<std::size_t>(pair.from)];
  }
  [[gnu::always_inline]] void pull(CornerPair pair, const Pack3& force) {
    Pack3& from = values_[static_cast<std::size_t>(pair.from)];
    Pack3& to = values_[static_cast<std::size_t>(pair.to)];
    from = from + force;
    to = to - force;
  }
  /// Four times the mean axes, by the differences along the inner diagonals.
  [[nodiscard]] [[gnu::always_inline]] Axes axes() const {
    const Pack3 d07 = between({0, 7});
    const Pack3 d16 = between({1, 6});
    const Pack3 d25 = between({2, 5});
    const Pack3 d34 = between({3, 4});
    const Pack3 low = d07 + d16;
    const Pack3 high = d25 + d34;
    return {(d07 - d16) + (d25 - d34), low - high, low + high};
  }

  /// Takes what pulls along the mean axes off all corners on the high side of each axis, adds it to those on the low.
  [[gnu::always_inline]] void pull_axes(const Axes& pulls) {
#pragma GCC unroll 12
    for (std::size_t corner = 0; corner < 8; ++corner) {
      Pack3& force = values_[corner];
      force = (corner & 1) != 0 ? force - pulls.x : force + pulls.x;
      force = (corner & 2) != 0 ? force - pulls.y : force + pulls.y;
      force = (corner & 4) != 0 ? force - pulls.z : force + pulls.z;
    }
  }

  /// To the sums at the nodes.
  [[gnu::always_inline]] void add_to(const BrickRows& rows) const {
#pragma GCC unroll 12
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const int array = (corner & 1) == 0 ? kForceLow : kForceHigh;
      const Place row = rows[corner >> 1];
      row.set_three(array, row.three(array) + values_[corner]);
    }
  }

 private:
  std::array<Pack3, 8> values_;
};

/// What a pack of bricks pulls at its corners.
template <bool kFaces, bool kInner, bool kBends, bool kAxes, bool kDamped, bool kEnergy>
class PackForces {
 public:
  [[gnu::always_inline]] PackForces(const BrickSprings& springs, const BrickRows& rows, const Pack& share, int place,
                                    Energy& energy)
      : springs_(springs), rows_(rows), share_(share), place_(place), energy_(energy), positions_(rows, kPosition) {}

  /// Stiffnesses of the low faces in N/m.
  [[gnu::always_inline]] void pull(const Pack& xy, const Pack& zx, const Pack& yz) {
    pull_edges();
    if constexpr (kInner) {
      const Pack inner = springs_.law.inner * share_;
#pragma GCC unroll 12
      for (const CornerPair pair : kInnerDiagonals) pull_one(springs_.inner, pair, inner);
    }
    if constexpr (kFaces) {
      pull_one(springs_.face, {0, 3}, xy);
      pull_one(springs_.face, {1, 2}, xy);
      pull_one(springs_.face, {0, 5}, zx);
      pull_one(springs_.face, {1, 4}, zx);
      pull_one(springs_.face, {0, 6}, yz);
      pull_one(springs_.face, {2, 4}, yz);
    }
    const Axes axes = positions_.axes();
    if constexpr (kAxes) pull_mean_axes(axes);
    guard(axes);
    forces_.add_to(rows_);
  }

 private:
  [[nodiscard]] [[gnu::always_inline]] std::array<Pack, 12> at_edges(int values) const {
    std::array<Pack, 12> packs;
#pragma GCC unroll 12
    for (std::size_t edge = 0; edge < 12; ++edge) {
      const auto from = static_cast<std::size_t>(kEdges[edge].from);
      packs[edge] = load(rows_[from >> 1].at(values + static_cast<int>(edge / 4), static_cast<int>(from & 1)));
    }
    return packs;
  }

  [[gnu::always_inline]] void pull_edges() {
    const std::array<Pack, 12> stretches = at_edges(kStretch);
    const std::array<Pack, 12> tensions = edge_tensions<kBends>(springs_, stretches);
    const std::array<Pack, 12> inverses = at_edges(kInverseLength);
#pragma GCC unroll 12
    for (std::size_t edge = 0; edge < 12; ++edge) {
      const Pack tension = share_ * tensions[edge];
      forces_.pull(kEdges[edge], (tension * inverses[edge]) * positions_.between(kEdges[edge]));
      if constexpr (kEnergy) add_energy(energy_, place_, 0.5 * springs_.size_squared * tension * stretches[edge]);
    }
  }

  [[nodiscard]] [[gnu::always_inline]] Pack3 rates_between(CornerPair pair) const {
    const auto at = [&](int corner) {
      return rows_[static_cast<std::size_t>(corner) >> 1].three(kVelocity, corner & 1);
    };
    return at(pair.to) - at(pair.from);
  }

  [[gnu::always_inline]] void pull_one(const Kind& kind, CornerPair pair, const Pack& stiffness) {
    const Pack3 d = positions_.between(pair);
    const Answer result = answer<kDamped, kEnergy>(kind, d, [&] { return rates_between(pair); });
    forces_.pull(pair, stiffness * result.pull * d);
    if constexpr (kEnergy) {
      add_energy(energy_, place_, (0.5 * kind.rest * kind.rest) * stiffness * result.stretch * result.stretch);
    }
  }

  /// The law's own spring of the three mean axes together.
  [[gnu::always_inline]] void pull_mean_axes(const Axes& axes) {
    const Kind& kind = springs_.axis;
    Pack stretch(-3.0);
    // 1 / length, and what it adds to the stretch.
    const auto measure = [&](const Pack3& axis) {
      const Pack squared = dot(axis, axis) + kind.shortest;
      const Pack inverse = inverse_root(squared);
      stretch += kind.per_rest * (squared * inverse);
      return inverse;
    };
    const Pack x = measure(axes.x);
    const Pack y = measure(axes.y);
    const Pack z = measure(axes.z);
    if constexpr (kDamped) {
      const Axes rates = Corners(rows_, kVelocity).axes();
      stretch += kind.lag * (x * dot(axes.x, rates.x) + y * dot(axes.y, rates.y) + z * dot(axes.z, rates.z));
    }
    const Pack tension = share_ * springs_.law.axes * stretch;
    if constexpr (kEnergy) add_energy(energy_, place_, 0.5 * springs_.size_squared * tension * stretch);
    // A quarter for each edge of an axis, and a quarter for the axes being four together.
    const Pack quarter = (0.0625 * kind.rest) * tension;
    forces_.pull_axes({quarter * x * axes.x, quarter * y * axes.y, quarter * z * axes.z});
  }

  /// The guard of brick_kernel.h. Where no brick of the pack is squeezed that far, it ends with the one comparison.
  [[gnu::always_inline]] void guard(const Axes& axes) {
    const Pack3 area_x = cross(axes.y, axes.z);
    const Pack strength = share_ * springs_.law.guard;
    const Pack active =
        simd::max(springs_.law.guard_ratio - dot(axes.x, area_x) * (springs_.per_volume / 64), Pack(0.0));
    if (simd::none_of(strength * active > 0.0)) [[likely]]
      return;
    const Pack size = -0.25 / 16 * springs_.per_volume * strength * active;
    forces_.pull_axes({size * area_x, size * cross(axes.z, axes.x), size * cross(axes.x, axes.y)});
    if constexpr (kEnergy) add_energy(energy_, place_, 0.5 * strength * active * active);
  }

  const BrickSprings& springs_;
  BrickRows rows_;
  Pack share_;
  int place_;
  Energy& energy_;
  Corners positions_;
  Corners forces_;
};

/// A run of bricks.
template <bool kFaces, bool kInner, bool kBends, bool kAxes, bool kDamped, bool kEnergy>
void brick_run(const BrickSprings& springs, const BrickRows& rows, const Run& run, const double* shares,
               Energy& energy) {
  for (int i = 0; i < run.count; i += kLanes) {
    const BrickRows here = rows.seen_from(run.place + i);
    const double* own = shares + run.first + 4 * (i - i % kPackPadding) + i % kPackPadding;
    const auto face = [&](int list) {
      return kFaces ? Pack(springs.law.face * load(own + list * kPackPadding)) : Pack();
    };
    PackForces<kFaces, kInner, kBends, kAxes, kDamped, kEnergy>(springs, here, load(own), i, energy)
        .pull(face(1), face(2), face(3));
  }
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
