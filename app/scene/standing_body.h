#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/body/body.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/simulation/scene.h"
#include "core/simulation/selector.h"

namespace sprung {

/// How a body is supported.
enum class Support {
  kStands,  // its lowest 4 % are fixed
  kHangs,   // its highest 8 %
  kPins     // what its pins hold
};

/// The supported solids of a body, and their equilibria under multiples of their weight.
class StandingBody {
 public:
  /// `pins` and their `selector` matter to kPins alone. `gravity`: m/s^2, in the frame of the bricks.
  StandingBody(std::vector<BrickGrid> solids, Model model, const Material& material, Support support,
               const std::vector<Pin>& pins, const Selector& selector, const Vec3& gravity);

  /// The largest displacement of a node by the linear solution, m; none if the supports leave a solid free to move.
  [[nodiscard]] std::optional<double> linear_displacement();
  /// The largest displacement of a node, m, in the equilibrium under a multiple of the weight, if the body keeps its
  /// shape: the displacement is at most `most` (m), twice the load displaces it at most three times as much, and a
  /// single solid does not lean so far that it would topple: its centre of mass keeps 60 % of its distance to the edge
  /// of its feet.
  [[nodiscard]] std::optional<double> carried_displacement(double weight, double most);
  /// s, at rest.
  [[nodiscard]] double stable_step();

 private:
  /// N on each node of a solid, of that multiple of its weight.
  [[nodiscard]] Points load(std::size_t row, double weight) const;
  void rest();
  /// The largest displacement of a node, m, after `move(row)` has moved every solid; none if that throws Error.
  std::optional<double> displaced(const std::function<void(std::size_t)>& move);
  /// The largest displacement of a node in the equilibrium that is found from where the solids are, m; none if there is
  /// none or it is more than `most`.
  std::optional<double> displacement(double weight, double most);
  /// Along the ground, from the centre of mass to the nearest edge of the convex hull of the fixed nodes, m; negative
  /// if it is outside.
  [[nodiscard]] double margin(const Body& body, const Points& positions) const;

  std::vector<Body> solids_;
  Support support_;
  Vec3 gravity_;
  std::vector<Supports> supports_;
  std::vector<std::unique_ptr<LinearSolver>> systems_;
};

}  // namespace sprung
