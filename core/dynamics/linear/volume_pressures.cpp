#include "core/dynamics/linear/volume_pressures.h"

#include <tbb/parallel_for.h>

#include "core/body/brick_model.h"

namespace sprung {
namespace {

constexpr double kKept = 64;    // shear moduli: what A keeps of Lame's lambda, as at a ratio of 0.4923
constexpr double kShear = 2;    // shear moduli by which A resists a change of volume besides
constexpr double kWorth = 1.5;  // times kKept: from there on it saves time

}  // namespace

bool VolumePressures::help(const Body& body) {
  return body.model == Model::kCalibrated &&
         body.material.lame_lambda() > kWorth * kKept * body.material.shear_modulus();
}

VolumePressures::VolumePressures(const Body& body, const std::vector<bool>& fixed, double factor)
    : body_(body),
      rates_(body.grid.nodes.size()),
      stiffness_(body.grid.brick_count()),
      largest_forces_(stiffness_.size()),
      response_(stiffness_.size()) {
  const double shear = body.material.shear_modulus();
  const double apart = body.material.lame_lambda() - kKept * shear;
  tbb::parallel_for(std::size_t(0), rates_.size(), [&](std::size_t brick) {
    BrickVector& rates = rates_[brick];
    rates = volume_rates(body, brick);
    for (int i = 0; i < 24; ++i) {
      if (fixed[3 * std::size_t(body.grid.nodes[brick][i / 3]) + i % 3]) rates[i] = 0;
    }
    const Eigen::Index row(brick);
    const double volume = factor * region_factor(body, brick) * body.grid.fill[brick] * body.grid.brick_volume();
    stiffness_[row] = volume * apart;
    const double steepest = rates.norm();
    largest_forces_[row] = stiffness_[row] * (steepest > 0 ? steepest : 1 / body.grid.brick_size);
    response_[row] = 1 / (1 / stiffness_[row] + 1 / (volume * (kKept + kShear) * shear));
  });
}

Eigen::VectorXd VolumePressures::ratios(const Eigen::VectorXd& u) const {
  Eigen::VectorXd ratios(stiffness_.size());
  tbb::parallel_for(std::size_t(0), rates_.size(), [&](std::size_t brick) {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Index first = 3 * Eigen::Index(body_.grid.nodes[brick][corner]);
      sum += rates_[brick].segment<3>(3 * corner).dot(u.segment<3>(first));
    }
    ratios[Eigen::Index(brick)] = sum;
  });
  return ratios;
}

Eigen::VectorXd VolumePressures::forces(const Eigen::VectorXd& pressures) {
  double* at_corners = sums_.room(body_.grid);
  tbb::parallel_for(std::size_t(0), rates_.size(), [&](std::size_t brick) {
    Eigen::Map<BrickVector>(at_corners + 24 * brick) = pressures[Eigen::Index(brick)] * rates_[brick];
  });
  Eigen::VectorXd forces(3 * body_.node_count());
  sums_.sum(forces.data());
  return forces;
}

}  // namespace sprung
