// Independent check of the bricks: CGAL's exact point-in-solid test.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "core/bricks/voxelize.h"
#include "core/mesh/io/read_mesh.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"

namespace sprung {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Cell = std::tuple<int, int, int>;

Mesh cgal_mesh(const Solid& solid) {
  std::vector<Kernel::Point_3> points;
  points.reserve(solid.points.rows());
  std::vector<std::vector<std::size_t>> faces;
  for (int p = 0; p < solid.points.rows(); ++p) {
    points.emplace_back(solid.points(p, 0), solid.points(p, 1), solid.points(p, 2));
  }
  for (int t = 0; t < solid.triangles.rows(); ++t) {
    auto& face = faces.emplace_back();
    for (int k = 0; k < 3; ++k) face.push_back(solid.triangles(t, k));
  }
  Mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, faces, mesh);
  return mesh;
}

/// Every cell of the box: a full brick's centre is inside, the centre of a cell without brick outside.
void expect_agreement(const Solid& solid, int bricks) {
  const Vec3 extent = (solid.points.colwise().maxCoeff() - solid.points.colwise().minCoeff()).transpose();
  const BrickGrid grid = voxelize(solid, extent.maxCoeff() / bricks);
  std::set<Cell> full;
  std::set<Cell> touched;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const Cell cell{grid.cells[i].x(), grid.cells[i].y(), grid.cells[i].z()};
    touched.insert(cell);
    if (grid.fill[i] == 1) full.insert(cell);
  }
  const Mesh mesh = cgal_mesh(solid);
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side_of(mesh);
  const Eigen::Vector3i counts = (extent / grid.brick_size).array().ceil().cast<int>();
  int wrong = 0;
  for (int z = 0; z < counts.z(); ++z) {
    for (int y = 0; y < counts.y(); ++y) {
      for (int x = 0; x < counts.x(); ++x) {
        const Vec3 centre = grid.origin + grid.brick_size * Vec3(x + 0.5, y + 0.5, z + 0.5);
        const bool inside = side_of({centre.x(), centre.y(), centre.z()}) == CGAL::ON_BOUNDED_SIDE;
        if (full.contains({x, y, z}) && !inside) ++wrong;
        if (!touched.contains({x, y, z}) && inside) ++wrong;
      }
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << counts.prod() << " cells";
  EXPECT_GT(full.size(), touched.size() / 20);
}

TEST(BricksOracle, AgreesOnATorus) {
  expect_agreement(find_solids(test::torus_mesh(2, 0.6), "torus").solids.at(0), 32);
}

class BricksOracleModels : public ::testing::TestWithParam<const char*> {};

TEST_P(BricksOracleModels, Agrees) {
  const auto file = test::model(GetParam());
  expect_agreement(find_solids(read_mesh(file), GetParam()).solids.at(0), 32);
}

INSTANTIATE_TEST_SUITE_P(All, BricksOracleModels,
                         ::testing::Values("octopus.ply", "bear.ply", "knot.ply", "torus.ply", "gripper.ply",
                                           "wheel.ply"));

}  // namespace
}  // namespace sprung
