#include "core/dynamics/statics/statics.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "core/body/forces.h"
#include "core/dynamics/linear/stiffness.h"
#include "core/dynamics/statics/modes.h"
#include "core/error.h"
#include "tests/support/bodies.h"

namespace sprung {
namespace {

using test::shake;
using test::test_material;

/// The paper's cantilever, 0.4 x 0.1 x 0.1 m, E = 1 kPa, clamped at x = 0, under 1 N/m^3 along -y.
class Cantilever {
 public:
  Cantilever(Model model, double poisson, int across, double density = 1, double young = 1000)
      : body(make_body(
            make_box_grid({4 * across, across, across}, 0.1 / across), model,
            {.name = "test", .young = young, .poisson = poisson, .density = density, .damping = 0, .source = ""})),
        supports(body.node_count()),
        loads(Points::Zero(body.node_count(), 3)) {
    loads.col(1) = -body.masses;
    for (int node = 0; node < body.node_count(); ++node) {
      const Eigen::Vector3i& place = body.grid.lattice[node];
      if (place.x() == 0) supports.fix(node);
      const bool is_corner = place.y() % across == 0 && place.z() % across == 0;
      if (place.x() == 4 * across && is_corner) tip.push_back(node);
    }
  }

  [[nodiscard]] double linear_sag() const {
    const auto system = make_direct_solver();
    const Eigen::VectorXd u = solve_linear(body, supports, loads, *system);
    double sum = 0;
    for (const int node : tip) sum -= u[3 * node + 1];
    return sum / double(tip.size());
  }

  Body body;
  Supports supports;
  Points loads;
  std::vector<int> tip;  // the four corners of the free end
};

/// Expected: mean sag of the four end corners by CalculiX 2.20, 20-node bricks, converged to 0.02 %.
constexpr double kSagAtThreeTenths = 0.004004923;
/// Sags over that value, as an independent prototype of the brick found them.
TEST(Statics, CalibratedCantileverIsRightOnEveryGrid) {
  EXPECT_NEAR(Cantilever(Model::kCalibrated, 0.3, 1).linear_sag() / kSagAtThreeTenths, 0.977, 1e-3);
  EXPECT_NEAR(Cantilever(Model::kCalibrated, 0.3, 2).linear_sag() / kSagAtThreeTenths, 0.976, 1e-3);
  EXPECT_NEAR(Cantilever(Model::kCalibrated, 0.3, 4).linear_sag() / kSagAtThreeTenths, 0.990, 1e-3);
  EXPECT_NEAR(Cantilever(Model::kCalibrated, 0, 1).linear_sag() / 0.00403096, 0.993, 1e-3);
}

TEST(Statics, OtherModelsAreAsStiffAsTheyAreKnownToBe) {
  EXPECT_NEAR(Cantilever(Model::kTensile, 0.3, 2).linear_sag() / kSagAtThreeTenths, 0.710, 1e-3);
  EXPECT_NEAR(Cantilever(Model::kM2Plain, 0.3, 2).linear_sag() / kSagAtThreeTenths, 0.707, 1e-3);
  EXPECT_NEAR(Cantilever(Model::kFem, 0.3, 1).linear_sag() / kSagAtThreeTenths, 0.655, 1e-3);
  EXPECT_NEAR(Cantilever(Model::kFem, 0.3, 2).linear_sag() / kSagAtThreeTenths, 0.864, 1e-3);
}

TEST(Statics, SmallLoadsGiveTheLinearAnswer) {
  Cantilever beam(Model::kCalibrated, 0.3, 2);
  const auto system = make_direct_solver();
  const Eigen::VectorXd linear = solve_linear(beam.body, beam.supports, 1e-4 * beam.loads, *system);
  const Points start = beam.body.positions;
  solve_static(beam.body, beam.supports, 1e-4 * beam.loads, start, *system);
  const Points moved = beam.body.positions - start;
  EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(moved.data(), moved.size()) - linear).norm(), 1e-5 * linear.norm());
}

TEST(Statics, LargeLoadsReachEquilibrium) {
  Cantilever beam(Model::kCalibrated, 0.3, 2);
  const auto system = make_direct_solver();
  const Points start = beam.body.positions;
  const Points loads = 78 * beam.loads;
  const StaticReport report = solve_static(beam.body, beam.supports, loads, start, *system);
  EXPECT_LT(report.residual, 1e-9);
  double drop = 0;
  for (const int node : beam.tip) drop += (start(node, 1) - beam.body.positions(node, 1)) / 4;
  EXPECT_NEAR(drop / 0.2407501, 0.963, 1e-3);  // neo-Hooke by CalculiX: 60 % of the length
  const Points pin_forces = reactions(beam.body, beam.supports, loads);
  EXPECT_NEAR(pin_forces.col(1).sum(), -loads.col(1).sum(), 1e-9 * -loads.col(1).sum());
  EXPECT_NEAR(pin_forces.col(0).sum(), 0, 1e-9 * -loads.col(1).sum());
}

/// A straight column that is compressed to 0.8 of its length: Newton's method begins on a ridge. With the positive part
/// of the curvature alone it takes 102 iterations.
TEST(Statics, APressedColumnLeavesTheRidgeItStandsOn) {
  Cantilever column(Model::kCalibrated, 0.3, 4);
  Body& body = column.body;
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.grid.lattice[node].x() == 16) column.supports.fix(node);
  }
  body.positions.col(0) *= 0.8;
  const Points straight = body.positions;
  const auto system = make_multigrid_solver();
  const Points loads = 1e-3 * column.loads;
  const StaticReport report = solve_static(body, column.supports, loads, straight, *system);
  EXPECT_LT(report.residual, 1e-8);
  EXPECT_LE(report.iterations, 12);
  EXPECT_GT((body.positions - straight).col(1).cwiseAbs().maxCoeff(), 0.1 * 0.4);
  EXPECT_GT(natural_modes(body, column.supports, 1).frequencies[0], 0);  // a minimum
}

TEST(Statics, MovedSupportsPullTheBodyAlong) {
  Body bar = make_body(make_box_grid({4, 1, 1}, 0.1), Model::kCalibrated, test_material(0, 1000));
  Supports supports(bar.node_count());
  const Points start = bar.positions;
  for (int node = 0; node < bar.node_count(); ++node) {
    const int x = bar.grid.lattice[node].x();
    if (x == 0 || x == 4) supports.fix(node);
    if (x == 4) bar.positions(node, 0) += 4e-6;
  }
  const auto system = make_direct_solver();
  const Points no_loads = Points::Zero(bar.node_count(), 3);
  solve_static(bar, supports, no_loads, start, *system);
  double pull = 0;
  const Points pin_forces = reactions(bar, supports, no_loads);
  for (int node = 0; node < bar.node_count(); ++node) {
    EXPECT_NEAR(bar.positions(node, 0), (1 + 1e-5) * start(node, 0), 1e-12);
    if (bar.grid.lattice[node].x() == 4) pull += pin_forces(node, 0);
  }
  EXPECT_NEAR(pull, 1000 * 0.01 * 1e-5, 1e-5 * 1e-4);  // E A strain
}

TEST(Statics, FreeBodiesAreRefused) {
  Cantilever beam(Model::kCalibrated, 0.3, 1);
  const Supports none(beam.body.node_count());
  const auto system = make_direct_solver();
  EXPECT_THROW((void)solve_linear(beam.body, none, beam.loads, *system), Error);
}

std::string reason_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

/// Supported along one edge only; its weight turns it about that edge.
TEST(Statics, AFreeMotionIsNamed) {
  Cantilever beam(Model::kCalibrated, 0.3, 2);
  Supports hinge(beam.body.node_count());
  for (int node = 0; node < beam.body.node_count(); ++node) {
    const Eigen::Vector3i& place = beam.body.grid.lattice[node];
    if (place.x() == 0 && place.y() == 0) hinge.fix(node);
  }
  const std::string turn = "can turn about an axis along (0.00, 0.00, 1.00)";
  const auto system = make_default_solver();
  const std::string reason = reason_of([&] { (void)solve_linear(beam.body, hinge, beam.loads, *system); });
  EXPECT_NE(reason.find("the supports leave the body free to move; "), std::string::npos) << reason;
  EXPECT_NE(reason.find(turn), std::string::npos) << reason;
  EXPECT_EQ(natural_modes(beam.body, hinge, 3).rigid, 1);
  // Loads that do not drive the motion are carried all the same.
  Points along = Points::Zero(beam.body.node_count(), 3);
  along.col(2) = beam.body.masses;
  const Eigen::VectorXd sideways = solve_linear(beam.body, hinge, along, *system);
  EXPECT_GT(sideways.cwiseAbs().maxCoeff(), 0);
}

TEST(Modes, CantileverSwingsAtItsReferenceFrequencies) {
  // CalculiX 2.20, E = 100 kPa, nu = 0.3, 1000 kg/m^3: 0.97372 Hz twice (bending), 6.28983 Hz (stretch).
  const Cantilever beam(Model::kCalibrated, 0.3, 2, 1000, 1e5);
  const Modes modes = natural_modes(beam.body, beam.supports, 6);
  EXPECT_NEAR(modes.frequencies[0] / 0.97372, 1, 0.01);
  EXPECT_NEAR(modes.frequencies[1] / modes.frequencies[0], 1, 1e-6);
  EXPECT_NEAR(modes.frequencies[5] / 6.28983, 1, 0.01);
  for (int k = 1; k < 6; ++k) EXPECT_GE(modes.frequencies[k], modes.frequencies[k - 1] * (1 - 1e-9));
  // Rayleigh's quotient of each shape gives its frequency back.
  Eigen::VectorXd masses(3 * beam.body.node_count());
  for (int i = 0; i < masses.size(); ++i) masses[i] = beam.body.masses[i / 3];
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(modes.shapes.col(k).cwiseAbs2().dot(masses), 1, 1e-9);
}

/// A free beam of 20 : 1: its rigid motions are no vibrations. Expected: 22.373 / (2 pi) sqrt(E I / (rho A L^4)) of
/// Euler and Bernoulli, about 1 % less by shear and the inertia of the sections, and of the masses in nodes.
TEST(Modes, AFreeBeamSwingsAtTheFrequencyOfTheory) {
  const Body beam = make_body(make_box_grid({40, 2, 2}, 0.01), Model::kCalibrated, test_material(0.3, 1e5));
  const Modes modes = natural_modes(beam, Supports(beam.node_count()), 4);
  EXPECT_EQ(modes.rigid, 6);
  const double slender = 22.3733 / (2 * std::numbers::pi) * std::sqrt(1e5 / (12 * 1000.0)) * 0.02 / (0.4 * 0.4);
  EXPECT_NEAR(modes.frequencies[0] / slender, 0.985, 0.01);
  EXPECT_NEAR(modes.frequencies[1] / modes.frequencies[0], 1, 1e-6);
  EXPECT_NEAR(modes.frequencies[2] / modes.frequencies[0], 61.673 / 22.373, 0.08);
  for (int mode = 0; mode < 4; ++mode) {
    const Eigen::Map<const Points> shape(modes.shapes.col(mode).data(), beam.node_count(), 3);
    EXPECT_LT((shape.transpose() * beam.masses).norm(), 1e-6) << "it moves as a whole";
  }
}

/// By multigrid, checked with the matrix: a body of more coordinates than are solved densely, supported and free. More
/// modes begin with the same ones.
TEST(Modes, OfALargerBodyAreEigenvectorsAndNoneIsMissed) {
  const Body block = make_body(make_box_grid({8, 9, 10}, 0.01), Model::kCalibrated, test_material(0.4, 1e5));
  Supports foot(block.node_count());
  for (int node = 0; node < block.node_count(); ++node) {
    if (block.grid.lattice[node].z() == 0) foot.fix(node);
  }
  for (const Supports& supports : {foot, Supports(block.node_count())}) {
    const FreeDofs dofs(supports);
    const Eigen::SparseMatrix<double> stiffness = stiffness_matrix(block, dofs, false, {});
    Eigen::VectorXd masses(3 * block.node_count());
    for (int i = 0; i < masses.size(); ++i) masses[i] = block.masses[i / 3];
    const Modes few = natural_modes(block, supports, 5);
    const Modes many = natural_modes(block, supports, 15);
    EXPECT_LT((few.frequencies - many.frequencies.head(5)).cwiseAbs().maxCoeff(), 1e-6 * few.frequencies[0]);
    for (int mode = 0; mode < 15; ++mode) {
      const double square = std::pow(2 * std::numbers::pi * many.frequencies[mode], 2);
      const Eigen::VectorXd shape = dofs.gather(many.shapes.col(mode));
      const Eigen::VectorXd inertia = square * dofs.gather(masses).cwiseProduct(shape);
      const Eigen::VectorXd left = stiffness.selfadjointView<Eigen::Lower>() * shape - inertia;
      EXPECT_LT(left.norm(), 1e-3 * inertia.norm()) << mode;
    }
    EXPECT_LT((many.shapes.transpose() * masses.asDiagonal() * many.shapes - Eigen::MatrixXd::Identity(15, 15)).norm(),
              1e-8);
  }
}

/// The energy of bricks far from the origin is rounded by more than what the last Newton steps change.
TEST(Statics, AStiffBodyUnderASmallLoadTakesFewIterations) {
  for (const double young : {1e6, 1e8, 1e10}) {
    Cantilever cantilever(Model::kCalibrated, 0.3, 4, 1, young);
    place(cantilever.body, Mat3(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())), Vec3(0.3, -0.2, 0.5));
    const auto system = make_default_solver();
    const StaticReport report =
        solve_static(cantilever.body, cantilever.supports, cantilever.loads, cantilever.body.positions, *system);
    EXPECT_EQ(report.load_steps, 1) << young;
    EXPECT_LE(report.iterations, 4) << young;
  }
}

}  // namespace
}  // namespace sprung
