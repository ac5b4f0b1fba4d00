#include "core/motion/point_forces.h"

namespace sprung {

void add_point_stiffness(const PointStiffness& point, BrickMatrix& matrix) {
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 8; ++b) {
      matrix.block<3, 3>(3 * a, 3 * b) += point.weights[a] * point.weights[b] * point.stiffness;
    }
  }
}

void add_point_product(const Body& body, const PointStiffness& point, const Eigen::VectorXd& x,
                       Eigen::VectorXd& product) {
  const auto& nodes = body.grid.nodes[static_cast<std::size_t>(point.brick)];
  Vec3 moved = Vec3::Zero();
  for (std::size_t c = 0; c < 8; ++c) moved += point.weights[static_cast<int>(c)] * x.segment<3>(3 * nodes[c]);
  const Vec3 force = point.stiffness * moved;
  for (std::size_t c = 0; c < 8; ++c) product.segment<3>(3 * nodes[c]) += point.weights[static_cast<int>(c)] * force;
}

}  // namespace sprung
