#pragma once
#include "core/body/kernel/springs.h"
#include "core/law/brick_law.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// Which of its springs and corrections a law has.
struct Layout {
  bool edges = false;
  bool faces = false;
  bool inner = false;
  bool bends = false;
  bool axes = false;
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
template <Layout kLayout>
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
      tensions[edge] = kLayout.edges ? springs.law.edge * stretches[edge] + corrected : corrected;
    };
    if constexpr (kLayout.bends) {
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

/// The differences between the ends of the inner diagonals 0-7, 1-6, 2-5, 3-4 (kInnerDiagonals).
using Diagonals = std::array<Pack3, 4>;

/// Four times the mean axes.
[[gnu::always_inline]] inline Axes axes_of(const Diagonals& d) {
  const Pack3 low = d[0] + d[1];
  const Pack3 high = d[2] + d[3];
  return {(d[0] - d[1]) + (d[2] - d[3]), low - high, low + high};
}

/// What pulls along the mean axes, off all corners on the high side of each and to those on the low, as forces at the
/// low ends of the inner diagonals; at the high ends they are the opposite.
[[gnu::always_inline]] inline void add_axes(const Axes& pulls, Diagonals& forces) {
  const Pack3 both = pulls.x + pulls.y;
  const Pack3 only = pulls.y - pulls.x;
  forces[0] = forces[0] + (pulls.z + both);
  forces[1] = forces[1] + (pulls.z + only);
  forces[2] = forces[2] + (pulls.z - only);
  forces[3] = forces[3] + (pulls.z - both);
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
