#include "app/validate/node_errors.h"

#include <gtest/gtest.h>

#include "tests/support/bodies.h"
#include "tests/support/error_message.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

Body centred_bar() {
  BrickGrid grid = make_box_grid({4, 1, 1}, 0.1);
  grid.origin = Vec3(-0.2, -0.05, -0.05);
  return make_body(std::move(grid), Model::kCalibrated, test::test_material(0.3));
}

/// Known at two of the bar's nodes and at a point between nodes, which does not count.
KnownSolution known_by_hand() {
  KnownSolution known{.poisson = 0.3, .positions = Points(3, 3), .displacements = Points::Zero(3, 3)};
  known.positions << -0.2, -0.05, 0.05, 0.2, 0.05, 0.05, 0.03, 0, 0;
  known.displacements.row(1) << 0, -0.02, 0;
  known.displacements.row(2) << 0, -0.01, 0;
  return known;
}

TEST(NodeErrors, AreThoseAtSharedNodes) {
  Body body = centred_bar();
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.rest_positions(node, 0) > 0.19) body.positions.row(node) += Eigen::RowVector3d(0.003, -0.016, 0);
  }
  const NodeErrors errors = node_errors(body, Mat3::Identity(), known_by_hand());
  ASSERT_EQ(errors.nodes.size(), 2U);
  EXPECT_NEAR(errors.nodes[0].along, 0, 1e-12);
  EXPECT_NEAR(errors.nodes[1].along, 1, 1e-12);
  EXPECT_LT((errors.nodes[1].error - Vec3(0.003, 0.004, 0)).norm(), 1e-12);
  EXPECT_NEAR(errors.max_error(), 0.25, 1e-12);
  EXPECT_NEAR(errors.mean_error(), 0.125, 1e-12);
  EXPECT_NEAR(errors.rms_error(), 0.25, 1e-12);
}

TEST(NodeErrors, NeedANodeToCompare) {
  KnownSolution known = known_by_hand();
  known.positions.array() += 0.01;
  EXPECT_NE(error_message([&] { static_cast<void>(node_errors(centred_bar(), Mat3::Identity(), known)); }), "");
}

TEST(NodeErrors, TableIsReadByRatio) {
  const TempFolder folder;
  const auto file = folder.write(
      "known.csv", "# by hand\npoisson,x,y,z,ux,uy,uz\n0,1,2,3,4,5,6\n0.3,1,2,3,4,5,-6e-3\n0.3,0,0,0,0,0,0\n");
  const std::vector<KnownSolution> known = read_known_solutions(file);
  ASSERT_EQ(known.size(), 2U);
  EXPECT_EQ(known[0].poisson, 0);
  EXPECT_EQ(known[1].positions.rows(), 2);
  EXPECT_EQ(known[1].displacements(0, 2), -6e-3);
  for (const char* line : {"1,2,3", "0,1,2,3,4,5,6,7", "0,1,2,3,4,5,x", "0,1,2,3,4,5,6m", "0,1,2,,4,5,6"}) {
    const auto wrong = folder.write("wrong.csv", std::string("poisson,x,y,z,ux,uy,uz\n0,1,2,3,4,5,6\n") + line + "\n");
    const std::string message = error_message([&] { static_cast<void>(read_known_solutions(wrong)); });
    EXPECT_NE(message.find("wrong.csv:3: '"), std::string::npos) << line << ": " << message;
  }
}

/// The centre of the beam's end, and its clamped root.
TEST(NodeErrors, ReferenceOfTheCantileverHasItsTips) {
  const auto known = read_known_solutions(SPRUNG_SOURCE_DIR "/assets/experiments/cantilever_nodes.csv");
  ASSERT_EQ(known.size(), 3U);
  for (const KnownSolution& one : known) {
    ASSERT_EQ(one.positions.rows(), 17 * 5 * 5);
    for (Eigen::Index i = 0; i < one.positions.rows(); ++i) {
      if (one.positions(i, 0) < -0.1999) {
        EXPECT_EQ(one.displacements.row(i).norm(), 0);
      }
      const bool is_tip = one.positions.row(i).isApprox(Eigen::RowVector3d(0.2, 0, 0), 1e-9);
      if (is_tip && one.poisson == 0.3) {
        EXPECT_EQ(one.displacements(i, 1), -0.004004546);
      }
    }
  }
}

}  // namespace
}  // namespace sprung
