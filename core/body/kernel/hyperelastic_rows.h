#pragma once
#include <array>
#include <cmath>

#include "core/body/kernel/pack.h"
#include "core/law/solid/hyperelastic_terms.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// Three columns.
struct Gradient {
  Pack3 x;
  Pack3 y;
  Pack3 z;
};

[[nodiscard]] [[gnu::always_inline]] inline Gradient operator+(const Gradient& a, const Gradient& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

[[nodiscard]] [[gnu::always_inline]] inline Gradient times(const Pack& factor, const Gradient& f) {
  return {factor * f.x, factor * f.y, factor * f.z};
}

[[nodiscard]] [[gnu::always_inline]] inline Pack dot(const Gradient& a, const Gradient& b) {
  return dot(a.x, b.x) + dot(a.y, b.y) + dot(a.z, b.z);
}

/// Cross products of pairs of three columns: the derivative of their determinant, which is linear in each.
[[nodiscard]] [[gnu::always_inline]] inline Gradient areas(const Gradient& a, const Gradient& b) {
  return {cross(a.y, b.z), cross(a.z, b.x), cross(a.x, b.y)};
}

/// Derivatives of volume_energy() by the volume ratio.
struct OfVolume {
  Pack slope;
  Pack curvature;
};
[[nodiscard]] [[gnu::always_inline]] inline OfVolume of_volume(double log_volume, double square_volume,
                                                               const Pack& volume) {
  const Pack lowest(kLowestVolume);
  const Pack per_volume = 1.0 / simd::max(volume, lowest);
  const Pack below = simd::max(1.0 - volume * (1 / kLowestVolume), Pack(0.0));
  const Pack partly = simd::min(below, Pack(1.0));
  Pack slope = -log_volume * (1.0 + below + kCollapseStiffening * partly * (below - 0.5 * partly)) * per_volume;
  Pack curvature = log_volume * (1.0 + kCollapseStiffening * partly) * per_volume * per_volume;
  const Pack u = volume - 1.0;
  if (square_volume >= 0) {
    slope += square_volume * u;
    curvature += square_volume;
  } else {
    const Pack bound = 1.0 / (1.0 + u * u);
    slope += square_volume * u * bound * bound;
    curvature += square_volume * (1.0 - 3.0 * u * u) * bound * bound * bound;
  }
  return {slope, curvature};
}

/// A symmetric matrix.
struct Symmetric {
  Pack xx, yy, zz, yz, zx, xy;
};

/// F^T F.
[[nodiscard]] [[gnu::always_inline]] inline Symmetric squared(const Gradient& f) {
  return {dot(f.x, f.x), dot(f.y, f.y), dot(f.z, f.z), dot(f.y, f.z), dot(f.z, f.x), dot(f.x, f.y)};
}

/// Its change with F.
[[nodiscard]] [[gnu::always_inline]] inline Symmetric squared_change(const Gradient& f, const Gradient& by) {
  return {2.0 * dot(f.x, by.x),
          2.0 * dot(f.y, by.y),
          2.0 * dot(f.z, by.z),
          dot(f.y, by.z) + dot(f.z, by.y),
          dot(f.z, by.x) + dot(f.x, by.z),
          dot(f.x, by.y) + dot(f.y, by.x)};
}

/// F S.
[[nodiscard]] [[gnu::always_inline]] inline Gradient product(const Gradient& f, const Symmetric& s) {
  return {s.xx * f.x + s.xy * f.y + s.zx * f.z, s.xy * f.x + s.yy * f.y + s.yz * f.z,
          s.zx * f.x + s.yz * f.y + s.zz * f.z};
}

[[nodiscard]] [[gnu::always_inline]] inline Pack trace(const Symmetric& s) { return s.xx + s.yy + s.zz; }

/// I1 I - C, the derivative of the second invariant by C = F^T F; linear in C.
[[nodiscard]] [[gnu::always_inline]] inline Symmetric of_second_invariant(const Symmetric& c) {
  return {c.yy + c.zz, c.zz + c.xx, c.xx + c.yy, -c.yz, -c.zx, -c.xy};
}

/// The derivatives of psi by I1, I2 and J that are not zero for any of the laws, see strain_energy.cpp.
struct OfInvariants {
  Pack value;  // without what depends on J alone
  Pack by_1, by_2, by_j, by_11, by_1j, by_jj;
};

template <class Function>
[[nodiscard]] [[gnu::always_inline]] inline Pack by_lane(const Function& function) {
  return Pack([&](auto lane) { return function(lane); });
}

[[nodiscard]] inline OfInvariants of_invariants(const HyperelasticTerms& terms, const Pack& i1, const Pack& i2,
                                                const Pack& j) {
  const OfVolume volume = of_volume(terms.log_volume, terms.square_volume, j);
  const Pack none(0.0);
  OfInvariants psi{none, none, none, volume.slope, none, none, volume.curvature};
  const double shear = terms.shear;
  switch (terms.kind) {
    case StrainEnergyKind::kMooneyRivlin:
      psi.value = terms.by_i1 * (i1 - 3.0) + terms.by_i2 * (i2 - 3.0);
      psi.by_1 = Pack(terms.by_i1);
      psi.by_2 = Pack(terms.by_i2);
      break;
    case StrainEnergyKind::kLinear:
      psi.value = terms.lambda / 8 * (i1 - 3.0) * (i1 - 3.0) + 0.25 * shear * (i1 * i1 - 2.0 * i2 - 2.0 * i1 + 3.0);
      psi.by_1 = 0.25 * terms.lambda * (i1 - 3.0) + 0.5 * shear * (i1 - 1.0);
      psi.by_2 = Pack(-0.5 * shear);
      psi.by_11 = Pack(0.25 * terms.lambda + 0.5 * shear);
      break;
    case StrainEnergyKind::kNeoHooke:
    case StrainEnergyKind::kFung:
    case StrainEnergyKind::kOgden:
      break;  // the first two: PackOfSolids; by stretches
  }
  return psi;
}

/// As sprung::Stiffening, for a pack of energies.
struct PackStiffening {
  Pack energy;
  Pack slope;
  Pack curvature;
};
[[nodiscard]] [[gnu::noinline]] inline PackStiffening stiffening_of(double per_energy, const Pack& plain) {
  const Pack argument = per_energy * plain;
  const Pack beyond = simd::max(argument - kLargestExponent, Pack(0.0));
  const Pack power = by_lane([&](auto lane) { return std::exp(std::min(double(argument[lane]), kLargestExponent)); });
  return {(power * (1.0 + beyond + 0.5 * beyond * beyond) - 1.0) / per_energy, power * (1.0 + beyond),
          per_energy * power};
}

/// C = Q diag(values) Q^T.
struct Eigensystem {
  std::array<Pack, 3> values;
  Gradient axes;  // the columns of Q
};

/// Uses the cyclic Jacobi method, which converges quadratically: for 3 x 3 matrices five sweeps leave nothing but
/// rounding. Source: Golub, Van Loan, "Matrix Computations", 4th ed., section 8.5.
[[nodiscard]] inline Eigensystem eigensystem(const Symmetric& c) {
  constexpr int kSweeps = 5;
  const Pack one(1.0);
  const Pack none(0.0);
  std::array<Pack, 3> d{c.xx, c.yy, c.zz};
  std::array<Pack, 3> off{c.yz, c.zx, c.xy};
  std::array<Pack3, 3> axes{Pack3{one, none, none}, Pack3{none, one, none}, Pack3{none, none, one}};
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
#pragma GCC unroll 3
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3;
      const std::size_t b = (k + 2) % 3;
      // tan of the angle, the smaller solution of t^2 + t (d_b - d_a) / off - 1 = 0.
      const Pack difference = d[b] - d[a];
      const Pack twice = 2.0 * off[k];
      Pack size = simd::sqrt(difference * difference + twice * twice);
      simd::where(difference < 0.0, size) = -size;
      Pack divisor = difference + size;
      simd::where(divisor == 0.0, divisor) = one;  // then nothing is to be done
      const Pack tangent = twice / divisor;
      const Pack cosine = 1.0 / simd::sqrt(1.0 + tangent * tangent);
      const Pack sine = tangent * cosine;
      const Pack moved = tangent * off[k];
      d[a] -= moved;
      d[b] += moved;
      off[k] = none;
      const Pack with_b = off[a];  // entry (b, k)
      const Pack with_a = off[b];  // entry (k, a)
      off[b] = cosine * with_a - sine * with_b;
      off[a] = sine * with_a + cosine * with_b;
      const Pack3 axis = axes[a];
      axes[a] = cosine * axis - sine * axes[b];
      axes[b] = sine * axis + cosine * axes[b];
    }
  }
  return {d, {axes[0], axes[1], axes[2]}};
}

/// Q diag(values) Q^T; or with a full symmetric matrix between.
[[nodiscard]] inline Symmetric turned(const Gradient& q, const Symmetric& inside) {
  const Gradient p = product(q, inside);
  const auto entry = [&](const Pack& ax, const Pack& ay, const Pack& az, const Pack& bx, const Pack& by,
                         const Pack& bz) { return ax * bx + ay * by + az * bz; };
  return {entry(p.x.x, p.y.x, p.z.x, q.x.x, q.y.x, q.z.x), entry(p.x.y, p.y.y, p.z.y, q.x.y, q.y.y, q.z.y),
          entry(p.x.z, p.y.z, p.z.z, q.x.z, q.y.z, q.z.z), entry(p.x.y, p.y.y, p.z.y, q.x.z, q.y.z, q.z.z),
          entry(p.x.z, p.y.z, p.z.z, q.x.x, q.y.x, q.z.x), entry(p.x.x, p.y.x, p.z.x, q.x.y, q.y.y, q.z.y)};
}

/// Q^T S Q.
[[nodiscard]] inline Symmetric turned_back(const Gradient& q, const Symmetric& s) {
  const auto times_vector = [&](const Pack3& v) {
    return Pack3{s.xx * v.x + s.xy * v.y + s.zx * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z,
                 s.zx * v.x + s.yz * v.y + s.zz * v.z};
  };
  const Gradient p{times_vector(q.x), times_vector(q.y), times_vector(q.z)};
  return {dot(q.x, p.x), dot(q.y, p.y), dot(q.z, p.z), dot(q.y, p.z), dot(q.z, p.x), dot(q.x, p.y)};
}

/// f of the terms of Ogden by a squared stretch, and its derivatives.
struct OfSquare {
  Pack value;
  Pack slope;
  Pack curvature;
};
[[nodiscard]] inline OfSquare of_square(const HyperelasticTerms& terms, const Pack& c) {
  const Pack least(kLowestStretch * kLowestStretch);
  const Pack at = simd::max(c, least);
  const Pack log = by_lane([&](auto lane) { return std::log(double(at[lane])); });
  OfSquare f{Pack(0.0), Pack(0.0), Pack(0.0)};
  for (const auto& [power, own_slope, own_energy] : terms.ogden) {
    if (own_slope == 0) continue;
    const Pack raised = by_lane([&, power = power](auto lane) { return std::exp(power * double(log[lane])); });
    const Pack here = own_slope * raised;
    f.slope += here;
    f.curvature += power * here / at;
    f.value += own_energy * (raised * at - 1.0);
  }
  simd::where(c < least, f.curvature) = Pack(0.0);
  f.value += f.slope * (c - at);
  return f;
}

/// The part of a solid's strain energy, stress and stress change that a law other than neo-Hooke's has in place of it:
/// StrainEnergy for a pack of deformation gradients. Not inlined: the neo-Hookean solid, which is most of them, is not
/// to pay for the others.
[[nodiscard]] [[gnu::noinline]] inline Pack hyperelastic_energy(const HyperelasticTerms& terms, const Gradient& f) {
  const Gradient area = areas(f, f);
  const Pack j = dot(f.x, area.x);
  Pack energy =
      by_lane([&](auto lane) { return volume_energy(terms.log_volume, terms.square_volume, double(j[lane])); });
  if (terms.kind == StrainEnergyKind::kOgden) {
    for (const Pack& square : eigensystem(squared(f)).values) energy += of_square(terms, square).value;
    return energy;
  }
  return energy + of_invariants(terms, dot(f, f), dot(area, area), j).value;
}

/// 2 d/dC of the terms of Ogden, C = Q diag(c) Q^T.
struct OgdenStress {
  Eigensystem of;
  std::array<OfSquare, 3> by_square;

  OgdenStress(const HyperelasticTerms& terms, const Symmetric& c) : of(eigensystem(c)) {
    for (std::size_t k = 0; k < 3; ++k) by_square[k] = of_square(terms, of.values[k]);
  }

  [[nodiscard]] Symmetric stress() const {
    const Pack none(0.0);
    return turned(of.axes,
                  {2.0 * by_square[0].slope, 2.0 * by_square[1].slope, 2.0 * by_square[2].slope, none, none, none});
  }

  /// The stress's change with C.
  [[nodiscard]] Symmetric change(const HyperelasticTerms& terms, const Symmetric& by) const {
    const auto difference = [&](std::size_t a, std::size_t b) {
      constexpr double kClose = 1e-5;
      const Pack apart = of.values[a] - of.values[b];
      const Pack sum = of.values[a] + of.values[b];
      const auto is_close = simd::abs(apart) <= kClose * sum;
      Pack divisor = apart;
      simd::where(is_close, divisor) = Pack(1.0);
      Pack quotient = (by_square[a].slope - by_square[b].slope) / divisor;
      if (simd::any_of(is_close)) simd::where(is_close, quotient) = of_square(terms, 0.5 * sum).curvature;
      return 2.0 * quotient;
    };
    const Symmetric inside = turned_back(of.axes, by);
    return turned(of.axes, {2.0 * by_square[0].curvature * inside.xx, 2.0 * by_square[1].curvature * inside.yy,
                            2.0 * by_square[2].curvature * inside.zz, difference(1, 2) * inside.yz,
                            difference(2, 0) * inside.zx, difference(0, 1) * inside.xy});
  }
};

[[nodiscard]] [[gnu::noinline]] inline Gradient hyperelastic_stress(const HyperelasticTerms& terms, const Gradient& f) {
  const Gradient area = areas(f, f);
  const Pack j = dot(f.x, area.x);
  const Symmetric c = squared(f);
  if (terms.kind == StrainEnergyKind::kOgden) {
    return product(f, OgdenStress(terms, c).stress()) +
           times(of_volume(terms.log_volume, terms.square_volume, j).slope, area);
  }
  const OfInvariants psi = of_invariants(terms, trace(c), dot(area, area), j);
  return times(2.0 * psi.by_1, f) + times(2.0 * psi.by_2, product(f, of_second_invariant(c))) + times(psi.by_j, area);
}

/// The change of the stress with F.
[[nodiscard]] [[gnu::noinline]] inline Gradient hyperelastic_change(const HyperelasticTerms& terms, const Gradient& f,
                                                                    const Gradient& by) {
  const Gradient area = areas(f, f);
  const Gradient area_change = areas(f, by) + areas(by, f);
  const Pack j = dot(f.x, area.x);
  const Pack j_change = dot(area, by);
  const Symmetric c = squared(f);
  const Symmetric c_change = squared_change(f, by);
  if (terms.kind == StrainEnergyKind::kOgden) {
    const OgdenStress ogden(terms, c);
    const OfVolume volume = of_volume(terms.log_volume, terms.square_volume, j);
    return product(by, ogden.stress()) + product(f, ogden.change(terms, c_change)) + times(volume.slope, area_change) +
           times(volume.curvature * j_change, area);
  }
  const OfInvariants psi = of_invariants(terms, trace(c), dot(area, area), j);
  const Pack i1_change = trace(c_change);
  return times(2.0 * psi.by_1, by) + times(2.0 * (psi.by_11 * i1_change + psi.by_1j * j_change), f) +
         times(2.0 * psi.by_2, product(by, of_second_invariant(c)) + product(f, of_second_invariant(c_change))) +
         times(psi.by_j, area_change) + times(psi.by_1j * i1_change + psi.by_jj * j_change, area);
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
