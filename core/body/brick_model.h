#pragma once
#include "core/body/body.h"
#include "core/bricks/fill_solid.h"
#include "core/law/brick_vector.h"

namespace sprung {

/// The constitutive model of a body's bricks, evaluated one brick at a time. Models with has_tiles() are also computed
/// in packs of bricks (forces.h, stiffness.h), with the same numbers up to rounding. All functions refer to the brick
/// in row `brick` of a body, with its corners at x (m).
class BrickModel {
 public:
  virtual ~BrickModel() = default;

  /// J.
  [[nodiscard]] virtual double energy(const Body& body, std::size_t brick, const BrickVector& x) const = 0;
  /// Minus its gradient, N.
  [[nodiscard]] virtual BrickVector forces(const Body& body, std::size_t brick, const BrickVector& x) const = 0;
  /// The same with beta damping for the corner velocities v, m/s.
  [[nodiscard]] virtual BrickVector damped_forces(const Body& body, std::size_t brick, const BrickVector& x,
                                                  const BrickVector& v) const;
  /// The second derivative of the energy, N/m. `definite`: without negative curvature, if the model can remove it
  /// itself.
  [[nodiscard]] virtual BrickMatrix hessian(const Body& body, std::size_t brick, const BrickVector& x,
                                            bool definite) const = 0;
  /// The second derivative times u, N.
  [[nodiscard]] virtual BrickVector product(const Body& body, std::size_t brick, const BrickVector& x,
                                            const BrickVector& u) const;
  /// The stiffness used by beta damping, N/m: positive semidefinite, zero for rigid motions.
  [[nodiscard]] virtual BrickMatrix damping(const Body& body, std::size_t brick, const BrickVector& x) const = 0;
  /// The same times v.
  [[nodiscard]] virtual BrickVector damping_product(const Body& body, std::size_t brick, const BrickVector& x,
                                                    const BrickVector& v) const;
  /// The second derivative of a full brick at rest in the axes of the grid, N/m.
  [[nodiscard]] virtual BrickMatrix full_brick_hessian(const Body& body) const = 0;

  /// The deformation gradient, relative to the axes of the grid, at middle(), ...
  [[nodiscard]] virtual Mat3 gradient(const Body& body, std::size_t brick, const BrickVector& x) const;
  /// ... which is in brick lengths from the middle of the brick ...
  [[nodiscard]] virtual Vec3 middle(const Body& body, std::size_t brick) const;
  /// ... and the corresponding second Piola-Kirchhoff stress, Pa, for Young's modulus `young`.
  [[nodiscard]] virtual Mat3 second_stress(const Body& body, const Mat3& gradient, double young) const;
};

/// Lives as long as the program.
[[nodiscard]] const BrickModel& brick_model(Model model);

/// How solids of the model are filled with bricks.
[[nodiscard]] BricksFor bricks_for(Model model);

/// The derivatives of the determinant of a brick's deformation gradient by its corners, 1/m, at the body's current
/// positions. Model kCalibrated only.
[[nodiscard]] BrickVector volume_rates(const Body& body, std::size_t brick);

/// The ratio of a brick's material stiffness to the body's, due to regions.
[[nodiscard]] double region_factor(const Body& body, std::size_t brick);

/// The values at a brick's corners, gathered from those of all nodes (m x 3).
[[nodiscard]] BrickVector at_corners(const Body& body, std::size_t brick, const Points& values);

}  // namespace sprung
