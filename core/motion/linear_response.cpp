#include "core/motion/linear_response.h"

#include <algorithm>

#include "core/body/brick_hessian.h"
#include "core/motion/statics.h"

namespace sprung {
namespace {

/// K u: the forces (m x 3, N) that hold the displacements u.
Points holding_forces(const Body& body, const Points& displacements) {
  Points forces = Points::Zero(body.node_count(), 3);
  for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
    const auto& nodes = body.grid.nodes[brick];
    Eigen::Matrix<double, 24, 1> u;
    for (int c = 0; c < 8; ++c) {
      u.segment<3>(Eigen::Index{3} * c) = displacements.row(nodes[static_cast<std::size_t>(c)]).transpose();
    }
    const Eigen::Matrix<double, 24, 1> f = body_brick_hessian(body, brick) * u;
    for (int c = 0; c < 8; ++c) {
      forces.row(nodes[static_cast<std::size_t>(c)]) += f.segment<3>(Eigen::Index{3} * c).transpose();
    }
  }
  return forces;
}

}  // namespace

LinearResponse linear_response(const Body& body, const Supports& supports, const Points& loads, const Points& movements,
                               NewtonSystem& system) {
  LinearResponse response;
  response.displacements = Points::Zero(body.node_count(), 3);
  for (Eigen::Index i = 0; i < movements.size(); ++i) {
    if (supports.fixed[static_cast<std::size_t>(i)]) response.displacements.data()[i] = movements.data()[i];
  }
  if (std::find(supports.fixed.begin(), supports.fixed.end(), false) != supports.fixed.end()) {
    const Points driving = loads - holding_forces(body, response.displacements);
    const Eigen::VectorXd free = solve_linear(body, supports, driving, system);
    response.displacements += Eigen::Map<const Points>(free.data(), body.node_count(), 3);
  }
  response.reactions = holding_forces(body, response.displacements) - loads;
  for (Eigen::Index i = 0; i < movements.size(); ++i) {
    if (!supports.fixed[static_cast<std::size_t>(i)]) response.reactions.data()[i] = 0;
  }
  return response;
}

}  // namespace sprung
