#include "core/body/membrane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "tests/support/bodies.h"

namespace sprung {
namespace {

using test::test_material;

constexpr double kLength = 4;
constexpr double kHeight = 1;
constexpr double kForce = 1;

/// Adds the nodal forces of a traction (N/m^2 at height y from the axis) on the column of nodes at one end; at most
/// quadratic tractions are taken exactly (Simpson's rule on traction times shape function).
template <class Traction>
void load_end(const Membrane& membrane, int columns, int column, const Traction& traction, Points2& loads) {
  const int stride = columns + 1;
  for (int low = column; low + stride < membrane.node_count(); low += stride) {
    const double y = membrane.rest_positions(low, 1) - kHeight / 2;
    const double side = membrane.law.sides[1];
    const Vec2 middle = 2 * traction(y + side / 2);
    loads.row(low) += side / 6 * (traction(y) + middle).transpose();
    loads.row(low + stride) += side / 6 * (traction(y + side) + middle).transpose();
  }
}

/// Mean deflection of the tip of a cantilever against its root's low corner, over the exact one. Timoshenko and
/// Goodier, "Theory of Elasticity", article 21: sigma_x = P (L-x) y / I, tau = -P (H^2/4 - y^2) / (2 I), and with u_x =
/// 0 at the root's corners v(L, any y) - v(0, +-H/2) = -P ((4+2nu) H^2 L/4 + 2 L^3) / (6 E I).
double cantilever_ratio(RectangleModel model, double poisson, int columns, int rows) {
  const Material material = test_material(poisson);
  Membrane membrane = make_membrane(columns, rows, {kLength, kHeight}, model, material);
  const double inertia = std::pow(kHeight, 3) / 12;
  const auto shear = [&](double y) { return kForce * (kHeight * kHeight / 4 - y * y) / (2 * inertia); };
  Points2 loads = Points2::Zero(membrane.node_count(), 2);
  load_end(
      membrane, columns, columns, [&](double y) { return Vec2(0, -shear(y)); }, loads);
  load_end(
      membrane, columns, 0, [&](double y) { return Vec2(-kForce * kLength * y / inertia, shear(y)); }, loads);
  const int top = rows * (columns + 1);
  membrane.fix(0, 0);
  membrane.fix(0, 1);
  membrane.fix(top, 0);
  const Points2 moved = solve_linear(membrane, loads);
  double tip = 0;
  for (int row = 0; row <= rows; ++row) tip += moved(row * (columns + 1) + columns, 1) / (rows + 1);
  const double exact = -kForce * ((4 + 2 * poisson) * kHeight * kHeight * kLength / 4 + 2 * std::pow(kLength, 3)) /
                       (6 * material.young * inertia);
  return tip / exact;
}

/// The same deflection of the material that plain springs on squares really are: from A (rectangle_law.h), E' = E 3 (3
/// nu
/// + 1) / (2 (3 nu + 2)) and nu' = 1 / (3 nu + 2), with the right G. The solution above holds with 1/G - nu'/E' for (2
/// + nu) / E.
double plain_limit(double poisson) {
  const double young = 3 * (3 * poisson + 1) / (2 * (3 * poisson + 2));
  const auto deflection = [&](double e, double nu) {
    return std::pow(kLength, 3) / (3 * e) + kLength * kHeight * kHeight / 12 * (2 * (1 + poisson) - nu / e);
  };
  return deflection(young, 1 / (3 * poisson + 2)) / deflection(1, poisson);
}

/// Measured on 1, 2, 4, 8, 16, 32 rows of squares, deflection over the exact one:
///   nu 0     calibrated .9848 .9957 .9993 .9999 1 1    corrected .6667 .8884 .9663 .9903 .9973 .9993
///            plain .6667 1.0547 1.2303 1.2890 1.3063 1.3112, towards 1.3131
///   nu 0.3   calibrated .9894 .9975 .9996 1 1 1        corrected .4727 .7775 .9259 .9780 .9937 .9982
///            plain .4727 .7845 .9387 .9932 1.0096 1.0143, towards 1.0162
///   nu 0.49  calibrated .9923 .9985 .9998 1 1 1        corrected .4259 .7399 .9101 .9730 .9922 .9978
///            plain .4259 .7167 .8654 .9192 .9357 .9404, towards 0.9423
TEST(Membrane, CalibratedCantileverIsRightOnCoarseGrids) {
  for (const double poisson : {-0.3, 0.0, 0.3, 0.49}) {
    EXPECT_NEAR(cantilever_ratio(RectangleModel::kCalibrated, poisson, 4, 1), 1, 0.025) << poisson;
    EXPECT_NEAR(cantilever_ratio(RectangleModel::kCalibrated, poisson, 8, 2), 1, 0.007) << poisson;
    EXPECT_NEAR(cantilever_ratio(RectangleModel::kCalibrated, poisson, 64, 16), 1, 1e-4) << poisson;
    for (const int columns_per_row : {2, 8}) {  // rectangles of 2 : 1 and 1 : 2
      EXPECT_NEAR(cantilever_ratio(RectangleModel::kCalibrated, poisson, 16 * columns_per_row, 16), 1, 4e-4) << poisson;
    }
  }
}

TEST(Membrane, CorrectedCantileverConverges) {
  for (const double poisson : {0.0, 0.3, 1.0 / 3, 0.49}) {
    double error = 1 - cantilever_ratio(RectangleModel::kCorrected, poisson, 8, 2);
    EXPECT_GT(error, 0.1) << poisson;
    for (const int rows : {4, 8, 16, 32}) {
      const double finer = 1 - cantilever_ratio(RectangleModel::kCorrected, poisson, 4 * rows, rows);
      EXPECT_LT(finer, error / 2.7) << poisson << ", " << rows << " rows";
      error = finer;
    }
    EXPECT_LT(std::abs(error), 0.0025) << poisson;
  }
}

TEST(Membrane, PlainCantileverConvergesToAnotherMaterial) {
  EXPECT_NEAR(plain_limit(1.0 / 3), 1, 1e-12);
  for (const double poisson : {0.0, 0.1, 0.3, 1.0 / 3, 0.49}) {
    const double limit = plain_limit(poisson);
    const double coarse = cantilever_ratio(RectangleModel::kPlain, poisson, 64, 16) - limit;
    const double fine = cantilever_ratio(RectangleModel::kPlain, poisson, 128, 32) - limit;
    EXPECT_LT(std::abs(fine), 0.0025) << poisson;
    EXPECT_LT(std::abs(fine), std::abs(coarse) / 2.7) << poisson;
    if (poisson == 1.0 / 3) continue;
    EXPECT_GT(std::abs(limit - 1), 0.015) << poisson;
  }
}

/// A thin clamped strip under a tip force P with P L^2 / (E I) = 1, 2, 10, against the elastica: K. Mattiasson,
/// "Numerical results from large deflection beam and frame problems analysed by means of elliptic integrals", IJNME
/// 17 (1981).
TEST(Membrane, ThinStripFollowsTheElastica) {
  struct Case {
    double load;
    double drop;
    double shortening;
  };
  const double length = 1;
  const double height = 0.01;
  const int columns = 40;
  for (const auto& [load, drop, shortening] :
       {Case{1, 0.30172, 0.05643}, Case{2, 0.49346, 0.16064}, Case{10, 0.81061, 0.55500}}) {
    const Material material = test_material(0.3);
    Membrane membrane = make_membrane(columns, 1, {length, height}, RectangleModel::kCalibrated, material);
    for (const int node : {0, columns + 1}) {
      membrane.fix(node, 0);
      membrane.fix(node, 1);
    }
    const double force = load * material.young * std::pow(height, 3) / 12 / (length * length);
    Points2 loads = Points2::Zero(membrane.node_count(), 2);
    loads(columns, 1) = loads(2 * columns + 1, 1) = -force / 2;
    const StaticReport report = solve_static(membrane, loads);
    EXPECT_LT(report.residual, 1e-9);
    const Vec2 tip = (membrane.positions.row(columns) + membrane.positions.row(2 * columns + 1)).transpose() / 2;
    EXPECT_NEAR((height / 2 - tip.y()) / length, drop, 2e-3 * drop) << load;
    EXPECT_NEAR(1 - tip.x() / length, shortening, 2e-3) << load;

    const Points2 pin_forces = reactions(membrane, loads);
    const Vec2 total = pin_forces.colwise().sum().transpose();
    EXPECT_NEAR(total.x(), 0, 1e-6 * force);
    EXPECT_NEAR(total.y(), force, 1e-6 * force);
    double moment = 0;  // about the root, it balances the force at the tip
    for (const int node : {0, columns + 1}) {
      const Vec2 arm = membrane.positions.row(node).transpose() - Vec2(0, height / 2);
      moment += arm.x() * pin_forces(node, 1) - arm.y() * pin_forces(node, 0);
    }
    EXPECT_NEAR(moment, force * tip.x(), 1e-5 * force);
  }
}

TEST(Membrane, SmallLoadsAnswerLinearly) {
  Membrane membrane = make_membrane(5, 3, {0.5, 0.2}, RectangleModel::kCorrected, test_material(0.4));
  for (int row = 0; row <= 3; ++row) {
    membrane.fix(6 * row, 0);
    membrane.fix(6 * row, 1);
  }
  Points2 loads = Points2::Zero(membrane.node_count(), 2);
  loads.row(23) << 1e-4, -2e-4;
  const Points2 linear = solve_linear(membrane, loads);
  solve_static(membrane, loads);
  EXPECT_LT((membrane.positions - membrane.rest_positions - linear).norm(), 1e-5 * linear.norm());
}

TEST(Membrane, SupportsCanBeMoved) {
  const double strain = 1e-6;
  const Material material = test_material(0.2);
  Membrane membrane = make_membrane(4, 2, {0.4, 0.2}, RectangleModel::kCorrected, material);
  membrane.fix(0, 1);
  for (int row = 0; row <= 2; ++row) {
    membrane.fix(5 * row, 0);
    membrane.fix(5 * row + 4, 0);
    membrane.positions(5 * row + 4, 0) += strain * 0.4;
  }
  const Points2 none = Points2::Zero(membrane.node_count(), 2);
  solve_static(membrane, none);
  const Points2 pin_forces = reactions(membrane, none);
  EXPECT_NEAR(pin_forces(4, 0) + pin_forces(9, 0) + pin_forces(14, 0), material.young * strain * 0.2,
              1e-4 * material.young * strain * 0.2);
  EXPECT_NEAR((membrane.positions(12, 1) - membrane.positions(2, 1)) / 0.2 - 1, -0.2 * strain, 1e-4 * strain);
}

/// A squeezed strip buckles: in one load step, Newton's direction must come from the positive part of the curvature.
TEST(Membrane, FindsEquilibriumBeyondBuckling) {
  const Material material = test_material(0.3);
  const int columns = 40;
  const double height = 0.02;
  Membrane membrane = make_membrane(columns, 1, {1, height}, RectangleModel::kCalibrated, material);
  for (const int node : {0, columns + 1}) {
    membrane.fix(node, 0);
    membrane.fix(node, 1);
  }
  const double stiffness = material.young * std::pow(height, 3) / 12;
  const double critical = stiffness * std::pow(std::numbers::pi / 2, 2);
  Points2 loads = Points2::Zero(membrane.node_count(), 2);
  for (const int node : {columns, 2 * columns + 1}) loads.row(node) << -1.152 * critical / 2, -1e-5 * critical;
  const StaticReport report = solve_static(membrane, loads, {.max_load_steps = 1});
  EXPECT_EQ(report.load_steps, 1);
  // Elastica: at P = 1.152 of the critical load the tip has turned by 60 degrees and moved 0.593 L sideways.
  EXPECT_NEAR(height - membrane.positions(2 * columns + 1, 1), 0.593, 0.01);
}

TEST(Membrane, RefusesWhatCannotStand) {
  Membrane membrane = make_membrane(2, 1, {0.2, 0.1}, RectangleModel::kCalibrated, test_material(0.3));
  Points2 loads = Points2::Zero(membrane.node_count(), 2);
  loads(5, 1) = 1;
  EXPECT_THROW((void)solve_linear(membrane, loads), Error);
  EXPECT_THROW((void)make_membrane(0, 1, {0.2, 0.1}, RectangleModel::kCalibrated, test_material(0.3)), Error);
  EXPECT_THROW((void)make_membrane(1, 1, {0.2, 0}, RectangleModel::kCalibrated, test_material(0.3)), Error);
}

TEST(Membrane, HasTheMassAndTheAreaOfItsRectangles) {
  const Membrane membrane = make_membrane(3, 2, {0.3, 0.1}, RectangleModel::kCalibrated, test_material(0.3));
  EXPECT_NEAR(membrane.masses.sum(), 1000 * 0.03, 1e-12);
  const MembraneSurface surface = membrane_surface(membrane);
  double area = 0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Vec3 a = surface.positions.row(surface.triangles(t, 0));
    const Vec3 b = surface.positions.row(surface.triangles(t, 1));
    const Vec3 c = surface.positions.row(surface.triangles(t, 2));
    const Vec3 twice = (b - a).cross(c - a);
    EXPECT_GT(twice.z(), 0);
    area += twice.norm() / 2;
  }
  EXPECT_NEAR(area, 0.03, 1e-14);
}

}  // namespace
}  // namespace sprung
