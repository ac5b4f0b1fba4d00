#pragma once
#include <optional>
#include <vector>

#include "app/build_world.h"
#include "core/mesh/query/closest_triangle.h"

namespace sprung {

/// Finds where bodies touch the ground, obstacles and each other, by their skins alone: from a cache as well.
class Contacts {
 public:
  /// Outlived by the production.
  explicit Contacts(const Production& production);

  /// Places (n x 3, m) where a skin's vertex is nearer to another skin or to the ground than a small part of a brick,
  /// one at most in each cell of half a brick. `nodes` by actor; `time` (s) says where the obstacles are.
  [[nodiscard]] Points at(const std::vector<Points>& nodes, double time) const;

 private:
  struct Solid {
    const StageObstacle* obstacle;
    NearestTriangle surface;  // in the obstacle's frame
  };

  const Production& production_;
  std::optional<double> ground_;
  std::vector<Solid> solids_;
};

}  // namespace sprung
