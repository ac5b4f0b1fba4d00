#pragma once
#include <array>
#include <vector>

#include "core/types.h"

namespace sprung {

struct BrickGrid;

/// How the solid of a brick lies in it, in brick lengths from its middle: the mean and the covariance of its points. A
/// brick that is full, or of which no more is known than its fill, is as likely solid in one place as in another.
struct SolidMoments {
  Vec3 centroid = Vec3::Zero();
  Mat3 covariance = Mat3::Identity() / 12;

  [[nodiscard]] bool is_whole() const { return centroid.isZero(0) && covariance == Mat3::Identity() / 12; }
};

/// Integrals over a part of a solid, in cells: of 1, of the place and of its products with itself.
struct SolidIntegrals {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  SolidIntegrals& operator+=(const SolidIntegrals& other);
  /// The same part with the origin moved to where it is `by` further on.
  [[nodiscard]] SolidIntegrals moved(const Vec3& by) const;
  [[nodiscard]] SolidMoments moments() const;
};

[[nodiscard]] SolidIntegrals integrals_of(double volume, const SolidMoments& moments);

/// Of solid in a cell, gathered along lines of samples of three directions. Along a line the solid begins and ends
/// where the surface is; across it stands for the square around it.
class LineIntegrals {
 public:
  /// What is inside on a line along `axis` from `low` to `high` whose place is `line` on the other axes; all from the
  /// cell's middle. `ends`: how many of the two ends are at the surface.
  void add(int axis, const Vec3& line, double low, double high, int ends);

  /// What the directions agree on, each trusted the more its lines cross the surface, and along itself above all: lines
  /// along a wall do not see where it is. Of `volume` cells.
  [[nodiscard]] SolidIntegrals best(double volume) const;

 private:
  struct Direction {
    SolidIntegrals integrals;
    int ends = 0;
  };
  std::array<Direction, 3> directions_;
};

/// Of each brick, of what its patches hold; a cell without one that has a brick is solid throughout.
[[nodiscard]] std::vector<SolidMoments> solid_moments(const BrickGrid& grid);

}  // namespace sprung
