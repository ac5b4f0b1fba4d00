#include "tests/bench/bench_bodies.h"

#include <cmath>
#include <random>
#include <vector>

#include "core/body/brick_model.h"
#include "core/body/brick_tiles.h"
#include "core/bricks/fill_solid.h"
#include "core/bricks/voxelize.h"
#include "core/mesh/io/read_mesh.h"

namespace sprung::test {
namespace {

constexpr double kBrickSize = 0.01;  // m

BrickGrid ball_shell(double bricks) {
  const double thickness = 2;
  const double radius = std::sqrt(bricks / (4 * std::numbers::pi * thickness));
  const int reach = int(std::ceil(radius + thickness));
  BrickGrid grid;
  grid.brick_size = kBrickSize;
  for (int z = -reach; z < reach; ++z) {
    for (int y = -reach; y < reach; ++y) {
      for (int x = -reach; x < reach; ++x) {
        const double distance = (Eigen::Vector3d(x, y, z).array() + 0.5).matrix().norm();
        if (std::abs(distance - radius) < thickness / 2) grid.cells.emplace_back(x, y, z);
      }
    }
  }
  grid.fill.assign(grid.cells.size(), 1.0);
  number_nodes(grid);
  return grid;
}

/// A model in that many bricks, scaled to the usual brick.
BrickGrid model_grid(const std::string& model, double bricks, BricksFor law) {
  const Solid solid = bench_solid(model);
  const double brick_size = std::cbrt(solid.volume / bricks);
  BrickGrid grid = law == BricksFor::kFill ? voxelize(solid, brick_size) : fill_solid(solid, brick_size, law).grid;
  grid.origin *= kBrickSize / grid.brick_size;
  grid.brick_size = kBrickSize;
  return grid;
}

BrickGrid grid_of(const std::string& shape, double bricks, BricksFor law) {
  if (shape == "box") return make_box_grid(Eigen::Vector3i::Constant(int(std::round(std::cbrt(bricks)))), kBrickSize);
  if (shape == "shell") return ball_shell(bricks);
  return model_grid(shape, bricks, law);
}

template <class T>
double size_of(const std::vector<T>& values) {
  return double(values.capacity() * sizeof(T));
}

double size_of(const BrickTiles& tiles) {
  double sum = size_of(tiles.tiles) + size_of(tiles.shared) + size_of(tiles.parts);
  for (const BrickTile& tile : tiles.tiles) {
    sum += size_of(tile.runs) + size_of(tile.first_run) + size_of(tile.shares) + size_of(tile.packs);
  }
  const GatheredBricks& gathered = tiles.gathered;
  sum += size_of(gathered.numbers) + size_of(gathered.packs) + size_of(gathered.corners) +
         size_of(gathered.first_force) + size_of(gathered.force_places);
  const std::size_t forces = kGatheredForces * gathered.packs.size();
  return sum + double((tiles.shared_size + kScratchSize + forces) * sizeof(double));
}

}  // namespace

std::string box_name(int side) { return "box" + std::to_string(side); }

Solid bench_solid(const std::string& model) {
  const std::string file = std::string(SPRUNG_MODELS) + "/" + model + ".ply";
  SurfaceMesh mesh = read_mesh(file);
  mesh.positions /= (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).maxCoeff();
  return find_solids(mesh, file).solids.front();
}

Body bench_body(const std::string& shape, double bricks, Model model) {
  const Material material{.name = "bench", .young = 1e4, .poisson = 0.3, .density = 1000, .damping = 0, .source = ""};
  Body body = make_body(grid_of(shape, bricks, bricks_for(model)), model, material);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-0.01, 0.01);
  for (double& coordinate : body.positions.reshaped()) coordinate += part(random) * kBrickSize;
  for (double& velocity : body.velocities.reshaped()) velocity = part(random);
  return body;
}

double bytes_per_brick(const Body& body) {
  const BrickGrid& grid = body.grid;
  const double arrays = size_of(grid.cells) + size_of(grid.fill) + size_of(grid.nodes) + size_of(grid.lattice) +
                        size_of(body.stiffness_scale);
  // Rest positions, positions and velocities; masses, and their inverses while it moves.
  const double state = double(body.node_count()) * (3 * 3 + 2) * sizeof(double);
  return (arrays + state + size_of(*body.tiles)) / double(grid.cells.size());
}

}  // namespace sprung::test
