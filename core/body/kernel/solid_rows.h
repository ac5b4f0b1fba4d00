#pragma once
#include <array>
#include <cmath>
#include <utility>

#include "core/body/kernel/brick_springs.h"
#include "core/body/kernel/hyperelastic_rows.h"
#include "core/body/kernel/pack.h"
#include "core/body/kernel/tile_kernel.h"
#include "core/body/kernel/tile_runs.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// The trilinear map of bricks, x(s) = 1/8 sum over n of g_n s^n with s = -1, +1 at the corners: the coefficients of 1,
/// x, y, xy, z, xz, yz and xyz, by the bits of n. The squared lengths of edges and diagonals that the law uses
/// (StrainDifferences) are products of two of these vectors, without a square root.
using TrilinearMap = std::array<Pack3, 8>;

/// `corners.three(values, corner)` are their positions, or what else there is of them.
template <class Corners>
[[nodiscard]] [[gnu::always_inline]] inline TrilinearMap trilinear_map(const Corners& corners, int values) {
  TrilinearMap in_plane;
#pragma GCC unroll 2
  for (std::size_t z = 0; z < 2; ++z) {
    const Pack3 x0 = corners.three(values, 4 * z);
    const Pack3 x1 = corners.three(values, 4 * z + 1);
    const Pack3 x2 = corners.three(values, 4 * z + 2);
    const Pack3 x3 = corners.three(values, 4 * z + 3);
    const Pack3 low_sum = x1 + x0;
    const Pack3 low_way = x1 - x0;
    const Pack3 high_sum = x3 + x2;
    const Pack3 high_way = x3 - x2;
    in_plane[4 * z] = high_sum + low_sum;
    in_plane[4 * z + 1] = high_way + low_way;
    in_plane[4 * z + 2] = high_sum - low_sum;
    in_plane[4 * z + 3] = high_way - low_way;
  }
  TrilinearMap map;
#pragma GCC unroll 4
  for (std::size_t n = 0; n < 4; ++n) {
    map[n] = in_plane[4 + n] + in_plane[n];
    map[4 + n] = in_plane[4 + n] - in_plane[n];
  }
  return map;
}

/// Adds corner forces: `pull[n]` contributes to each with the sign of s^n there.
template <class Corners>
[[gnu::always_inline]] inline void give_corners(const TrilinearMap& pull, const Corners& corners) {
#pragma GCC unroll 2
  for (std::size_t z = 0; z < 2; ++z) {
    const auto in_plane = [&](std::size_t n) __attribute__((always_inline)) {
      if (n == 0) return z == 0 ? -pull[4] : pull[4];
      return z == 0 ? pull[n] - pull[4 + n] : pull[n] + pull[4 + n];
    };
    const Pack3 all = in_plane(0);
    const Pack3 x = in_plane(1);
    const Pack3 y = in_plane(2);
    const Pack3 xy = in_plane(3);
#pragma GCC unroll 2
    for (std::size_t high_y = 0; high_y < 2; ++high_y) {
      const Pack3 both = high_y == 0 ? all - y : all + y;
      const Pack3 way = high_y == 0 ? x - xy : x + xy;
      corners.add(4 * z + 2 * high_y, both - way);
      corners.add(4 * z + 2 * high_y + 1, both + way);
    }
  }
}

/// Corners of a pack of neighbours in a tile.
struct TileCorners {
  BrickRows rows;

  [[nodiscard]] [[gnu::always_inline]] Pack3 three(int array, std::size_t corner) const {
    return rows[corner / 2].three(array, int(corner % 2));
  }
  [[gnu::always_inline]] void add(std::size_t corner, const Pack3& force) const {
    const PlaneView row = rows[corner / 2];
    const int array = corner % 2 == 0 ? kForceLow : kForceHigh;
    row.set_three(array, row.three(array) + force);
  }
};

/// Products of two vectors of the map; each difference is a sum of two of them.
inline constexpr std::array<std::pair<int, int>, 18> kProducts{{{1, 3},
                                                                {1, 5},
                                                                {2, 6},
                                                                {2, 3},
                                                                {4, 5},
                                                                {4, 6},
                                                                {2, 5},
                                                                {3, 4},
                                                                {1, 6},
                                                                {5, 7},
                                                                {3, 7},
                                                                {6, 7},
                                                                {1, 7},
                                                                {3, 5},
                                                                {2, 7},
                                                                {3, 6},
                                                                {4, 7},
                                                                {5, 6}}};

/// As StrainDifferences counts them: b_01, b_02, b_12, b_10, b_20, b_21, t_0, t_1, t_2, q_0, q_1, q_2.
inline constexpr int kGradients = 9;
inline constexpr int kDifferences = 12;
inline constexpr std::array<std::pair<int, int>, kDifferences> kSumsOfProducts{
    {{0, 9}, {1, 10}, {2, 10}, {3, 11}, {4, 11}, {5, 9}, {6, 7}, {7, 8}, {6, 8}, {12, 13}, {14, 15}, {16, 17}}};

/// The differences, one or two, that each product is in.
inline constexpr std::array<std::pair<int, int>, kProducts.size()> kAskedBy = [] {
  std::array<std::pair<int, int>, kProducts.size()> asked{};
  asked.fill({-1, -1});
  for (int i = 0; i < kDifferences; ++i) {
    for (const int product : {kSumsOfProducts[i].first, kSumsOfProducts[i].second}) {
      (asked[product].first < 0 ? asked[product].first : asked[product].second) = i;
    }
  }
  return asked;
}();

/// Dimensionless differences: h b, h t and h^2 q; their conjugate forces, J.
using Differences = std::array<Pack, kDifferences>;

/// S: 1 2, 2 0 and 0 1 of a symmetric matrix without a diagonal.
using Shear = Pack3;

/// F S.
[[nodiscard]] [[gnu::always_inline]] inline Gradient sheared(const Gradient& f, const Shear& s) {
  return {s.z * f.y + s.y * f.z, s.z * f.x + s.x * f.z, s.y * f.x + s.x * f.y};
}

/// F (I + S).
template <bool kCut>
[[nodiscard]] [[gnu::always_inline]] inline Gradient bent(const Gradient& f, const Shear& s) {
  if constexpr (!kCut) return f;
  return f + sheared(f, s);
}

/// The kernel's parameters of eight bricks. Whole ones: their stiffness in multiples of the body's full brick, by
/// material and fill. Cut ones: a negative number, then the same and the parameters of their solid, see SolidNumber.
template <bool kCut>
class SolidNumbers {
 public:
  [[gnu::always_inline]] explicit SolidNumbers(const double* own) : own_(own) {}

  [[nodiscard]] [[gnu::always_inline]] Pack operator[](int number) const { return load(own_ + number * kPackPadding); }
  [[nodiscard]] [[gnu::always_inline]] Pack share() const { return (*this)[kCut ? kSolidShare : 0]; }

 private:
  const double* own_;
};

/// A pack of solid bricks, see SolidBrick, whose names are used here.
template <Part kPart, bool kCut>
class PackOfSolids {
 public:
  [[gnu::always_inline]] PackOfSolids(const SolidLaw& law, const double* own) : law_(law), numbers_(own) {}

  template <class Corners>
  [[gnu::always_inline]] void pull(const Corners& corners, double beta) const {
    const TrilinearMap map = trilinear_map(corners, kPosition);
    const Differences z = differences(map);
    const Gradient f = secant(map);
    const Shear shear = shear_of(z);
    const Gradient gradient = bent<kCut>(f, shear);
    Differences asked = z;
    Gradient stress{};
    if constexpr (kPart != Part::kDamping) {
      stress = elastic_stress(gradient);
      if (is_fung()) {
        const Pack slope = stiffening(gradient, z).slope;
        stress = times(slope, stress);
        for (Pack& one : asked) one *= slope;
      }
    }
    if constexpr (is_damped(kPart)) {
      const TrilinearMap moves = trilinear_map(corners, kVelocity);
      const Differences change = changes(map, moves);
      Gradient rate = bent<kCut>(secant(moves), shear);
      if constexpr (kCut) rate = rate + sheared(f, shear_of(change));
      const Gradient viscous = viscous_stress(gradient, rate, beta);
      stress = kPart == Part::kDamping ? viscous : stress + viscous;
#pragma GCC unroll 12
      for (std::size_t i = 0; i < kDifferences; ++i) {
        asked[i] = kPart == Part::kDamping ? Pack(beta * change[i]) : Pack(asked[i] + beta * change[i]);
      }
    }
    const Pack share = -numbers_.share();
    stress = times(share, stress);
    Differences force = stiffness_times(share, asked);
    if constexpr (kCut) add_shear_force(f, stress, force);
    TrilinearMap pull = secant_pull(bent<kCut>(stress, shear));
    add_pull(map, force, pull);
    give_corners(pull, corners);
  }

  /// The second derivative times the displacements stored in place of velocities.
  template <class Corners>
  [[gnu::always_inline]] void multiply(const Corners& corners) const {
    give_corners(product(state(trilinear_map(corners, kPosition)), trilinear_map(corners, kVelocity)), corners);
  }

  /// The quantities that determine the second derivative.
  struct State {
    TrilinearMap map;
    Gradient f;
    Shear shear;
    Gradient gradient;
    Gradient area;
    Pack slope;      // of psi by the volume ratio
    Pack curvature;  // likewise, second
    Gradient stress;
    Differences force;
    PackStiffening by;             // of kFung: of the neo-Hookean energy over the share,
    TrilinearMap slope_of_energy;  // and that energy's derivative, times the share
  };
  [[nodiscard]] [[gnu::always_inline]] State state(const TrilinearMap& map) const {
    State at{};
    at.map = map;
    const Differences z = differences(map);
    const Pack share = numbers_.share();
    at.f = secant(map);
    at.shear = shear_of(z);
    at.gradient = bent<kCut>(at.f, at.shear);
    at.area = areas(at.gradient, at.gradient);
    if (is_neo_hookean()) {
      const OfVolume of = of_volume(law_.shear, law_.lambda, dot(at.gradient.x, at.area.x));
      at.slope = share * of.slope;
      at.curvature = share * of.curvature;
      at.stress = times(share * law_.shear, at.gradient) + times(at.slope, at.area);
    } else {
      at.stress = times(share, hyperelastic_stress(law_.psi, at.gradient));
    }
    at.force = stiffness_times(share, z);
    if constexpr (kCut) add_shear_force(at.f, at.stress, at.force);
    if (is_fung()) {
      at.by = stiffening(at.gradient, z);
      at.slope_of_energy = secant_pull(bent<kCut>(at.stress, at.shear));
      Differences force = at.force;
      add_pull(map, force, at.slope_of_energy);
    }
    return at;
  }

  /// The second derivative times a change of the map's vectors.
  [[nodiscard]] [[gnu::always_inline]] TrilinearMap product(const State& at, const TrilinearMap& moves) const {
    const Differences change = changes(at.map, moves);
    const Gradient f_change = secant(moves);
    const Shear shear_change = shear_of(change);
    Gradient gradient_change = bent<kCut>(f_change, at.shear);
    if constexpr (kCut) gradient_change = gradient_change + sheared(at.f, shear_change);
    const Pack share = numbers_.share();
    const Gradient stress_change = change_of_stress(at, gradient_change);
    Differences force_change = stiffness_times(share, change);
    Gradient on_secant = bent<kCut>(stress_change, at.shear);
    if constexpr (kCut) {
      add_shear_force(at.f, stress_change, force_change);
      add_shear_force(f_change, at.stress, force_change);
      on_secant = on_secant + sheared(at.stress, shear_change);
    }
    TrilinearMap pull = secant_pull(on_secant);
    add_pull(at.map, force_change, pull);
    Differences force = at.force;
    add_pull(moves, force, pull);
    if (is_fung()) stiffen(at, moves, share, pull);
    return pull;
  }

  template <class Corners>
  [[nodiscard]] [[gnu::always_inline]] Pack energy(const Corners& corners) const {
    const TrilinearMap map = trilinear_map(corners, kPosition);
    const Differences z = differences(map);
    const Gradient f = bent<kCut>(secant(map), shear_of(z));
    const Differences force = stiffness_times(Pack(1.0), z);
    Pack bending(0.0);
#pragma GCC unroll 12
    for (std::size_t i = 0; i < kDifferences; ++i) bending += z[i] * force[i];
    const Pack strain = is_neo_hookean() ? neo_hookean_energy(f) : hyperelastic_energy(law_.psi, f);
    const Pack all = strain + 0.5 * bending;
    return numbers_.share() * (is_fung() ? stiffening_of(per_energy(), all).energy : all);
  }

 private:
  /// F, the gradient of the map at the centroid.
  [[nodiscard]] [[gnu::always_inline]] Gradient secant(const TrilinearMap& g) const {
    const Pack quarter(0.25 * law_.per_size);
    if constexpr (!kCut) return {quarter * g[1], quarter * g[2], quarter * g[4]};
    const auto [half, whole] = halves();
    return {quarter * g[1] + half.y * g[3] + half.z * g[5] + whole.x * g[7],
            quarter * g[2] + half.x * g[3] + half.z * g[6] + whole.y * g[7],
            quarter * g[4] + half.x * g[5] + half.y * g[6] + whole.z * g[7]};
  }

  /// Its transpose: the forces of a stress P on the map.
  [[nodiscard]] [[gnu::always_inline]] TrilinearMap secant_pull(const Gradient& p) const {
    const Pack quarter(0.25 * law_.per_size);
    const Pack3 none{Pack(0.0), Pack(0.0), Pack(0.0)};
    if constexpr (!kCut) return {none, quarter * p.x, quarter * p.y, none, quarter * p.z, none, none, none};
    const auto [half, whole] = halves();
    return {none,
            quarter * p.x,
            quarter * p.y,
            half.y * p.x + half.x * p.y,
            quarter * p.z,
            half.z * p.x + half.x * p.z,
            half.z * p.y + half.y * p.z,
            whole.x * p.x + whole.y * p.y + whole.z * p.z};
  }

  /// c / (2 h); and products c_y c_z, c_z c_x, c_x c_y over h.
  [[nodiscard]] [[gnu::always_inline]] std::pair<Pack3, Pack3> halves() const {
    const Pack3 c = centroid();
    const Pack3 whole = Pack(law_.per_size) * c;
    return {Pack(0.5) * whole, {whole.y * c.z, whole.z * c.x, whole.x * c.y}};
  }
  [[nodiscard]] [[gnu::always_inline]] Pack3 centroid() const {
    return {numbers_[kSolidCentroid], numbers_[kSolidCentroid + 1], numbers_[kSolidCentroid + 2]};
  }

  [[nodiscard]] [[gnu::always_inline]] Differences differences(const TrilinearMap& g) const {
    return sums([&](int a, int b) __attribute__((always_inline)) { return dot(g[a], g[b]); });
  }
  [[nodiscard]] [[gnu::always_inline]] Differences changes(const TrilinearMap& g, const TrilinearMap& moves) const {
    return sums([&](int a, int b) __attribute__((always_inline)) { return dot(g[a], moves[b]) + dot(moves[a], g[b]); });
  }

  [[nodiscard]] [[gnu::always_inline]] double per_product(int difference) const {
    return (difference < kGradients ? 0.125 : 0.25) * law_.per_size * law_.per_size;
  }

  template <class Product>
  [[nodiscard]] [[gnu::always_inline]] Differences sums(const Product& product) const {
    std::array<Pack, kProducts.size()> products;
#pragma GCC unroll 18
    for (std::size_t i = 0; i < kProducts.size(); ++i) products[i] = product(kProducts[i].first, kProducts[i].second);
    Differences z;
#pragma GCC unroll 12
    for (int i = 0; i < kDifferences; ++i) {
      z[i] = per_product(i) * (products[kSumsOfProducts[i].first] + products[kSumsOfProducts[i].second]);
    }
    if constexpr (kCut) {
      const Pack3 c = centroid();
      z[0] += c.z * z[9];
      z[1] += c.y * z[9];
      z[2] += c.x * z[10];
      z[3] += c.z * z[10];
      z[4] += c.y * z[11];
      z[5] += c.x * z[11];
      z[6] += c.y * z[10] + c.z * z[11];
      z[7] += c.z * z[11] + c.x * z[9];
      z[8] += c.x * z[9] + c.y * z[10];
    }
    return z;
  }

  /// Its transpose, added to `pull`.
  [[gnu::always_inline]] void add_pull(const TrilinearMap& g, Differences& force, TrilinearMap& pull) const {
    if constexpr (kCut) {
      const Pack3 c = centroid();
      force[9] += c.z * force[0] + c.y * force[1] + c.x * (force[7] + force[8]);
      force[10] += c.x * force[2] + c.z * force[3] + c.y * (force[6] + force[8]);
      force[11] += c.y * force[4] + c.x * force[5] + c.z * (force[6] + force[7]);
    }
#pragma GCC unroll 12
    for (int i = 0; i < kDifferences; ++i) force[i] *= per_product(i);
#pragma GCC unroll 18
    for (std::size_t i = 0; i < kProducts.size(); ++i) {
      const auto [one, other] = kAskedBy[i];
      const Pack tension = other < 0 ? force[one] : Pack(force[one] + force[other]);
      const auto [a, b] = kProducts[i];
      pull[a] = pull[a] + tension * g[b];
      pull[b] = pull[b] + tension * g[a];
    }
  }

  /// S z.
  [[nodiscard]] [[gnu::always_inline]] Shear shear_of(const Differences& z) const {
    if constexpr (!kCut) return {};
    const auto row = [&](int first) __attribute__((always_inline)) {
      Pack sum = numbers_[first] * z[0];
#pragma GCC unroll 9
      for (int i = 1; i < kGradients; ++i) sum += numbers_[first + i] * z[i];
      return sum;
    };
    return {row(kSolidTangent), row(kSolidTangent + kGradients), row(kSolidTangent + 2 * kGradients)};
  }

  /// Its transpose, for a stress P.
  [[gnu::always_inline]] void add_shear_force(const Gradient& f, const Gradient& p, Differences& force) const {
    const std::array<Pack, 3> rows{dot(f.y, p.z) + dot(f.z, p.y), dot(f.z, p.x) + dot(f.x, p.z),
                                   dot(f.x, p.y) + dot(f.y, p.x)};
#pragma GCC unroll 3
    for (int row = 0; row < 3; ++row) {
#pragma GCC unroll 9
      for (int i = 0; i < kGradients; ++i) force[i] += numbers_[kSolidTangent + kGradients * row + i] * rows[row];
    }
  }

  [[nodiscard]] [[gnu::always_inline]] Differences stiffness_times(const Pack& share, const Differences& z) const {
    Differences force;
    const Pack scale = law_.young * share;
    if constexpr (kCut) {
#pragma GCC unroll 12
      for (Pack& one : force) one = Pack(0.0);
      int number = kSolidStiffness;
#pragma GCC unroll 9
      for (int row = 0; row < kGradients; ++row) {
#pragma GCC unroll 9
        for (int column = row; column < kGradients; ++column, ++number) {
          const Pack entry = numbers_[number];
          force[row] += entry * z[column];
          if (column != row) force[column] += entry * z[row];
        }
      }
#pragma GCC unroll 3
      for (int i = kGradients; i < kDifferences; ++i) force[i] = numbers_[kSolidWarping + i - kGradients] * z[i];
#pragma GCC unroll 12
      for (Pack& one : force) one *= scale;
    } else {
      const Pack own = law_.bending * scale;
      const Pack across = law_.across * scale;
      const Pack twist = law_.twist * scale;
      const Pack warping = law_.warping * scale;
      const auto bend = [&](int a, int b) __attribute__((always_inline)) {
        force[a] = own * z[a] + across * z[b];
        force[b] = own * z[b] + across * z[a];
      };
      bend(0, 5);
      bend(1, 2);
      bend(3, 4);
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) {
        force[6 + i] = twist * z[6 + i];
        force[9 + i] = warping * z[9 + i];
      }
    }
    return force;
  }

  /// The strain energy by itself, without the exponential of Fung, which takes in the whole brick.
  [[nodiscard]] [[gnu::always_inline]] bool is_neo_hookean() const {
    return law_.psi.kind == StrainEnergyKind::kNeoHooke || is_fung();
  }
  [[nodiscard]] [[gnu::always_inline]] bool is_fung() const { return law_.psi.kind == StrainEnergyKind::kFung; }

  /// 2 b / (G V), 1/J.
  [[nodiscard]] double per_energy() const { return 2 * law_.psi.exponent / law_.shear; }

  /// Of the neo-Hookean energy for a share of 1.
  [[nodiscard]] [[gnu::noinline]] PackStiffening stiffening(const Gradient& f, const Differences& z) const {
    const Differences force = stiffness_times(Pack(1.0), z);
    Pack bending(0.0);
    for (std::size_t i = 0; i < kDifferences; ++i) bending += z[i] * force[i];
    return stiffening_of(per_energy(), neo_hookean_energy(f) + 0.5 * bending);
  }

  /// Turns a product with the second derivative of the neo-Hookean energy into one with Fung's.
  [[gnu::noinline]] static void stiffen(const State& at, const TrilinearMap& moves, const Pack& share,
                                        TrilinearMap& pull) {
    Pack along(0.0);
    for (std::size_t n = 0; n < 8; ++n) along += dot(at.slope_of_energy[n], moves[n]);
    const Pack more = at.by.curvature * along / simd::max(share, Pack(1e-300));  // of no brick: 0
    for (std::size_t n = 0; n < 8; ++n) pull[n] = at.by.slope * pull[n] + more * at.slope_of_energy[n];
  }

  [[nodiscard]] [[gnu::always_inline]] Pack neo_hookean_energy(const Gradient& f) const {
    const Pack volume = dot(f.x, cross(f.y, f.z));
    const Pack of_volume([&](int lane) { return volume_energy(law_.shear, law_.lambda, volume[lane]); });
    return (0.5 * law_.shear) * (dot(f, f) - 3.0) + of_volume;
  }

  /// The change of the stress of a state, times the share and h^3.
  [[nodiscard]] [[gnu::always_inline]] Gradient change_of_stress(const State& at, const Gradient& by) const {
    const Pack share = numbers_.share();
    if (!is_neo_hookean()) return times(share, hyperelastic_change(law_.psi, at.gradient, by));
    const Pack volume_change = dot(at.area.x, by.x) + dot(at.area.y, by.y) + dot(at.area.z, by.z);
    return times(share * law_.shear, by) + times(at.slope, areas(at.gradient, by) + areas(by, at.gradient)) +
           times(at.curvature * volume_change, at.area);
  }

  /// P, times h^3.
  [[nodiscard]] [[gnu::always_inline]] Gradient elastic_stress(const Gradient& f) const {
    if (!is_neo_hookean()) return hyperelastic_stress(law_.psi, f);
    const Gradient area = areas(f, f);
    const Pack slope = of_volume(law_.shear, law_.lambda, dot(f.x, area.x)).slope;
    return times(law_.shear, f) + times(slope, area);
  }

  /// That of the Kelvin-Voigt solid.
  [[nodiscard]] [[gnu::always_inline]] Gradient viscous_stress(const Gradient& f, const Gradient& rate,
                                                               double beta) const {
    const Pack xx = dot(f.x, rate.x);
    const Pack yy = dot(f.y, rate.y);
    const Pack zz = dot(f.z, rate.z);
    const Pack shear(beta * law_.shear);
    const Pack yz = shear * (dot(f.y, rate.z) + dot(f.z, rate.y));
    const Pack zx = shear * (dot(f.z, rate.x) + dot(f.x, rate.z));
    const Pack xy = shear * (dot(f.x, rate.y) + dot(f.y, rate.x));
    const Pack all = (beta * law_.lambda) * (xx + yy + zz);
    return {(all + 2.0 * shear * xx) * f.x + xy * f.y + zx * f.z, xy * f.x + (all + 2.0 * shear * yy) * f.y + yz * f.z,
            zx * f.x + yz * f.y + (all + 2.0 * shear * zz) * f.z};
  }

  const SolidLaw& law_;
  SolidNumbers<kCut> numbers_;
};

/// Does what a part asks of a pack; `first`: of the lanes for the energy.
template <Part kPart, bool kCut, class Corners>
[[gnu::always_inline]] inline void act(const PackOfSolids<kPart, kCut>& bricks, const Corners& corners, double beta,
                                       int first, Energy& energy) {
  if constexpr (kPart == Part::kEnergy) {
    add_energy(energy, first, bricks.energy(corners));
  } else if constexpr (kPart == Part::kProduct) {
    bricks.multiply(corners);
  } else {
    bricks.pull(corners, beta);
  }
}

/// Bricks of a run, all whole.
template <Part kPart>
void solid_run(const SolidLaw& law, double beta, const BrickRows& rows, const RunPart& part, const TileView& tile,
               Energy& energy) {
  for (int i = part.begin; i < part.end; i += kLanes) {
    const TileCorners here{rows.seen_from(part.run.index + i)};
    const double* own = tile.shares + tile.packs[part.run.first + i / kPackPadding] + i % kPackPadding;
    act(PackOfSolids<kPart, false>(law, own), here, beta, i, energy);
  }
}

/// Corners of a pack of any bricks.
struct GatheredCorners {
  const KernelInput& input;
  const int* places;  // of the first corner's x
  double* forces;

  [[nodiscard]] [[gnu::always_inline]] Pack3 three(int array, std::size_t corner) const {
    const int* from = places + corner * kPackPadding;
    if (array == kVelocity) return gather_points(input.velocities, from);
    const Pack3 positions = gather_points(input.positions, from);
    return input.drift == 0 ? positions : positions + Pack(input.drift) * gather_points(input.velocities, from);
  }
  [[gnu::always_inline]] void add(std::size_t corner, const Pack3& force) const {
    double* to = forces + 3 * kPackPadding * corner;
    store(force.x, to);
    store(force.y, to + kPackPadding);
    store(force.z, to + 2 * kPackPadding);
  }
};

/// A pack of gathered bricks.
template <Part kPart>
void gathered_pack(const KernelInput& input, int pack, Energy& energy) {
  const GatheredView& gathered = input.gathered;
  const double* own = gathered.numbers + gathered.packs[pack];
  const int* places = gathered.corners + std::ptrdiff_t(8 * kPackPadding) * pack;
  double* forces = gathered.forces + std::ptrdiff_t(kGatheredForces) * pack;
  for (int i = 0; i < kPackPadding; i += kLanes) {
    const GatheredCorners here{input, places + i, forces + i};
    if (*own < 0) {
      act(PackOfSolids<kPart, true>(input.solid, own + i), here, input.beta, i, energy);
    } else {
      act(PackOfSolids<kPart, false>(input.solid, own + i), here, input.beta, i, energy);
    }
  }
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
