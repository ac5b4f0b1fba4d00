#pragma once
#include <array>
#include <memory>
#include <vector>

#include "core/law/brick_law.h"
#include "core/types.h"

namespace sprung {

/// A part of a body's skin.
struct SkinPart {
  std::vector<int> triangles;  // rows of the triangles of the body's loaded_skin(), ascending
  Points weights;              // a row for each: integrals of its corners' linear shape functions over what of it
                               // belongs to the part, over its area; 1/3 each where that is all of it
};

/// A pressure on a part of a body's skin, along its current inward normals.
struct SkinPressure {
  std::shared_ptr<const SkinPart> part;
  double pressure = 0;  // Pa; negative: suction
};

/// Bricks whose rest shape is shortened along one direction and widened across it at constant volume: without
/// resistance they take that shape.
struct Muscle {
  std::vector<int> bricks;
  Vec3 direction = Vec3::UnitX();  // unit, in the frame of the grid
  double contraction = 0;          // fraction of the length, below 1; negative: extension
};

/// The loads on a body besides gravity, wind, contact and pins.
struct Loads {
  Points forces{};  // m x 3, per node, N; 0 rows: none
  std::vector<SkinPressure> pressures{};
  std::vector<Muscle> muscles{};

  [[nodiscard]] bool empty() const { return forces.rows() == 0 && pressures.empty() && muscles.empty(); }
};

/// Uniform wind. On each skin triangle that faces it, it exerts the pressure drag density (v . n)^2 / 2, v the velocity
/// of the air relative to the triangle: at drag 1 the dynamic pressure of its normal component.
struct Wind {
  Vec3 velocity = Vec3::Zero();  // m/s
  double density = 1.2;          // kg/m^3
  double drag = 1;

  /// Bodies in still air are not slowed down.
  [[nodiscard]] bool blows() const { return !velocity.isZero(0); }
};

/// Two points in the bricks of two bodies that are kept together.
struct GluedPoint {
  std::array<std::size_t, 2> bodies;  // rows of World::bodies
  std::array<int, 2> bricks;
  std::array<CornerWeights, 2> weights;  // of the bricks' corners
};

/// The tensions of a muscle along its direction and two across it. Tensions of constant magnitude along material
/// directions have the energy V sum_i stress_i |F e_i|. They balance the brick's own stresses in the muscle's rest
/// shape, which is as large as its bricks.
struct MuscleTension {
  Mat3 frame;   // columns: e_i, unit, in the frame of the grid
  Vec3 stress;  // Pa
};

[[nodiscard]] MuscleTension tension_of(const Muscle& muscle, Model model, const Material& material);

}  // namespace sprung
