#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/body/body.h"
#include "core/bricks/fill_solid.h"
#include "core/bricks/voxelize.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/bodies.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

using Inside = std::function<bool(const Vec3&)>;

/// Share of a cell inside, from 40 x 40 x 40 samples.
double share_inside(const Vec3& low, double size, const Inside& inside) {
  constexpr int kAlong = 40;
  int count = 0;
  for (int i = 0; i < kAlong * kAlong * kAlong; ++i) {
    const Vec3 place(i % kAlong + 0.5, i / kAlong % kAlong + 0.5, i / (kAlong * kAlong) + 0.5);
    count += inside(low + size / kAlong * place) ? 1 : 0;
  }
  return double(count) / (kAlong * kAlong * kAlong);
}

/// Mean difference of the fill of the bricks that the surface cuts.
double mean_error(const BrickGrid& grid, const Inside& inside) {
  double sum = 0;
  int cut = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (grid.fill[i] == 1) continue;
    const Vec3 low = grid.origin + grid.brick_size * grid.cells[i].cast<double>();
    sum += std::abs(grid.fill[i] - share_inside(low, grid.brick_size, inside));
    ++cut;
  }
  EXPECT_GT(cut, 100);
  return sum / cut;
}

TEST(Fill, OfBricksCutByATorusIsWithinOnePercentOnAverage) {
  const Solid solid = find_solids(test::torus_mesh(2, 0.7, 480, 240), "torus").solids.at(0);
  const auto in_torus = [](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 2, p.z()) < 0.7; };
  EXPECT_LT(mean_error(voxelize(solid, 0.31), in_torus), 0.01);
}

TEST(Fill, OfBricksCutByASphereIsWithinOnePercentOnAverage) {
  constexpr int kAround = 240;
  constexpr int kRows = 120;
  Points points(2 + kAround * (kRows - 1), 3);
  points.row(0) = Vec3(0, 0, -1);
  points.row(1) = Vec3(0, 0, 1);
  std::vector<Eigen::Vector3i> triangles;
  const auto at = [](int i, int row) { return 2 + (row - 1) * kAround + i % kAround; };
  for (int i = 0; i < kAround; ++i) {
    for (int row = 1; row < kRows; ++row) {
      const double a = 2 * std::numbers::pi * i / kAround;
      const double b = std::numbers::pi * row / kRows;
      points.row(at(i, row)) = Vec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b));
      if (row + 1 == kRows) continue;
      triangles.emplace_back(at(i, row), at(i + 1, row), at(i + 1, row + 1));
      triangles.emplace_back(at(i, row), at(i + 1, row + 1), at(i, row + 1));
    }
    triangles.emplace_back(0, at(i + 1, 1), at(i, 1));
    triangles.emplace_back(1, at(i, kRows - 1), at(i + 1, kRows - 1));
  }
  Triangles rows(triangles.size(), 3);
  for (Eigen::Index t = 0; t < rows.rows(); ++t) rows.row(t) = triangles[t];
  const Solid solid = find_solids(test::mesh_of(points, rows), "sphere").solids.at(0);
  EXPECT_NEAR(solid.volume, 4.0 / 3 * std::numbers::pi, 5e-3);
  EXPECT_LT(mean_error(voxelize(solid, 0.17), [](const Vec3& p) { return p.norm() < 1; }), 0.01);
}

TEST(Fill, MassIsDensityTimesTheMeshsVolume) {
  for (const double size : {0.1, 0.31, 0.6}) {
    const Solid solid = find_solids(test::torus_mesh(2, 0.7), "torus").solids.at(0);
    const Material material = test::test_material(0.3);
    const Body body = make_body(fill_solid(solid, size).grid, Model::kCalibrated, material);
    EXPECT_NEAR(body.masses.sum() / (material.density * solid.volume), 1, 1e-3) << size;
  }
}

}  // namespace
}  // namespace sprung
