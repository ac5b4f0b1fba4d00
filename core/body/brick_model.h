#pragma once
#include "core/body/body.h"
#include "core/bricks/fill_solid.h"
#include "core/law/brick_vector.h"

namespace sprung {

/// How the bricks of a body answer, one at a time: all that a model has to say. Models that has_tiles() are computed in
/// packs of bricks besides (forces.h, stiffness.h), which give the same numbers up to rounding. Everything is asked of
/// the brick in row `brick` of a body, with its corners at x (m).
class BrickModel {
 public:
  virtual ~BrickModel() = default;

  /// J.
  [[nodiscard]] virtual double energy(const Body& body, std::size_t brick, const BrickVector& x) const = 0;
  /// Minus its gradient, N.
  [[nodiscard]] virtual BrickVector forces(const Body& body, std::size_t brick, const BrickVector& x) const = 0;
  /// The same with the beta damping of corners that move with v, m/s.
  [[nodiscard]] virtual BrickVector damped_forces(const Body& body, std::size_t brick, const BrickVector& x,
                                                  const BrickVector& v) const;
  /// The second derivative of the energy, N/m. `definite`: without negative curvature, where the model knows by itself
  /// where that is.
  [[nodiscard]] virtual BrickMatrix hessian(const Body& body, std::size_t brick, const BrickVector& x,
                                            bool definite) const = 0;
  /// The second derivative times u, N.
  [[nodiscard]] virtual BrickVector product(const Body& body, std::size_t brick, const BrickVector& x,
                                            const BrickVector& u) const;
  /// What beta damping sees, N/m: positive semidefinite, zero for rigid motions.
  [[nodiscard]] virtual BrickMatrix damping(const Body& body, std::size_t brick, const BrickVector& x) const = 0;
  /// The same times v.
  [[nodiscard]] virtual BrickVector damping_product(const Body& body, std::size_t brick, const BrickVector& x,
                                                    const BrickVector& v) const;
  /// The second derivative of a full brick at rest in the axes of the grid, N/m.
  [[nodiscard]] virtual BrickMatrix full_brick_hessian(const Body& body) const = 0;

  /// The deformation gradient, from the axes of the grid, where middle() is ...
  [[nodiscard]] virtual Mat3 gradient(const Body& body, std::size_t brick, const BrickVector& x) const;
  /// ... in brick lengths from the middle of the brick ...
  [[nodiscard]] virtual Vec3 middle(const Body& body, std::size_t brick) const;
  /// ... and the second Piola-Kirchhoff stress that goes with it, Pa, where Young's modulus is `young`.
  [[nodiscard]] virtual Mat3 second_stress(const Body& body, const Mat3& gradient, double young) const;
};

/// Lives as long as the program.
[[nodiscard]] const BrickModel& brick_model(Model model);

/// What solids of the model are filled with.
[[nodiscard]] BricksFor bricks_for(Model model);

/// The stiffness of a brick's material over that of the body's: of regions.
[[nodiscard]] double region_factor(const Body& body, std::size_t brick);

/// What a brick's corners have, of the values of all nodes (m x 3).
[[nodiscard]] BrickVector at_corners(const Body& body, std::size_t brick, const Points& values);

}  // namespace sprung
