#pragma once
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/mesh/query/thickness.h"

namespace sprung {

/// Connected bricks whose solid is thinner than a brick.
struct ThinPart {
  std::vector<int> bricks;       // rows of the grid
  double thickness = 0;          // m, where it is thinnest: the median around a brick
  double across = 0;             // bricks, likewise
  Vec3 position = Vec3::Zero();  // a point of the surface there
};

/// The parts of a body that are thinner than its bricks, thinnest first. A brick counts if most of the surface in it
/// and its neighbours is less than a brick from the opposite wall, which excludes the edges of thick parts; groups of
/// fewer than four bricks are left out of larger bodies. `samples` in the grid's frame.
[[nodiscard]] std::vector<ThinPart> find_thin_parts(const BrickGrid& grid, const std::vector<WallSample>& samples);

inline constexpr double kBrickBudget = 50000;  // bricks of one body

/// A brick size and why.
struct BrickChoice {
  double size = 0;
  double thickness = 0;  // of the thinnest relevant part: 95 % of the surface is on thicker ones
  double across = 0;     // bricks across it
  enum class Reason {
    kThickness,  // two bricks across the thinnest relevant part
    kShape,      // that would be less than 12 bricks along the longest side
    kBudget      // that would be more bricks than the budget
  } reason = Reason::kThickness;
};

/// Chooses the brick size of one body from the thickness of its thinnest relevant part and a budget. `walls`: by solid;
/// `longest`: the longest side of the body. Units of the solids.
[[nodiscard]] BrickChoice choose_brick_size(const std::vector<Solid>& solids,
                                            const std::vector<std::vector<WallSample>>& walls, double longest,
                                            double budget = kBrickBudget);

}  // namespace sprung
