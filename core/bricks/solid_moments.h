#pragma once
#include <array>
#include <vector>

#include "core/types.h"

namespace sprung {

struct BrickGrid;

/// The distribution of the solid in a brick, in brick lengths from its middle: the mean and the covariance of its
/// points. It is uniform for a brick that is full, or of which only the fill is known.
struct SolidMoments {
  Vec3 centroid = Vec3::Zero();
  Mat3 covariance = Mat3::Identity() / 12;

  [[nodiscard]] bool is_whole() const { return centroid.isZero(0) && covariance == Mat3::Identity() / 12; }
};

/// Integrals over a part of a solid, in cells: of 1, of the position x and of x x^T.
struct SolidIntegrals {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  SolidIntegrals& operator+=(const SolidIntegrals& other);
  /// The same part translated by `by`.
  [[nodiscard]] SolidIntegrals moved(const Vec3& by) const;
  [[nodiscard]] SolidMoments moments() const;
};

[[nodiscard]] SolidIntegrals integrals_of(double volume, const SolidMoments& moments);

/// Integrals of the solid in a cell, accumulated along lines of samples in three directions. Along a line the solid
/// ends exactly at the surface; across, the line stands for the square around it.
class LineIntegrals {
 public:
  /// Adds the segment inside on a line along `axis` from `low` to `high`, at `line` on the other axes; all relative to
  /// the cell's middle. `ends`: how many of the two ends are at the surface.
  void add(int axis, const Vec3& line, double low, double high, int ends);

  /// The combined estimate for `volume` cells. A direction is weighted by how often its lines cross the surface, and
  /// most for coordinates along itself: lines along a wall do not detect its position.
  [[nodiscard]] SolidIntegrals best(double volume) const;

 private:
  struct Direction {
    SolidIntegrals integrals;
    int ends = 0;
  };
  std::array<Direction, 3> directions_;
};

/// The moments of each brick, from its patches; a cell without a patch that has a brick is solid throughout.
[[nodiscard]] std::vector<SolidMoments> solid_moments(const BrickGrid& grid);

}  // namespace sprung
