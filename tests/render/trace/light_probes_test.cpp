#include "render/trace/light_probes.h"

#include <gtest/gtest.h>

#include "tests/support/still_life.h"

namespace sprung {
namespace {

TEST(LightProbes, AreFewerThanVerticesAndReachAllOfThem) {
  const Skin ball = make_sphere_skin({0, 0, 0}, 1);
  const LightProbes probes = place_probes(ball, 0.25);
  EXPECT_LT(probes.vertices.size(), ball.positions.rows() / 2);
  ASSERT_EQ(probes.first.size(), ball.positions.rows() + 1);
  for (Eigen::Index vertex = 0; vertex < ball.positions.rows(); ++vertex) {
    Vec3 mean = Vec3::Zero();
    float sum = 0;
    for (int k = probes.first[std::size_t(vertex)]; k < probes.first[std::size_t(vertex) + 1]; ++k) {
      const int probe = probes.vertices[std::size_t(probes.probes[std::size_t(k)])];
      sum += probes.weights[std::size_t(k)];
      mean += double{probes.weights[std::size_t(k)]} * ball.positions.row(probe).transpose();
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_LT((mean - ball.positions.row(vertex).transpose()).norm(), 0.25);
  }
}

TEST(LightProbes, OfOneSideOfASheetSayNothingAboutTheOther) {
  const Skin sheet = make_box_skin({-1, -0.01, -1}, {1, 0.01, 1});
  const LightProbes probes = place_probes(sheet, 0.5);
  for (Eigen::Index vertex = 0; vertex < sheet.positions.rows(); ++vertex) {
    for (int k = probes.first[std::size_t(vertex)]; k < probes.first[std::size_t(vertex) + 1]; ++k) {
      const int probe = probes.vertices[std::size_t(probes.probes[std::size_t(k)])];
      EXPECT_GT(sheet.normals.row(vertex).dot(sheet.normals.row(probe)), 0) << vertex << " takes from " << probe;
    }
  }
}

TEST(LightProbes, OfManyBodiesAreNoMoreThanAskedFor) {
  const Skin ball = make_sphere_skin({0, 0, 0}, 0.1);
  const std::vector<const Skin*> balls(200, &ball);
  std::size_t all = 0;
  for (const double spacing : probe_spacings(balls, 5000)) all += place_probes(ball, spacing).vertices.size();
  EXPECT_LT(all, 5000U * 3 / 2);
  EXPECT_GT(all, 2500U);
}

}  // namespace
}  // namespace sprung
