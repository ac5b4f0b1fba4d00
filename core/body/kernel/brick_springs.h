#pragma once
#include <array>
#include <cmath>

#include "core/body/kernel/pack.h"
#include "core/body/kernel/tile_kernel.h"
#include "core/body/kernel/tile_runs.h"
#include "core/bricks/brick_topology.h"
#include "core/law/brick_law.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// The arrays of a scratch plane, per node. A node owns the springs to higher nodes. A brick's contributions to its
/// corners on the high side in x are stored separately, at the index one lower, so that no sum waits for its
/// neighbour's.
enum PlaneArray : int {
  kForceLow = 0,       // x y z
  kTensionLow = 3,     // of edges along x, y and z, over their length at rest
  kForceHigh = 6,      // x y z; on the next node along x
  kTensionHigh = 9,    // of edges along y and z that begin at the next node along x
  kSums = 11,          // the arrays above are zeroed first
  kPosition = 11,      // x y z
  kVelocity = 14,      // x y z; with damping
  kStretch = 17,       // of edges along x, y and z, over their length at rest; beta times its rate included
  kInverseLength = 20  // of edges along x, y and z, times their length at rest
};
static_assert(kInverseLength + 3 == kPlaneArrays);

/// A plane of nodes relative to a slot in it.
struct PlaneView {
  double* values;

  /// Hides that address from the compiler, which would otherwise keep a hundred addresses in registers instead of one
  /// and the offsets from it.
  [[nodiscard]] [[gnu::always_inline]] PlaneView seen_from(int index) const {
    double* there = values + index;
    asm("" : "+r"(there));
    return {there};
  }
  [[nodiscard]] [[gnu::always_inline]] double* at(int array, int index = 0) const {
    return values + array * kArraySize + index;
  }
  [[nodiscard]] [[gnu::always_inline]] Pack3 three(int array, int index = 0) const {
    return {load(at(array, index)), load(at(array + 1, index)), load(at(array + 2, index))};
  }
  [[gnu::always_inline]] void set_three(int array, const Pack3& pack) const {
    store(pack.x, at(array));
    store(pack.y, at(array + 1));
    store(pack.z, at(array + 2));
  }
};

using Energy = EnergyLanes;
[[gnu::always_inline]] inline void add_energy(Energy& sums, int index, const Pack& energy) {
  add(energy, sums.data() + index % kPackPadding);
}

/// All springs of one length at rest.
struct SpringType {
  double rest;      // m
  double per_rest;  // 1/m
  double shortest;  // m^2, added to squared lengths: none is zero, and NaN stays NaN
  double lag;       // beta / rest, s/m

  SpringType(double rest_squared, double beta)
      : rest(std::sqrt(rest_squared)), per_rest(1 / rest), shortest(kShortest * rest_squared), lag(beta * per_rest) {}

  static constexpr double kShortest = 1e-20;
};

/// The quantity to compute from the springs.
enum class Part { kElastic, kElasticAndDamping, kDamping, kEnergy, kProduct };

constexpr bool is_damped(Part part) { return part == Part::kElasticAndDamping || part == Part::kDamping; }

constexpr bool reads_velocities(Part part) { return is_damped(part) || part == Part::kProduct; }

/// A spring's force over its stiffness and the vector between its ends, (L - rest) / L + damping, without coupling; and
/// its strain (L - rest) / rest, for the energy.
struct SpringForce {
  Pack per_length;
  Pack strain;
};

/// `rate` returns the relative velocity of the ends, if it is needed.
template <Part kPart, class Rate>
[[gnu::always_inline]] inline SpringForce spring_force(const SpringType& kind, const Pack3& d, const Rate& rate) {
  const Pack squared = dot(d, d) + kind.shortest;
  const Pack inverse = inverse_root(squared);
  SpringForce result{kPart == Part::kDamping ? Pack(0.0) : 1.0 - kind.rest * inverse, {}};
  if constexpr (kPart == Part::kEnergy) result.strain = kind.per_rest * (squared * inverse) - 1.0;
  if constexpr (is_damped(kPart)) result.per_length += (kind.lag * kind.rest) * (inverse * inverse) * dot(d, rate());
  return result;
}

/// Which end of a spring is one node further along x.
enum class Shift { kNone, kTo, kFrom };

/// The rows of a spring's two ends.
template <Shift kShift>
struct Ends {
  PlaneView from;
  PlaneView to;

  [[nodiscard]] [[gnu::always_inline]] Ends seen_from(int index) const {
    return {from.seen_from(index), to.seen_from(index)};
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

/// Stretch and inverse length of a pack of edges, stored at their first nodes.
template <Part kPart, int kAxis>
[[gnu::always_inline]] inline void measure_edges(const SpringType& kind, const EdgeEnds<kAxis>& ends) {
  const Pack3 d = ends.between(kPosition);
  const Pack squared = dot(d, d) + kind.shortest;
  const Pack inverse = inverse_root(squared);
  Pack stretch = kPart == Part::kDamping ? Pack(0.0) : kind.per_rest * (squared * inverse) - 1.0;
  if constexpr (is_damped(kPart)) stretch += kind.lag * (inverse * dot(d, ends.between(kVelocity)));
  store(stretch, ends.from.at(kStretch + kAxis));
  store(kind.rest * inverse, ends.from.at(kInverseLength + kAxis));
}

/// Applies the forces at both ends of the edges that begin at a pack of nodes, once all bricks have added their
/// tensions.
template <bool kUpward>
[[gnu::always_inline]] inline void pull_edges(const PlaneView& here, const PlaneView& next_row,
                                              const PlaneView& above) {
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
void pull_diagonals(const SpringType& kind, double stiffness, const Ends<kShift>& diagonals, const RunPart& part,
                    const double* shares, Energy& energy) {
  for (int i = part.begin; i < part.end; i += kLanes) {
    const Ends<kShift> ends = diagonals.seen_from(part.run.index + i);
    const Pack share = stiffness * load(shares + part.run.first + i);
    const Pack3 d = ends.between(kPosition);
    const SpringForce result = spring_force<kPart>(kind, d, [&] { return ends.between(kVelocity); });
    ends.pull(share * result.per_length * d);
    if constexpr (kPart == Part::kEnergy) {
      add_energy(energy, i, (0.5 * kind.rest * kind.rest) * share * result.strain * result.strain);
    }
  }
}

/// Which springs and corrections a law has; solid bricks have none of them.
struct Layout {
  bool solid = false;
  bool edges = false;
  bool faces = false;
  bool inner = false;
  bool axes = false;
};

struct BrickSprings {
  BrickLaw law;
  SpringType face;
  SpringType inner;
  SpringType axis;      // four mean axes together
  double size_squared;  // h^2
  double axial_cross;   // over 16: mean stretches and their shares are sums of four here
  double axial_rest;    // (self - cross) / 16

  BrickSprings(const BrickLaw& brick_law, double h, double beta)
      : law(brick_law),
        face(2 * h * h, beta),
        inner(3 * h * h, beta),
        axis(16 * h * h, beta),
        size_squared(h * h),
        axial_cross(law.axial_cross / 16),
        axial_rest((law.axial_self - law.axial_cross) / 16) {}
};

/// Tensions of a brick's twelve edges for their stretches: their own springs, and the axial correction (brick_law.h),
/// see edge_tensions() of brick_kernel.h for the numbering.
[[gnu::always_inline]] inline std::array<Pack, 12> edge_tensions(const BrickSprings& springs,
                                                                 const std::array<Pack, 12>& stretches) {
  const auto sum = [&](std::size_t first) {
    return (stretches[first] + stretches[first + 1]) + (stretches[first + 2] + stretches[first + 3]);
  };
  const std::array<Pack, 3> sums{sum(0), sum(4), sum(8)};
  const Pack all = springs.axial_cross * (sums[0] + sums[1] + sums[2]);
  std::array<Pack, 12> tensions;
#pragma GCC unroll 12
  for (std::size_t edge = 0; edge < 12; ++edge) {
    tensions[edge] = springs.law.edge * stretches[edge] + (all + springs.axial_rest * sums[edge / 4]);
  }
  return tensions;
}

/// Three vectors, one for each mean axis.
struct Axes {
  Pack3 x;
  Pack3 y;
  Pack3 z;
};

/// The differences between the ends of the inner diagonals 0-7, 1-6, 2-5, 3-4 (kInnerDiagonals).
using Diagonals = std::array<Pack3, 4>;

/// Four times the mean axes.
[[gnu::always_inline]] inline Axes axes_of(const Diagonals& d) {
  const Pack3 low = d[0] + d[1];
  const Pack3 high = d[2] + d[3];
  return {(d[0] - d[1]) + (d[2] - d[3]), low - high, low + high};
}

/// Forces of tensions along the mean axes, from all corners on the high side of each towards those on the low side, at
/// the low ends of the inner diagonals; those at the high ends are opposite.
[[gnu::always_inline]] inline void add_axes(const Axes& pulls, Diagonals& forces) {
  const Pack3 both = pulls.x + pulls.y;
  const Pack3 only = pulls.y - pulls.x;
  forces[0] = forces[0] + (pulls.z + both);
  forces[1] = forces[1] + (pulls.z + only);
  forces[2] = forces[2] + (pulls.z - only);
  forces[3] = forces[3] + (pulls.z - both);
}

/// The four rows of nodes of a row of bricks: 0, +y, +z, +y+z.
struct BrickRows {
  std::array<PlaneView, 4> rows;

  BrickRows(const PlaneView& low, const PlaneView& high, int pitch)
      : rows{low, {low.values + pitch}, high, {high.values + pitch}} {}

  [[nodiscard]] [[gnu::always_inline]] BrickRows seen_from(int index) const {
    BrickRows seen = *this;
    for (PlaneView& row : seen.rows) row = row.seen_from(index);
    return seen;
  }
  [[nodiscard]] [[gnu::always_inline]] PlaneView operator[](std::size_t row) const { return rows[row]; }
};

/// The forces of a pack of bricks on its corners, in an order that needs few registers: the force at a corner is added
/// to the node's sum as soon as it is complete.
template <Layout kLayout, Part kPart>
class PackForces {
 public:
  [[gnu::always_inline]] PackForces(const BrickSprings& springs, const BrickRows& rows, const Pack& share, int index,
                                    Energy& energy)
      : springs_(springs), rows_(rows), share_(share), index_(index), energy_(energy) {}

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
    const auto at = [&](int corner) { return rows_[std::size_t(corner) >> 1].three(values, corner & 1); };
    return at(pair.to) - at(pair.from);
  }

  /// Makes the compiler reload positions: registers are scarce, loads are not.
  [[gnu::always_inline]] void read_again() { rows_ = rows_.seen_from(0); }

  /// Adds to the sum at the node.
  [[gnu::always_inline]] void give(int corner) const {
    const int array = (corner & 1) == 0 ? kForceLow : kForceHigh;
    const PlaneView row = rows_[std::size_t(corner) >> 1];
    row.set_three(array, row.three(array) + forces_[corner]);
  }

  /// Adds to the sums at the edges.
  [[gnu::always_inline]] void add_tensions() const {
    std::array<Pack, 12> stretches;
#pragma GCC unroll 12
    for (std::size_t edge = 0; edge < 12; ++edge) {
      const std::size_t from = kEdges[edge].from;
      const int axis = int(edge / 4);
      stretches[edge] = load(rows_[from >> 1].at(kStretch + axis, from & 1));
    }
    const std::array<Pack, 12> tensions = edge_tensions(springs_, stretches);
#pragma GCC unroll 12
    for (std::size_t edge = 0; edge < 12; ++edge) {
      const Pack tension = share_ * tensions[edge];
      if constexpr (kPart == Part::kEnergy) {
        add_energy(energy_, index_, 0.5 * springs_.size_squared * tension * stretches[edge]);
      } else {
        const std::size_t from = kEdges[edge].from;
        const int axis = int(edge / 4);
        add(tension, rows_[from >> 1].at((from & 1) == 0 ? kTensionLow + axis : kTensionHigh + axis - 1));
      }
    }
  }

  /// Force of a spring without coupling, from its low end to its high one.
  [[nodiscard]] [[gnu::always_inline]] Pack3 force_of(const SpringType& kind, CornerPair pair, const Pack3& d,
                                                      const Pack& stiffness) const {
    const SpringForce result = spring_force<kPart>(kind, d, [&] { return between(pair, kVelocity); });
    if constexpr (kPart == Part::kEnergy) {
      add_energy(energy_, index_, (0.5 * kind.rest * kind.rest) * stiffness * result.strain * result.strain);
    }
    return (stiffness * result.per_length) * d;
  }

  [[gnu::always_inline]] void pull_face(CornerPair pair, const Pack& stiffness) {
    if constexpr (!kLayout.faces) return;
    const Pack3 force = force_of(springs_.face, pair, between(pair, kPosition), stiffness);
    Pack3& from = forces_[pair.from];
    Pack3& to = forces_[pair.to];
    from = from + force;
    to = to - force;
  }

  /// All forces that are equal and opposite at the ends of an inner diagonal: springs, mean axes.
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
#pragma GCC unroll 12
    for (std::size_t i = 0; i < 4; ++i) {
      forces_[kInnerDiagonals[i].from] = forces[i];
      forces_[kInnerDiagonals[i].to] = -forces[i];
    }
  }

  /// The law's own spring of the three mean axes together.
  [[gnu::always_inline]] void pull_mean_axes(const Axes& axes, Diagonals& forces) const {
    const SpringType& kind = springs_.axis;
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
    if constexpr (kPart == Part::kEnergy) add_energy(energy_, index_, 0.5 * springs_.size_squared * tension * stretch);
    // A quarter for each edge of an axis, and a quarter for the axes being four together.
    const Pack quarter = (0.0625 * kind.rest) * tension;
    add_axes({quarter * x * axes.x, quarter * y * axes.y, quarter * z * axes.z}, forces);
  }

  const BrickSprings& springs_;
  BrickRows rows_;
  Pack share_;
  int index_;
  Energy& energy_;
  std::array<Pack3, 8> forces_;  // at the corners
};

/// Bricks of a run.
template <Layout kLayout, Part kPart>
void brick_run(const BrickSprings& springs, const BrickRows& rows, const RunPart& part, const TileView& tile,
               Energy& energy) {
  for (int i = part.begin; i < part.end; i += kLanes) {
    const BrickRows here = rows.seen_from(part.run.index + i);
    const double* own = tile.shares + tile.packs[part.run.first + i / kPackPadding] + i % kPackPadding;
    const auto face = [&](int list) {
      return kLayout.faces ? Pack(springs.law.face * load(own + list * kPackPadding)) : Pack();
    };
    PackForces<kLayout, kPart>(springs, here, load(own), i, energy).pull(face(1), face(2), face(3));
  }
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
