// Times finding the solid of a mesh of 2 million triangles and filling it with bricks, at 32 to 256 cells along its
// longest side: `build/release/large_mesh`.
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <ctime>

#include "core/bricks/voxelize.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/meshes.h"

namespace {

struct Clock {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::clock_t processor = std::clock();

  [[nodiscard]] std::string elapsed() const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    return fmt::format("{:8.2f} s {:8.2f} s of processor", wall.count(),
                       double(std::clock() - processor) / CLOCKS_PER_SEC);
  }
};

double gigabytes_at_most() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / (1 << 20);
}

}  // namespace

int main() {
  using namespace sprung;
  const SurfaceMesh mesh = test::torus_mesh(2, 0.7, 1440, 720);
  const Clock repair;
  const Solids found = find_solids(mesh, "torus");
  fmt::print("{} triangles; solids found in {}\n", mesh.triangles.rows(), repair.elapsed());
  for (const int cells : {32, 64, 128, 256}) {
    const Clock clock;
    const BrickGrid grid = voxelize(found.solids.at(0), 5.4 / cells);
    fmt::print("{:4} cells: {:9} bricks {}, {:.2f} GB at most so far\n", cells, grid.brick_count(), clock.elapsed(),
               gigabytes_at_most());
  }
  return 0;
}
