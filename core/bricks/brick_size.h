#pragma once
#include <vector>

#include "core/mesh/thickness.h"

namespace sprung {

inline constexpr double kBrickBudget = 50000;  // bricks of one body

/// A brick size and why.
struct BrickChoice {
  double size = 0;
  double thickness = 0;  // of the thinnest part that counts: 95 % of the surface bounds more than that
  double across = 0;     // bricks across it
  enum class Reason {
    kThickness,  // two bricks are across the thinnest part that counts
    kShape,      // that would be less than 12 bricks along the longest side
    kBudget      // that would be more bricks than the budget
  } reason = Reason::kThickness;
};

/// Chooses the side of the bricks of one body from the thickness of its thinnest part that counts and a budget. `walls`
/// by solid; `longest` is the longest side of the body. Units of the solids.
[[nodiscard]] BrickChoice choose_brick_size(const std::vector<Solid>& solids,
                                            const std::vector<std::vector<WallSample>>& walls, double longest,
                                            double budget = kBrickBudget);

}  // namespace sprung
