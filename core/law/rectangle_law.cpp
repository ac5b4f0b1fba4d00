#include "core/law/rectangle_law.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"

namespace sprung {
namespace {

struct Ends {
  Eigen::Index from;
  Eigen::Index to;
};

/// Two edges along x, two along y (each low side first), two diagonals.
constexpr std::array<Ends, 6> kSprings{{{0, 1}, {2, 3}, {0, 2}, {1, 3}, {0, 3}, {1, 2}}};

using SpringValues = Eigen::Matrix<double, 6, 1>;

struct Springs {
  Eigen::Matrix<double, 2, 6> directions;  // unit, from the first end to the second
  SpringValues lengths;                    // m
  SpringValues stretches;                  // m
};

Springs measure(const RectangleLaw& law, const RectangleVector& x) {
  const std::array<double, 3> rest{law.sides[0], law.sides[1], std::hypot(law.sides[0], law.sides[1])};
  Springs springs;
  for (int s = 0; s < 6; ++s) {
    const Ends ends = kSprings[s];
    const Eigen::Vector2d along = x.segment<2>(2 * ends.to) - x.segment<2>(2 * ends.from);
    const double rest_length = rest[s / 2];
    const double length = along.norm();
    springs.directions.col(s) = along / length;
    springs.lengths[s] = length;
    // The difference of two nearly equal lengths would lose half its digits.
    springs.stretches[s] = (along.squaredNorm() - rest_length * rest_length) / (length + rest_length);
  }
  return springs;
}

/// Tensions for stretches, N/m: constant and symmetric. The energy is half its quadratic form.
Eigen::Matrix<double, 6, 6> coupling(const RectangleLaw& law) {
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const std::size_t i = axis;
    const double mean = law.axial_self[i] / 4;
    const double half_difference = law.bending[i] / 4;
    auto block = matrix.block<2, 2>(2 * axis, 2 * axis);
    block.setConstant(mean - half_difference);
    block.diagonal().setConstant(law.edge[i] + mean + half_difference);
    matrix.block<2, 2>(2 * axis, 2 - 2 * axis).setConstant(law.axial_cross / 4);
  }
  matrix(4, 4) = matrix(5, 5) = law.diagonal;
  return matrix;
}

/// How each spring's length follows the corners, one spring a row.
Eigen::Matrix<double, 6, 8> length_gradients(const Springs& springs) {
  Eigen::Matrix<double, 6, 8> gradients = Eigen::Matrix<double, 6, 8>::Zero();
  for (int s = 0; s < 6; ++s) {
    const Ends ends = kSprings[s];
    gradients.block<1, 2>(s, 2 * ends.to) = springs.directions.col(s).transpose();
    gradients.block<1, 2>(s, 2 * ends.from) = -springs.directions.col(s).transpose();
  }
  return gradients;
}

/// The paper's springs; those of edges may be negative.
RectangleLaw paper_springs(const Material& material, const std::array<double, 2>& sides) {
  const double l = sides[0];
  const double h = sides[1];
  const double scale = material.young / (4 * l * h * (1 + material.poisson));
  const double lateral = 3 * material.poisson + 2;
  RectangleLaw law;
  law.sides = sides;
  law.diagonal = scale * (l * l + h * h);
  law.edge = {scale * (h * h * lateral - l * l), scale * (l * l * lateral - h * h)};
  return law;
}

void check_edge_springs(const RectangleLaw& law, const Material& material) {
  if (law.edge[0] >= 0 && law.edge[1] >= 0) return;
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("a rectangle of {} x {} m needs an edge spring that pushes at Poisson's ratio {}: its sides may "
                  "differ by a factor of {:.3g} at most; use the calibrated rectangle",
                  law.sides[0], law.sides[1], material.poisson, std::sqrt(std::max(0.0, 3 * material.poisson + 2))));
}

void calibrate_stretch(RectangleLaw& law, const Material& material) {
  const double plate = material.young / (1 - material.poisson * material.poisson);
  const double diagonal_squared = law.sides[0] * law.sides[0] + law.sides[1] * law.sides[1];
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = law.sides[i];
    const double springs = 2 * law.edge[i] + 2 * law.diagonal * side * side / diagonal_squared;
    law.axial_self[i] = plate * law.sides[1 - i] / side - springs;
  }
  law.axial_cross = plate * material.poisson - 2 * law.diagonal * law.sides[0] * law.sides[1] / diagonal_squared;
}

void calibrate_bending(RectangleLaw& law, const Material& material) {
  for (std::size_t i = 0; i < 2; ++i) {
    law.bending[i] = material.young * law.sides[1 - i] / (3 * law.sides[i]) - 2 * law.edge[i];
  }
}

}  // namespace

RectangleLaw rectangle_law(RectangleModel model, const Material& material, const std::array<double, 2>& sides) {
  check_material(material);
  for (const double side : sides) {
    if (!(std::isfinite(side) && side > 0)) {
      throw Error(ErrorKind::kBadInput, fmt::format("a rectangle's side is {} m: it must be positive", side));
    }
  }
  RectangleLaw law = paper_springs(material, sides);
  if (model == RectangleModel::kCalibrated) {
    law.edge = {0, 0};
    calibrate_bending(law, material);
  } else {
    check_edge_springs(law, material);
  }
  if (model != RectangleModel::kPlain) calibrate_stretch(law, material);
  return law;
}

double rectangle_energy(const RectangleLaw& law, const RectangleVector& x) {
  const Springs springs = measure(law, x);
  return 0.5 * springs.stretches.dot(coupling(law) * springs.stretches);
}

RectangleVector rectangle_forces(const RectangleLaw& law, const RectangleVector& x) {
  const Springs springs = measure(law, x);
  const SpringValues tensions = coupling(law) * springs.stretches;
  return -length_gradients(springs).transpose() * tensions;
}

RectangleMatrix rectangle_hessian(const RectangleLaw& law, const RectangleVector& x) {
  const Springs springs = measure(law, x);
  const Eigen::Matrix<double, 6, 6> stiffness = coupling(law);
  const SpringValues tensions = stiffness * springs.stretches;
  const Eigen::Matrix<double, 6, 8> gradients = length_gradients(springs);
  RectangleMatrix hessian = gradients.transpose() * stiffness * gradients;
  for (int s = 0; s < 6; ++s) {
    // A tension resists turning its spring.
    const Eigen::Vector2d across(-springs.directions(1, s), springs.directions(0, s));
    const Eigen::Matrix2d turning = tensions[s] / springs.lengths[s] * across * across.transpose();
    const Eigen::Index a = 2 * kSprings[s].from;
    const Eigen::Index b = 2 * kSprings[s].to;
    hessian.block<2, 2>(a, a) += turning;
    hessian.block<2, 2>(b, b) += turning;
    hessian.block<2, 2>(a, b) -= turning;
    hessian.block<2, 2>(b, a) -= turning;
  }
  return hessian;
}

RectangleVector rest_corners(const RectangleLaw& law) {
  const double l = law.sides[0];
  const double h = law.sides[1];
  return (RectangleVector() << 0, 0, l, 0, 0, h, l, h).finished();
}

}  // namespace sprung
