#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <random>
#include <set>

#include "core/bricks/voxelize.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

using test::joined;

constexpr double kCell = 5.0 / 64;  // 64 along the torus

/// Reproducible on any machine.
class Dice {
 public:
  double throw_one() { return double(random_()) / 4294967296.0; }

 private:
  std::mt19937 random_{20};
};

SurfaceMesh torus() { return test::torus_mesh(2, 0.5); }

/// Cells of one lattice whose middle is as good as inside, from the bricks of all solids.
std::set<std::array<int, 3>> full_cells(const Solids& found) {
  std::set<std::array<int, 3>> cells;
  for (const Solid& solid : found.solids) {
    const BrickGrid grid = voxelize(solid, kCell);
    const Eigen::Vector3i shift = (grid.origin / kCell).array().round().cast<int>();
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
      const Eigen::Vector3i cell = grid.cells[i] + shift;
      if (grid.fill[i] > 0.5) cells.insert({cell.x(), cell.y(), cell.z()});
    }
  }
  return cells;
}

int wrong_cells(const SurfaceMesh& damaged, const SurfaceMesh& intact) {
  const auto expected = full_cells(find_solids(intact, "intact"));
  const auto found = full_cells(find_solids(damaged, "damaged"));
  int wrong = 0;
  for (const auto& cell : expected) wrong += found.contains(cell) ? 0 : 1;
  for (const auto& cell : found) wrong += expected.contains(cell) ? 0 : 1;
  return wrong;
}

SurfaceMesh with_deleted(double share) {
  SurfaceMesh mesh = torus();
  Dice dice;
  std::vector<int> kept;
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    if (dice.throw_one() >= share) kept.push_back(t);
  }
  return test::mesh_of(mesh.positions, mesh.triangles(kept, Eigen::all));
}

/// Every triangle with corners of its own, moved by up to `reach` in each direction.
SurfaceMesh with_cracks(double reach) {
  SurfaceMesh mesh = test::unwelded(torus());
  Dice dice;
  for (double& coordinate : mesh.positions.reshaped()) coordinate += reach * (2 * dice.throw_one() - 1);
  return mesh;
}

SurfaceMesh with_flipped(double share) {
  SurfaceMesh mesh = torus();
  Dice dice;
  for (auto row : mesh.triangles.rowwise()) {
    if (dice.throw_one() < share) std::swap(row[1], row[2]);
  }
  return mesh;
}

SurfaceMesh with_strays(int count) {
  Points points(3 * count, 3);
  Triangles triangles(count, 3);
  Dice dice;
  for (int t = 0; t < count; ++t) {
    triangles.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
    const Vec3 middle(5 * dice.throw_one() - 2.5, 5 * dice.throw_one() - 2.5, dice.throw_one() - 0.5);
    for (int k = 0; k < 3; ++k) {
      points.row(3 * t + k) = middle + 0.3 * Vec3(dice.throw_one(), dice.throw_one(), dice.throw_one());
    }
  }
  return joined(torus(), test::mesh_of(points, triangles));
}

SurfaceMesh shifted_copy() {
  SurfaceMesh copy = torus();
  copy.positions.rowwise() += Eigen::RowVector3d(16 * kCell, 0, 0);
  return copy;
}

struct Damage {
  const char* name;
  std::function<SurfaceMesh()> make;
  int max_wrong;  // of 20 700 cells; a fifth more than was measured, or a few
};

void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }

class Damaged : public ::testing::TestWithParam<Damage> {};

TEST_P(Damaged, HasAlmostTheSameCells) {
  const int wrong = wrong_cells(GetParam().make(), torus());
  std::printf("%s: %d cells wrong\n", GetParam().name, wrong);
  EXPECT_LE(wrong, GetParam().max_wrong);
}

INSTANTIATE_TEST_SUITE_P(Mesh, Damaged,
                         ::testing::Values(Damage{"1 % deleted", [] { return with_deleted(0.01); }, 3},
                                           Damage{"5 % deleted", [] { return with_deleted(0.05); }, 5},
                                           Damage{"narrow cracks", [] { return with_cracks(1e-3); }, 110},
                                           Damage{"wide cracks", [] { return with_cracks(0.005); }, 420},
                                           Damage{"10 % flipped", [] { return with_flipped(0.1); }, 0},
                                           Damage{"all flipped", [] { return test::inside_out(torus()); }, 0},
                                           Damage{"doubled", [] { return joined(torus(), torus()); }, 0},
                                           Damage{"doubled and turned",
                                                  [] { return joined(torus(), test::inside_out(torus())); }, 0},
                                           Damage{"200 stray triangles", [] { return with_strays(200); }, 3}),
                         [](const auto& damage) {
                           std::string name = damage.param.name;
                           std::erase_if(
                               name, [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) == 0; });
                           return name;
                         });

TEST(Damage, TwoOverlappingCopiesAreTheirUnion) {
  auto expected = full_cells(find_solids(torus(), "one"));
  for (const auto& [x, y, z] : full_cells(find_solids(torus(), "one"))) expected.insert({x + 16, y, z});
  const Solids found = find_solids(joined(torus(), shifted_copy()), "both");
  ASSERT_EQ(found.solids.size(), 1U);
  int wrong = 0;
  const auto cells = full_cells(found);
  for (const auto& cell : expected) wrong += cells.contains(cell) ? 0 : 1;
  for (const auto& cell : cells) wrong += expected.contains(cell) ? 0 : 1;
  std::printf("two copies: %d of %zu cells wrong\n", wrong, expected.size());
  EXPECT_LE(wrong, 35) << "a cell that both fill by less than half may be more than half full";
}

}  // namespace
}  // namespace sprung
