#pragma once
#include <array>
#include <vector>

#include "core/law/material.h"
#include "core/types.h"

namespace sprung {

/// Presses on some triangles of a body's skin, along their inward normals as they turn and grow.
struct SkinPressure {
  std::vector<int> triangles;  // rows of SoftBody::contact_triangles
  double pressure = 0;         // Pa; below 0 it pulls outward
};

/// Bricks whose shape of rest is shorter along one direction and as much wider across it that their volume stays: where
/// nothing resists, they take that shape.
struct Muscle {
  std::vector<int> bricks;
  Vec3 direction = Vec3::UnitX();  // unit, in the frame of the grid
  double contraction = 0;          // share of the length, below 1; below 0 it stretches
};

/// What acts on a body beside gravity, wind, contact and what holds it.
struct Loads {
  Points forces{};  // m x 3, per node, N; 0 rows: none
  std::vector<SkinPressure> pressures{};
  std::vector<Muscle> muscles{};

  [[nodiscard]] bool empty() const { return forces.rows() == 0 && pressures.empty() && muscles.empty(); }
};

/// Air that moves evenly. On each triangle of a skin that faces it, it presses with density drag (v . n)^2 / 2, v the
/// air's velocity seen from the triangle: drag is 1 where the air gives up what it carries through the triangle.
struct Wind {
  Vec3 velocity = Vec3::Zero();  // m/s
  double density = 1.2;          // kg/m^3
  double drag = 1;

  /// Air at rest slows what moves only where a scene asks for it by a wind.
  [[nodiscard]] bool blows() const { return !velocity.isZero(0); }
};

/// Two places in the bricks of two bodies that stay together.
struct GluedPoint {
  std::array<std::size_t, 2> bodies;  // rows of World::bodies
  std::array<int, 2> bricks;
  std::array<CornerWeights, 2> weights;  // of the bricks' corners
};

/// What a muscle pulls with along its direction and two across it. Tensions of constant size along the brick's own
/// directions have the energy V sum_i stress_i |F e_i|. Together with the springs' they are zero in the muscle's shape.
struct MuscleTension {
  Mat3 frame;   // columns: e_i, unit, in the frame of the grid
  Vec3 stress;  // Pa
};

[[nodiscard]] MuscleTension tension_of(const Muscle& muscle, const Material& material);

}  // namespace sprung
