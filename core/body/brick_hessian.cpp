#include "core/body/brick_hessian.h"

#include <Eigen/Eigenvalues>

#include "core/body/brick_model.h"
#include "core/types.h"

namespace sprung {
namespace {

Vec3 to_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// Adds block to the second derivative with respect to the difference x_to - x_from.
void add_block(BrickMatrix& hessian, CornerPair pair, const Mat3& block) {
  const int a = 3 * pair.from;
  const int b = 3 * pair.to;
  hessian.block<3, 3>(a, a) += block;
  hessian.block<3, 3>(b, b) += block;
  hessian.block<3, 3>(a, b) -= block;
  hessian.block<3, 3>(b, a) -= block;
}

/// The sideways stiffness of a spring under tension: tension / length (I - d d^T).
Mat3 sideways(const Vec3& direction, double tension, double length) {
  return tension / length * (Mat3::Identity() - direction * direction.transpose());
}

void add_edges(BrickMatrix& hessian, const BrickLaw& law, double h, const CornerVectors<double>& x) {
  Eigen::Matrix<double, 12, 24> stretch_by_corner = Eigen::Matrix<double, 12, 24>::Zero();
  std::array<double, 12> stretch{};
  std::array<Vec3, 12> directions;
  for (std::size_t e = 0; e < 12; ++e) {
    const auto spring = detail::measure(detail::between(x, kEdges[e]), h);
    stretch[e] = spring.stretch;
    directions[e] = to_vector(spring.direction);
    stretch_by_corner.block<1, 3>(e, 3 * kEdges[e].from) = -directions[e].transpose();
    stretch_by_corner.block<1, 3>(e, 3 * kEdges[e].to) = directions[e].transpose();
  }
  Eigen::Matrix<double, 12, 12> coupling;
  for (std::size_t e = 0; e < 12; ++e) {
    std::array<double, 12> unit{};
    unit[e] = 1;
    coupling.col(e) = Eigen::Map<const Eigen::Matrix<double, 12, 1>>(detail::edge_tensions(law, unit).data());
  }
  hessian += stretch_by_corner.transpose() * coupling * stretch_by_corner;
  const std::array<double, 12> tension = detail::edge_tensions(law, stretch);
  for (std::size_t e = 0; e < 12; ++e) {
    add_block(hessian, kEdges[e], sideways(directions[e], tension[e], h + stretch[e]));
  }
}

template <class Pairs>
void add_diagonals(BrickMatrix& hessian, const Pairs& pairs, double rest, double stiffness,
                   const CornerVectors<double>& x) {
  for (const CornerPair pair : pairs) {
    const auto spring = detail::measure(detail::between(x, pair), rest);
    const Vec3 direction = to_vector(spring.direction);
    add_block(hessian, pair,
              stiffness * direction * direction.transpose() +
                  sideways(direction, stiffness * spring.stretch, rest + spring.stretch));
  }
}

/// Adds the correction on the mean axes.
void add_axes(BrickMatrix& hessian, const BrickLaw& law, double h, const CornerVectors<double>& x) {
  if (law.axes == 0) return;
  const auto axes = detail::mean_axes(x);
  Eigen::Matrix<double, 9, 1> slope;  // by the three mean axes
  double stretch = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto spring = detail::measure(axes[i], h);
    slope.segment<3>(3 * int(i)) = to_vector(spring.direction);
    stretch += spring.stretch;
  }
  Eigen::Matrix<double, 9, 9> second = law.axes * slope * slope.transpose();
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = 3 * int(i);
    second.block<3, 3>(row, row) += sideways(slope.segment<3>(row), law.axes * stretch, to_vector(axes[i]).norm());
  }
  Eigen::Matrix<double, 9, 24> axes_by_corner = Eigen::Matrix<double, 9, 24>::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      axes_by_corner.block<3, 3>(3 * axis, 3 * corner) = (on_high_side(corner, axis) ? 0.25 : -0.25) * Mat3::Identity();
    }
  }
  hessian += axes_by_corner.transpose() * second * axes_by_corner;
}

}  // namespace

BrickMatrix brick_hessian(const BrickLaw& law, double h, const CornerVectors<double>& x) {
  BrickMatrix hessian = BrickMatrix::Zero();
  add_edges(hessian, law, h, x);
  add_diagonals(hessian, kFaceDiagonals, std::numbers::sqrt2 * h, law.face, x);
  add_diagonals(hessian, kInnerDiagonals, std::numbers::sqrt3 * h, law.inner, x);
  add_axes(hessian, law, h, x);
  return hessian;
}

BrickMatrix without_negative_curvature(const BrickMatrix& hessian) {
  const Eigen::SelfAdjointEigenSolver<BrickMatrix> solver(hessian);
  if (solver.eigenvalues().minCoeff() >= 0) return hessian;
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() * solver.eigenvectors().transpose();
}

BrickMatrix body_brick_hessian(const Body& body, std::size_t brick, bool definite) {
  return brick_model(body.model).hessian(body, brick, at_corners(body, brick, body.positions), definite);
}

double largest_brick_stiffness(const Body& body) {
  return Eigen::SelfAdjointEigenSolver<BrickMatrix>(brick_model(body.model).full_brick_hessian(body),
                                                    Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

}  // namespace sprung
