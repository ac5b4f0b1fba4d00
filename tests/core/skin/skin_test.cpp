#include "core/skin/skin.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <random>

#include "core/bricks/embedding.h"
#include "core/mesh/repair/weld.h"
#include "tests/support/bodies.h"

namespace sprung {
namespace {

/// A unit cube of eight vertices, no normals.
SurfaceMesh cube_mesh() {
  SurfaceMesh mesh;
  mesh.positions.resize(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) mesh.positions(corner, axis) = on_high_side(corner, axis) ? 1 : 0;
  }
  mesh.triangles.resize(12, 3);
  mesh.triangles << 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7,
      4, 7, 6;
  mesh.parts.push_back({.name = "cube", .first_triangle = 0, .triangle_count = 12, .material = -1});
  return mesh;
}

double area_of(const Skin& skin) {
  double area = 0;
  for (int t = 0; t < skin.triangles.rows(); ++t) {
    const Vec3 a = skin.positions.row(skin.triangles(t, 0));
    const Vec3 b = skin.positions.row(skin.triangles(t, 1));
    const Vec3 c = skin.positions.row(skin.triangles(t, 2));
    area += (b - a).cross(c - a).norm() / 2;
  }
  return area;
}

/// Every edge, by position, is used once in each direction.
bool is_closed(const Skin& skin) {
  const std::vector<int> point = weld_points(skin.positions);
  std::map<std::pair<int, int>, int> balance;
  for (int t = 0; t < skin.triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const int a = point[skin.triangles(t, c)];
      const int b = point[skin.triangles(t, (c + 1) % 3)];
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

TEST(Skin, SharpEdgesStaySharp) {
  const Skin skin = make_skin(cube_mesh(), {.max_edge = 0, .crease_angle = 40});
  EXPECT_EQ(skin.positions.rows(), 24);
  for (int t = 0; t < 12; ++t) {
    const Vec3 a = skin.positions.row(skin.triangles(t, 0));
    const Vec3 face = (Vec3(skin.positions.row(skin.triangles(t, 1))) - a)
                          .cross(Vec3(skin.positions.row(skin.triangles(t, 2))) - a)
                          .normalized();
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(skin.normals.row(skin.triangles(t, c)).dot(face), 1, 1e-14);
  }
}

TEST(Skin, BluntEdgesAreSmooth) {
  const Skin skin = make_skin(cube_mesh(), {.max_edge = 0, .crease_angle = 100});
  EXPECT_EQ(skin.positions.rows(), 8);
  // Weighted by angle, the three faces at a corner count alike however they are cut into triangles.
  for (int i = 0; i < 8; ++i) {
    const Vec3 outward = (Vec3(skin.positions.row(i)) - Vec3::Constant(0.5)).normalized();
    EXPECT_NEAR(skin.normals.row(i).dot(outward), 1, 1e-12);
  }
}

TEST(Skin, NormalsThatPointInwardsAreTurned) {
  SurfaceMesh mesh = cube_mesh();
  mesh.normals.resize(8, 3);
  for (int i = 0; i < 8; ++i) {
    mesh.normals.row(i) = (mesh.positions.row(i).array() - 0.5).matrix().normalized().cast<float>() * -1;
  }
  const Skin skin = make_skin(mesh, {});
  EXPECT_EQ(skin.positions.rows(), 8);
  EXPECT_GT(skin.normals.row(7).sum(), 1.7);
}

TEST(Skin, RefiningHalvesLongEdgesWithoutGaps) {
  SurfaceMesh mesh = cube_mesh();
  mesh.uvs = mesh.positions.leftCols(2).cast<float>();
  const Skin skin = make_skin(mesh, {.max_edge = 0.13, .crease_angle = 40});
  for (int t = 0; t < skin.triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const double length =
          (skin.positions.row(skin.triangles(t, c)) - skin.positions.row(skin.triangles(t, (c + 1) % 3))).norm();
      EXPECT_LE(length, 0.13);
    }
  }
  EXPECT_NEAR(area_of(skin), 6, 1e-12);
  EXPECT_TRUE(is_closed(skin));
  EXPECT_EQ(skin.parts.at(0).triangle_count, skin.triangles.rows());
  EXPECT_LT((skin.uvs.cast<double>() - skin.positions.leftCols(2)).norm(), 1e-5);
  EXPECT_LT((skin.normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
}

class SkinInterpolation : public ::testing::Test {
 protected:
  SkinInterpolation() : grid_(make_box_grid({4, 3, 5}, 0.02)), points_(500, 3) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-0.01, 0.11);  // some of them outside every brick
    for (double& coordinate : points_.reshaped()) coordinate = anywhere(random);
    embedding_ = embed(grid_, points_);
  }

  BrickGrid grid_;
  Points points_;
  Embedding embedding_;
};

TEST_F(SkinInterpolation, RestNodesLeaveEveryPointWhereItIs) {
  EXPECT_GT(embedding_.outside, 0);
  EXPECT_LT(embedding_.outside, 500);
  EXPECT_GT(embedding_.furthest, 2);  // the box ends at 0.06 of 0.11 along y, in bricks of 0.02
  EXPECT_LT(embedding_.furthest, std::hypot(2.5, 1.5, 0.5));
  const Points at_rest = deform_points(grid_, embedding_, grid_.rest_positions());
  EXPECT_LT((at_rest - points_).cwiseAbs().maxCoeff(), 1e-15);
}

TEST_F(SkinInterpolation, RigidMotionIsFollowedRigidly) {
  const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::RowVector3d shift(0.4, -1, 3);
  const Points nodes = (grid_.rest_positions() * turn.transpose()).rowwise() + shift;
  const Points expected = (points_ * turn.transpose()).rowwise() + shift;
  EXPECT_LT((deform_points(grid_, embedding_, nodes) - expected).cwiseAbs().maxCoeff(), 1e-12);
  Points normals(points_.rows(), 3);
  normals.rowwise() = Eigen::RowVector3d(0.6, 0, 0.8);
  const Points flipped = deform_normals(grid_, embedding_, normals, nodes);
  EXPECT_LT((flipped - normals * turn.transpose()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(SkinInterpolation, NormalsFollowTheInverseTranspose) {
  Mat3 stretch;
  stretch << 2, 0.3, 0, 0, 0.5, 0.1, 0, 0, 1.5;
  const Points nodes = grid_.rest_positions() * stretch.transpose();
  Points normals(points_.rows(), 3);
  const Eigen::RowVector3d normal = Eigen::RowVector3d(1, 2, -1).normalized();
  normals.rowwise() = normal;
  const Eigen::RowVector3d expected = stretch.determinant() * (stretch.inverse().transpose() * normal.transpose());
  const Points deformed = deform_normals(grid_, embedding_, normals, nodes);
  EXPECT_LT((deformed.rowwise() - expected).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace sprung
