#include "core/world/load_forces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/body/body.h"
#include "core/law/solid/strain_energy.h"
#include "core/world/loads.h"

namespace sprung {

MuscleTension tension_of(const Muscle& muscle, Model model, const Material& material) {
  const double along = 1 - muscle.contraction;
  const Vec3 shape(along, 1 / std::sqrt(along), 1 / std::sqrt(along));
  const Vec3 aside = muscle.direction.unitOrthogonal();
  MuscleTension tension;
  tension.frame << muscle.direction, aside, muscle.direction.cross(aside);
  if (model == Model::kCalibrated) {
    tension.stress = -StrainEnergy(material).stress(shape.asDiagonal()).diagonal();
  } else {
    const Vec3 strain = shape.array() - 1;  // Hooke's law
    tension.stress = -(material.lame_lambda() * strain.sum() + 2 * material.shear_modulus() * strain.array());
  }
  return tension;
}

namespace {

constexpr int kStepsBetweenLooks = 4;

/// Distributes forces at points of the skin to the nodes in which they are embedded.
void add_carried(const Body& body, const Embedding& points, const Points& at_points, Points& at_nodes) {
  for (Eigen::Index row = 0; row < at_points.rows(); ++row) {
    const Eigen::RowVector3d force = at_points.row(row);
    if (force.isZero(0)) continue;
    const auto weights = trilinear_weights(points.local.row(row));
    const auto& nodes = body.grid.nodes[points.brick[row]];
    for (int corner = 0; corner < 8; ++corner) {
      at_nodes.row(nodes[corner]) += weights[corner] * force;
    }
  }
}

/// The corners and the area vector of a triangle.
struct Facet {
  std::array<int, 3> corners;
  Eigen::RowVector3d area;  // m^2, outward
};

Facet facet_of(const Triangles& triangles, int row, const Points& positions) {
  const std::array<int, 3> at{triangles(row, 0), triangles(row, 1), triangles(row, 2)};
  const Vec3 ahead = positions.row(at[1]) - positions.row(at[0]);
  const Vec3 aside = positions.row(at[2]) - positions.row(at[0]);
  return {at, 0.5 * ahead.cross(aside).transpose()};
}

void press(const Facet& facet, const Eigen::RowVector3d& force, Points& at_points) {
  for (const int corner : facet.corners) at_points.row(corner) += force / 3;
}

/// `positions`: of the points of the loaded skin, m.
void add_pressures(const std::vector<SkinPressure>& pressures, const Triangles& triangles, const Points& positions,
                   Points& at_points) {
  for (const SkinPressure& pressure : pressures) {
    const SkinPart& part = *pressure.part;
    for (std::size_t row = 0; row < part.triangles.size(); ++row) {
      const Facet facet = facet_of(triangles, part.triangles[row], positions);
      for (int corner = 0; corner < 3; ++corner) {
        at_points.row(facet.corners[corner]) -= part.weights(row, corner) * pressure.pressure * facet.area;
      }
    }
  }
}

}  // namespace

LoadedSkin loaded_skin(const SoftBody& body) {
  if (body.contact.triangles.rows() > 0) return {body.contact.points, body.contact.triangles};
  return {body.drawn.embedding, body.drawn.skin.triangles};
}

Points pressure_forces(const SoftBody& body, const std::vector<SkinPressure>& pressures) {
  Points forces = Points::Zero(body.node_count(), 3);
  if (pressures.empty()) return forces;
  const LoadedSkin skin = loaded_skin(body);
  const Points positions = deform_points(body.grid, skin.points, body.positions);
  Points at_points = Points::Zero(positions.rows(), 3);
  add_pressures(pressures, skin.triangles, positions, at_points);
  add_carried(body, skin.points, at_points, forces);
  return forces;
}

const Points& LoadForces::forces() {
  static_cast<void>(forces_beside_muscles());
  for (const Muscle& muscle : body_.loads.muscles) add_muscle(muscle);
  return forces_;
}

const Points& LoadForces::forces_beside_muscles() {
  if (steps_to_update_ == 0) find_skin_forces();
  steps_to_update_ = (steps_to_update_ + 1) % kStepsBetweenLooks;
  forces_ = skin_forces_;
  if (body_.loads.forces.rows() > 0) forces_ += body_.loads.forces;
  return forces_;
}

void LoadForces::find_skin_forces() {
  const Body& body = body_;
  skin_forces_ = Points::Zero(body.node_count(), 3);
  if (body_.loads.pressures.empty() && !world_.wind.blows()) return;
  const LoadedSkin skin = loaded_skin(body_);
  const Points positions = deform_points(body.grid, skin.points, body.positions);
  Points at_points = Points::Zero(positions.rows(), 3);
  add_pressures(body_.loads.pressures, skin.triangles, positions, at_points);
  if (world_.wind.blows()) {
    const Points speeds = deform_points(body.grid, skin.points, body.velocities);
    for (int row = 0; row < skin.triangles.rows(); ++row) {
      const Facet facet = facet_of(skin.triangles, row, positions);
      const auto& at = facet.corners;
      const Eigen::RowVector3d seen =
          world_.wind.velocity.transpose() - (speeds.row(at[0]) + speeds.row(at[1]) + speeds.row(at[2])) / 3;
      const double flow = seen.dot(facet.area);  // m^3/s
      if (!(flow < 0)) continue;
      const double pressure = 0.5 * world_.wind.density * world_.wind.drag * flow * flow / facet.area.squaredNorm();
      press(facet, -pressure * facet.area, at_points);
    }
  }
  add_carried(body, skin.points, at_points, skin_forces_);
}

void LoadForces::add_muscle(const Muscle& muscle) {
  const Body& body = body_;
  const double h = body.grid.brick_size;
  const auto [frame, stress] = tension_of(muscle, body.model, body.material);
  for (const int brick : muscle.bricks) {
    const std::size_t row = brick;
    const auto& nodes = body.grid.nodes[row];
    const Mat3 drawn = mean_axes_of(columns_of(nodes, body.positions)) / h * frame;  // columns: F e_i
    const Vec3 tension = body.stiffness_scale[row] * stress.array() / drawn.colwise().norm().transpose().array();
    const Mat3 stress_on_faces = drawn * tension.asDiagonal() * frame.transpose();  // first Piola-Kirchhoff, Pa
    const Mat3 pull = 0.25 * h * h * stress_on_faces;                               // N, at each corner of a face
    for (int corner = 0; corner < 8; ++corner) {
      const int node = nodes[corner];
      for (int axis = 0; axis < 3; ++axis) {
        forces_.row(node) += (on_high_side(corner, axis) ? -1.0 : 1.0) * pull.col(axis).transpose();
      }
    }
  }
}

}  // namespace sprung
