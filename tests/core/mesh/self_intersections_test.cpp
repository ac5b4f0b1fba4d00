#include "core/mesh/query/self_intersections.h"

#include <gtest/gtest.h>

#include "core/mesh/io/read_mesh.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

using test::box_mesh;
using test::joined;

std::vector<std::array<int, 2>> crossings_of(const SurfaceMesh& mesh) {
  return find_self_intersections(mesh.positions, mesh.triangles);
}

/// Triangles with these corners, 5 points.
std::vector<std::array<int, 2>> crossings_of(const std::array<Vec3, 5>& points,
                                             std::initializer_list<Eigen::RowVector3i> rows) {
  Points positions(5, 3);
  for (int i = 0; i < 5; ++i) positions.row(i) = points[i];
  Triangles triangles(isize(rows), 3);
  int next = 0;
  for (const Eigen::RowVector3i& row : rows) triangles.row(next++) = row;
  return find_self_intersections(positions, triangles);
}

TEST(Crossings, NeighboursOfAnEmbeddedSurfaceDoNotCross) {
  EXPECT_EQ(crossings_of(box_mesh(Vec3::Zero(), Vec3::Ones())).size(), 0U);
  EXPECT_EQ(crossings_of(test::torus_mesh(1, 0.3)).size(), 0U);
}

TEST(Crossings, OfTrianglesThatShareACorner) {
  const Vec3 tip(0, 0, 0);
  const std::array<Vec3, 5> through{tip, Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(0.5, 0, -1), Vec3(0.5, 0, 1)};
  EXPECT_EQ(crossings_of(through, {{0, 1, 2}, {0, 3, 4}}).size(), 1U);
  const std::array<Vec3, 5> beside{tip, Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-0.5, 0, -1), Vec3(-0.5, 0, 1)};
  EXPECT_EQ(crossings_of(beside, {{0, 1, 2}, {0, 3, 4}}).size(), 0U);
}

TEST(Crossings, OfTrianglesFoldedOntoEachOther) {
  const std::array<Vec3, 5> points{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(0, -1, 0)};
  EXPECT_EQ(crossings_of(points, {{0, 1, 2}, {1, 0, 3}}).size(), 1U);
  EXPECT_EQ(crossings_of(points, {{0, 1, 2}, {1, 0, 4}}).size(), 0U);
}

TEST(Crossings, OfTwoBoxesThatRunIntoEachOther) {
  const SurfaceMesh apart = joined(box_mesh(Vec3::Zero(), Vec3::Ones()), box_mesh(Vec3(2, 0, 0), Vec3(3, 1, 1)));
  EXPECT_EQ(crossings_of(apart).size(), 0U);
  const SurfaceMesh through =
      joined(box_mesh(Vec3::Zero(), Vec3::Ones()), box_mesh(Vec3(0.5, 0.1, 0.2), Vec3(1.5, 0.3, 0.3)));
  const auto found = crossings_of(through);
  EXPECT_GT(found.size(), 3U);
  EXPECT_LT(found.front()[0], 12);
  EXPECT_GE(found.front()[1], 12);
}

}  // namespace
}  // namespace sprung
