#include "core/skin/skin.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

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

/// A square of 1 m seen from +z with 45 degree bevels, 1 cm wide, all around.
SurfaceMesh bevelled_square(double angle) {
  const double drop = 0.01 * std::tan(angle * std::numbers::pi / 180);
  SurfaceMesh mesh;
  mesh.positions.resize(9, 3);
  mesh.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -0.01, -0.01, -drop, 1.01, -0.01, -drop, 1.01, 1.01, -drop,
      -0.01, 1.01, -drop, 0.5, 0.5, 0;
  mesh.triangles.resize(12, 3);
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    mesh.triangles.row(3 * i) << i, next, 8;
    mesh.triangles.row(3 * i + 1) << i, 4 + i, next;
    mesh.triangles.row(3 * i + 2) << next, 4 + i, 4 + next;
  }
  return mesh;
}

/// The lengths of edges of one triangle only, m.
double border_of(const Skin& skin) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& corners : skin.triangles.rowwise()) {
    for (int c = 0; c < 3; ++c) ++uses[std::minmax({corners[c], corners[(c + 1) % 3]})];
  }
  double length = 0;
  for (const auto& [edge, count] : uses) {
    if (count == 1) length += (skin.positions.row(edge.first) - skin.positions.row(edge.second)).norm();
  }
  return length;
}

/// Bevels are slivers, and their neighbours wide: both are cut at the same points, and the slivers into hardly more
/// triangles than a strip has.
TEST(Skin, RefiningDoesWithoutParts) {
  Skin with_parts = make_skin(cube_mesh(), {.max_edge = 0, .crease_angle = 40});
  Skin without = with_parts;
  without.parts.clear();
  refine(with_parts, 0.3);
  refine(without, 0.3);
  EXPECT_GT(without.triangles.rows(), 12);
  EXPECT_EQ(without.triangles, with_parts.triangles);
  EXPECT_EQ(without.positions, with_parts.positions);
  EXPECT_TRUE(without.parts.empty());
}

TEST(Skin, RefiningCutsSliversAcross) {
  SurfaceMesh mesh = bevelled_square(45);
  mesh.parts = {{.name = "all", .first_triangle = 0, .triangle_count = 12}};
  Skin skin = make_skin(mesh, {.max_edge = 1e9, .crease_angle = 10});
  // With one vertex per position, since creases have vertices of their own.
  Skin whole = make_skin(mesh, {.max_edge = 1e9, .crease_angle = 180});
  const double area = area_of(whole);
  const double border = border_of(whole);
  refine(whole, 0.04);
  EXPECT_NEAR(area_of(whole), area, 1e-12);
  EXPECT_NEAR(border_of(whole), border, 1e-9);
  refine(skin, 0.04);
  int in_bevels = 0;
  for (const auto& corners : skin.triangles.rowwise()) {
    const Vec3 middle = skin.positions(corners, Eigen::all).colwise().mean();
    in_bevels += middle.z() < -1e-9 ? 1 : 0;
  }
  EXPECT_GT(in_bevels, 4 * 2 * 1 / 0.04 * 0.99);
  EXPECT_LT(in_bevels, 4 * 2 * 1 / 0.02 * 2);
}

TEST(Skin, SmoothSkinsKeepFlatFacesFlat) {
  for (const double angle : {20.0, 45.0}) {
    SCOPED_TRACE(angle);
    const Skin skin = make_skin(bevelled_square(angle), {.is_smooth = true});
    for (int i = 0; i < 4; ++i) {
      for (int c = 0; c < 3; ++c) EXPECT_GT(skin.normals(skin.triangles(3 * i, c), 2), 0.9999);
    }
    EXPECT_EQ(skin.positions.rows() > 9, angle > 35);
  }
}

SurfaceMesh mesh_of(const Points& positions, const Triangles& triangles) {
  SurfaceMesh mesh;
  mesh.positions = positions;
  mesh.triangles = triangles;
  mesh.parts.push_back({.name = "all", .first_triangle = 0, .triangle_count = int(triangles.rows())});
  return mesh;
}

/// Its vertices are on the unit sphere.
SurfaceMesh icosahedron() {
  const double g = std::numbers::phi;
  Points positions(12, 3);
  positions << -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0, 0, -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, g, 0, -1, g, 0, 1, -g, 0,
      -1, -g, 0, 1;
  positions.rowwise().normalize();
  Triangles triangles(20, 3);
  triangles << 0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3, 9,
      4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1;
  return mesh_of(positions, triangles);
}

/// Along z from 0 to 1, radius 1, flat ends. Three sides: a prism.
SurfaceMesh cylinder(int sides) {
  Points positions(2 * sides, 3);
  Triangles triangles(4 * sides - 4, 3);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    const int next = (i + 1) % sides;
    positions.row(i) << std::cos(angle), std::sin(angle), 0;
    positions.row(sides + i) << std::cos(angle), std::sin(angle), 1;
    triangles.row(2 * i) << i, next, sides + next;
    triangles.row(2 * i + 1) << i, sides + next, sides + i;
  }
  for (int i = 2; i < sides; ++i) {
    triangles.row(2 * sides + 2 * i - 4) << 0, i, i - 1;
    triangles.row(2 * sides + 2 * i - 3) << sides, sides + i - 1, sides + i;
  }
  return mesh_of(positions, triangles);
}

/// A smooth skin of a coarse mesh.
Skin curved(const SurfaceMesh& mesh, double tolerance) {
  Skin skin = make_skin(mesh, {});
  refine_curves(skin, tolerance);
  return skin;
}

TEST(Skin, SmoothSkinsIgnoreNormalsOfTriangles) {
  const Skin facets = make_skin(icosahedron(), {.crease_angle = 1});
  SurfaceMesh mesh = mesh_of(facets.positions, facets.triangles);
  mesh.normals = facets.normals.cast<float>();
  const auto turn = [&](bool is_smooth) {  // largest between a normal and the sphere's
    const Skin skin = make_skin(mesh, {.is_smooth = is_smooth});
    return (skin.normals - skin.positions).rowwise().norm().maxCoeff();
  };
  EXPECT_GT(turn(false), 0.5);
  EXPECT_LT(turn(true), 1e-6);
}

TEST(RefineCurves, MakesASphereOfAnIcosahedron) {
  const Skin skin = curved(icosahedron(), 1e-3);
  EXPECT_GT(skin.triangles.rows(), 20 * 64);
  EXPECT_EQ(skin.parts.at(0).triangle_count, skin.triangles.rows());
  EXPECT_TRUE(is_closed(skin));
  EXPECT_LT((skin.positions.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);  // arcs of circles are exact
  EXPECT_LT((skin.normals - skin.positions).rowwise().norm().maxCoeff(), 1e-12);
}

TEST(RefineCurves, LeavesWhatIsFlat) {
  const Skin skin = curved(cylinder(4), 1e-6);
  EXPECT_EQ(skin.triangles.rows(), 12);
  EXPECT_EQ(skin.positions.rows(), 24);
}

TEST(RefineCurves, LeavesBlocksOfFewSides) {
  for (const int sides : {6, 8}) {
    Skin skin = make_skin(cylinder(sides), {.is_smooth = true});
    refine_curves(skin, 1e-6);
    EXPECT_EQ(skin.triangles.rows(), 4 * sides - 4);
  }
}

/// Some files contain such normals.
TEST(RefineCurves, LeavesEdgesWhoseNormalsAreNoNumbersStraight) {
  Skin skin = make_skin(icosahedron(), {.is_smooth = true});
  skin.normals.setConstant(std::numeric_limits<double>::quiet_NaN());
  refine_curves(skin, 1e-3);
  EXPECT_EQ(skin.triangles.rows(), 20);
  skin.positions.setConstant(std::numeric_limits<double>::quiet_NaN());
  refine(skin, 0.1);
  EXPECT_EQ(skin.triangles.rows(), 20);
}

TEST(RefineCurves, LeavesShortEdges) {
  const Skin skin = curved(icosahedron(), 0.04);
  EXPECT_EQ(skin.triangles.rows(), 20);
}

TEST(RefineCurves, RoundsTheRimOfACylinderAndKeepsItsEndsFlat) {
  const Skin skin = curved(cylinder(12), 2e-4);
  EXPECT_TRUE(is_closed(skin));
  for (int i = 0; i < skin.positions.rows(); ++i) {
    const Vec3 point = skin.positions.row(i);
    const Vec3 normal = skin.normals.row(i);
    EXPECT_GE(point.z(), -1e-12);
    EXPECT_LE(point.z(), 1 + 1e-12);
    if (std::abs(normal.z()) < 0.5) {
      EXPECT_NEAR(point.head<2>().norm(), 1, 2e-3);  // of the polygon: 0.034; diagonals of the sides are ellipses
      EXPECT_NEAR(normal.head<2>().dot(point.head<2>().normalized()), 1, 1e-3);
    } else {
      EXPECT_NEAR(point.z(), normal.z() > 0 ? 1 : 0, 1e-12);
      EXPECT_NEAR(std::abs(normal.z()), 1, 1e-12);
    }
  }
}

TEST(RefineCurves, OpensNoGapsInARoughMesh) {
  const Skin fine = curved(icosahedron(), 0.01);
  SurfaceMesh mesh = mesh_of(fine.positions, fine.triangles);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.12, 0.12);  // enough for creases here and there
  for (double& coordinate : mesh.positions.reshaped()) coordinate += shift(random);
  const Skin skin = curved(mesh, 1e-3);
  EXPECT_GT(skin.triangles.rows(), 4 * mesh.triangles.rows());
  EXPECT_TRUE(is_closed(skin));
  EXPECT_LT((skin.normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
  const Skin again = curved(mesh, 1e-3);
  EXPECT_EQ(again.positions, skin.positions);
  EXPECT_EQ(again.triangles, skin.triangles);
}

TEST(RefineCurves, InterpolatesColoursAndUvs) {
  SurfaceMesh mesh = icosahedron();
  mesh.uvs = mesh.positions.leftCols<2>().cast<float>();
  mesh.colors = Floats4::Constant(12, 4, 0.5F);
  const Skin skin = curved(mesh, 0.01);
  ASSERT_EQ(skin.uvs.rows(), skin.positions.rows());
  EXPECT_NEAR(skin.uvs.cwiseAbs().maxCoeff(), mesh.uvs.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_TRUE((skin.colors.array() == 0.5F).all());
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
