#pragma once
#include "core/body/kernel/springs.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// The four rows of nodes of a row of bricks, two on each plane: 0, +y, +z, +y+z.
struct BrickRows {
  Row low;
  Row high;

  [[nodiscard]] [[gnu::always_inline]] BrickRows seen_from(int x) const {
    return {low.seen_from(x), high.seen_from(x)};
  }
  [[nodiscard]] [[gnu::always_inline]] Row operator[](std::size_t row) const {
    return {((row & 2) == 0 ? low : high).values + ((row & 1) == 0 ? 0 : kRowSize)};
  }
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

  [[gnu::always_inline]] FourEdges(const Pack& s0, const Pack& s1, const Pack& s2, const Pack& s3) {
    const Pack low = s0 + s1;
    const Pack high = s2 + s3;
    sum = low + high;
    in_k = high - low;
    in_j = (s1 - s0) + (s3 - s2);
  }
};

/// Adds the tensions that a brick's axial and bending corrections give its edges (brick_law.h), see edge_tensions() of
/// brick_kernel.h for the numbering.
template <bool kBends>
[[gnu::always_inline]] inline void couple_edges(const BrickSprings& springs, const BrickRows& rows, const Pack& share) {
  const auto stretch = [&](std::size_t row, int axis, int shift) { return load(rows[row].at(kStretch + axis, shift)); };
  const FourEdges along_x(stretch(0, 0, 0), stretch(1, 0, 0), stretch(2, 0, 0), stretch(3, 0, 0));
  const FourEdges along_y(stretch(0, 1, 0), stretch(2, 1, 0), stretch(0, 1, 1), stretch(2, 1, 1));
  const FourEdges along_z(stretch(0, 2, 0), stretch(0, 2, 1), stretch(1, 2, 0), stretch(1, 2, 1));
  const Pack all = springs.axial_cross * (along_x.sum + along_y.sum + along_z.sum);
  // Tension of the edges on sides (j, k) = (-, -), (+, -), (-, +), (+, +).
  const auto give = [&](const FourEdges& own, const Pack& partner_j, const Pack& partner_k,
                        const std::array<double*, 4>& tensions) {
    const Pack axial = share * (all + springs.axial_rest * own.sum);
    if constexpr (kBends) {
      const Pack in_j = share * (springs.bending_self * own.in_j + springs.bending_cross * partner_j);
      const Pack in_k = share * (springs.bending_self * own.in_k + springs.bending_cross * partner_k);
      const Pack low = axial - in_k;
      const Pack high = axial + in_k;
      add(low - in_j, tensions[0]);
      add(low + in_j, tensions[1]);
      add(high - in_j, tensions[2]);
      add(high + in_j, tensions[3]);
    } else {
      for (double* tension : tensions) add(axial, tension);
    }
  };
  give(along_x, along_z.in_k, along_y.in_j,
       {rows[0].at(kTensionX), rows[1].at(kTensionX), rows[2].at(kTensionX), rows[3].at(kTensionX)});
  give(along_y, along_x.in_k, along_z.in_j,
       {rows[0].at(kTensionYLow), rows[2].at(kTensionYLow), rows[0].at(kTensionYHigh), rows[2].at(kTensionYHigh)});
  give(along_z, along_y.in_k, along_x.in_j,
       {rows[0].at(kTensionZLow), rows[0].at(kTensionZHigh), rows[1].at(kTensionZLow), rows[1].at(kTensionZHigh)});
}

/// Three vectors, one for each mean axis.
struct Axes {
  Pack3 x;
  Pack3 y;
  Pack3 z;
};

/// The corners of a pack of bricks and what pulls at them. A corner's force is at hand from open() to close().
class Corners {
 public:
  [[gnu::always_inline]] explicit Corners(const BrickRows& rows) : rows_(rows) {}

  template <std::size_t... kCorners>
  [[gnu::always_inline]] void open() {
    ((forces_[kCorners] = rows_[kCorners >> 1].three(array(kCorners))), ...);
  }
  template <std::size_t... kCorners>
  [[gnu::always_inline]] void close() const {
    (rows_[kCorners >> 1].set_three(array(kCorners), forces_[kCorners]), ...);
  }
  template <std::size_t kFrom, std::size_t kTo>
  [[nodiscard]] [[gnu::always_inline]] Pack3 between(int values) const {
    return rows_[kTo >> 1].three(values, kTo & 1) - rows_[kFrom >> 1].three(values, kFrom & 1);
  }
  template <std::size_t kFrom, std::size_t kTo>
  [[gnu::always_inline]] void pull(const Pack3& force) {
    forces_[kFrom] = forces_[kFrom] + force;
    forces_[kTo] = forces_[kTo] - force;
  }
  /// Four times the mean axes, by the differences along the inner diagonals.
  [[nodiscard]] [[gnu::always_inline]] Axes axes(int values) const {
    const Pack3 d07 = between<0, 7>(values);
    const Pack3 d16 = between<1, 6>(values);
    const Pack3 d25 = between<2, 5>(values);
    const Pack3 d34 = between<3, 4>(values);
    const Pack3 low = d07 + d16;
    const Pack3 high = d25 + d34;
    return {(d07 - d16) + (d25 - d34), low - high, low + high};
  }

  /// Takes what pulls along the mean axes off all corners on the high side of each axis, adds it to those on the low.
  void pull_axes(const Axes& pulls) const {
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const Row row = rows_[corner >> 1];
      const Pack3 before = row.three(array(corner));
      const Pack3 in_x = (corner & 1) != 0 ? before - pulls.x : before + pulls.x;
      const Pack3 in_xy = (corner & 2) != 0 ? in_x - pulls.y : in_x + pulls.y;
      row.set_three(array(corner), (corner & 4) != 0 ? in_xy - pulls.z : in_xy + pulls.z);
    }
  }

 private:
  static constexpr int array(std::size_t corner) { return (corner & 1) == 0 ? kForceLow : kForceHigh; }

  BrickRows rows_;
  std::array<Pack3, 8> forces_;
};

/// The law's own spring of the three mean axes together.
template <bool kDamped, bool kEnergy>
void pull_mean_axes(const BrickSprings& springs, const Corners& corners, const Axes& axes, const Pack& share, int place,
                    Energy& energy) {
  const auto inverse = [&](const Pack3& axis) {
    return inverse_root(Pack(dot(axis, axis) * springs.axis.per_rest_squared));
  };
  const Pack x = inverse(axes.x);
  const Pack y = inverse(axes.y);
  const Pack z = inverse(axes.z);
  const auto stretch_of = [&](const Pack3& axis, const Pack& inverse_length) {
    return Pack(dot(axis, axis) * springs.axis.per_rest_squared * inverse_length - 1.0);
  };
  Pack stretch = stretch_of(axes.x, x) + stretch_of(axes.y, y) + stretch_of(axes.z, z);
  if constexpr (kDamped) {
    const Axes rates = corners.axes(kVelocity);
    stretch += springs.axis.lag * (x * dot(axes.x, rates.x) + y * dot(axes.y, rates.y) + z * dot(axes.z, rates.z));
  }
  const Pack tension = share * springs.law.axes * stretch;
  if constexpr (kEnergy) add_energy(energy, place, 0.5 * springs.size_squared * tension * stretch);
  // A quarter for each edge of an axis, and a quarter for the axes being four together.
  const Pack quarter = 0.0625 * tension;
  corners.pull_axes({quarter * x * axes.x, quarter * y * axes.y, quarter * z * axes.z});
}

/// The guard of brick_kernel.h. Where no brick of the pack is squeezed that far, it ends with the one comparison.
template <bool kEnergy>
[[gnu::always_inline]] inline void guard(const BrickSprings& springs, const Corners& corners, const Axes& axes,
                                         const Pack& share, int place, Energy& energy) {
  const Pack3 area_x = cross(axes.y, axes.z);
  const Pack lack = springs.law.guard_ratio - dot(axes.x, area_x) * (springs.per_volume / 64);
  if (simd::none_of(lack > 0.0)) [[likely]]
    return;
  const Pack active = simd::max(lack, Pack(0.0));
  const Pack strength = share * springs.law.guard;
  const Pack size = -0.25 / 16 * springs.per_volume * strength * active;
  corners.pull_axes({size * area_x, size * cross(axes.z, axes.x), size * cross(axes.x, axes.y)});
  if constexpr (kEnergy) add_energy(energy, place, 0.5 * strength * active * active);
}

/// The springs of a pack of bricks, three low faces of each among them, in an order that holds few corners open.
template <bool kFaces, bool kInner, bool kDamped, bool kEnergy>
class PackSprings {
 public:
  [[gnu::always_inline]] PackSprings(const BrickSprings& springs, const BrickRows& rows, int place, Energy& energy)
      : springs_(springs), corners_(rows), place_(place), energy_(energy) {}

  /// Stiffnesses in N/m.
  [[gnu::always_inline]] void pull(const Pack& xy, const Pack& zx, const Pack& yz, const Pack& inner) {
    corners_.template open<0, 7>();
    pull_inner<0, 7>(inner);
    corners_.template close<7>();
    corners_.template open<3, 4>();
    pull_face<0, 3>(xy);
    pull_inner<3, 4>(inner);
    corners_.template close<3>();
    corners_.template open<2, 5>();
    pull_face<0, 5>(zx);
    pull_inner<2, 5>(inner);
    corners_.template close<5>();
    corners_.template open<1, 6>();
    pull_face<0, 6>(yz);
    corners_.template close<0>();
    pull_inner<1, 6>(inner);
    corners_.template close<6>();
    pull_face<1, 2>(xy);
    pull_face<1, 4>(zx);
    corners_.template close<1>();
    pull_face<2, 4>(yz);
    corners_.template close<2, 4>();
  }

 private:
  template <std::size_t kFrom, std::size_t kTo>
  [[gnu::always_inline]] void pull_face(const Pack& stiffness) {
    if constexpr (kFaces) pull_one<kFrom, kTo>(springs_.face, stiffness);
  }
  template <std::size_t kFrom, std::size_t kTo>
  [[gnu::always_inline]] void pull_inner(const Pack& stiffness) {
    if constexpr (kInner) pull_one<kFrom, kTo>(springs_.inner, stiffness);
  }
  template <std::size_t kFrom, std::size_t kTo>
  [[gnu::always_inline]] void pull_one(const Kind& kind, const Pack& stiffness) {
    const Pack3 d = corners_.template between<kFrom, kTo>(kPosition);
    const Answer result =
        answer<kDamped, kEnergy>(kind, d, [&] { return corners_.template between<kFrom, kTo>(kVelocity); });
    corners_.template pull<kFrom, kTo>(stiffness * result.pull * d);
    if constexpr (kEnergy) {
      add_energy(energy_, place_, (0.5 / kind.per_rest_squared) * stiffness * result.stretch * result.stretch);
    }
  }

  const BrickSprings& springs_;
  Corners corners_;
  int place_;
  Energy& energy_;
};

/// A row of bricks: their corrections, springs and guard.
template <bool kFaces, bool kInner, bool kBends, bool kAxes, bool kDamped, bool kEnergy>
void brick_run(const BrickSprings& springs, const BrickRows& rows, const Run& run, const double* shares,
               Energy& energy) {
  const int padded = (run.count + kRunPadding - 1) / kRunPadding * kRunPadding;
  for (int place = 0; place < run.count; place += kLanes) {
    const BrickRows here = rows.seen_from(run.x + place);
    const double* own = shares + run.first + place;
    const Pack share = load(own);
    couple_edges<kBends>(springs, here, share);
    const auto face = [&](int list) { return kFaces ? Pack(springs.law.face * load(own + list * padded)) : Pack(); };
    PackSprings<kFaces, kInner, kDamped, kEnergy>(springs, here, place, energy)
        .pull(face(1), face(2), face(3), springs.law.inner * share);
    const Corners corners(here);
    const Axes axes = corners.axes(kPosition);
    if constexpr (kAxes) pull_mean_axes<kDamped, kEnergy>(springs, corners, axes, share, place, energy);
    guard<kEnergy>(springs, corners, axes, share, place, energy);
  }
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
