#include "core/motion/muscle_potential.h"

#include "core/body/brick_topology.h"

namespace sprung {

void MusclePotential::begin() {
  tensions_.clear();
  for (const Muscle& muscle : actor_.loads.muscles) tensions_.push_back(tension_of(muscle, actor_.body.material));
}

template <class Visit>
void MusclePotential::for_draws(const Visit& visit) const {
  const Body& body = actor_.body;
  const double h = body.grid.brick_size;
  for (std::size_t m = 0; m < tensions_.size(); ++m) {
    const MuscleTension& tension = tensions_[m];
    Eigen::Matrix<double, 8, 3> weights;
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 sides;
      for (int axis = 0; axis < 3; ++axis) sides[axis] = on_high_side(corner, axis) ? 1 : -1;
      weights.row(corner) = sides.transpose() * tension.frame / (4 * h);
    }
    for (const int brick : actor_.loads.muscles[m].bricks) {
      const auto b = static_cast<std::size_t>(brick);
      const double volume = body.stiffness_scale[b] * body.grid.brick_volume();
      for (int i = 0; i < 3; ++i) {
        Draw draw{
            .brick = brick, .weights = weights.col(i), .along = Vec3::Zero(), .energy = volume * tension.stress[i]};
        for (std::size_t c = 0; c < 8; ++c) {
          draw.along += draw.weights[static_cast<int>(c)] * body.positions.row(body.grid.nodes[b][c]).transpose();
        }
        visit(draw);
      }
    }
  }
}

double MusclePotential::add_forces(Points& forces) const {
  double energy = 0;
  for_draws([&](const Draw& draw) {
    const double length = draw.along.norm();
    energy += draw.energy * length;
    const Vec3 pull = draw.energy / length * draw.along;
    const auto& nodes = actor_.body.grid.nodes[static_cast<std::size_t>(draw.brick)];
    for (std::size_t c = 0; c < 8; ++c) forces.row(nodes[c]) -= draw.weights[static_cast<int>(c)] * pull.transpose();
  });
  return energy;
}

void MusclePotential::add_stiffness(bool definite, std::vector<PointStiffness>& points) const {
  for_draws([&](const Draw& draw) {
    if (definite && draw.energy < 0) return;
    const double length = draw.along.norm();
    const Vec3 way = draw.along / length;
    points.push_back({.brick = draw.brick,
                      .weights = draw.weights,
                      .stiffness = draw.energy / length * (Mat3::Identity() - way * way.transpose())});
  });
}

}  // namespace sprung
