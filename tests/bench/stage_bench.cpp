#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

#include <cmath>
#include <optional>
#include <utility>

#include "core/body/brick_tiles.h"
#include "core/bricks/embedding.h"
#include "core/bricks/voxelize.h"
#include "tests/bench/bench_bodies.h"

namespace sprung::test {
namespace {

constexpr double kBricks = 100000;

double brick_size_of(const Solid& solid, double bricks) { return std::cbrt(solid.volume / bricks); }

void voxelisation(benchmark::State& state, const std::string& model) {
  const Solid solid = bench_solid(model);
  int bricks = 0;
  for (auto _ : state) bricks = voxelize(solid, brick_size_of(solid, kBricks)).brick_count();
  state.counters["things"] = bricks;
}

/// From bricks to a body ready to move, in fresh memory, as programs make it. Without that, bodies small enough for the
/// allocator to keep their memory would be spared the cost of obtaining it: half of the time.
void body_making(benchmark::State& state, double side) {
  const BrickGrid grid = make_box_grid(Eigen::Vector3i::Constant(int(side)), 0.01);
  const Material material{.name = "bench", .young = 1e4, .poisson = 0.3, .density = 1000, .damping = 0, .source = ""};
  std::optional<Body> body;
  for (auto _ : state) {
    state.PauseTiming();
    body.reset();
    BrickGrid own = grid;
    malloc_trim(0);
    state.ResumeTiming();
    body = make_body(std::move(own), Model::kCalibrated, material);
    benchmark::DoNotOptimize(body->masses.data());
  }
  state.counters["things"] = grid.brick_count();
}

/// Points and normals of a skin carried along with the bricks.
void skinning(benchmark::State& state, const std::string& model) {
  const Solid solid = bench_solid(model);
  const BrickGrid grid = voxelize(solid, brick_size_of(solid, kBricks));
  const Embedding embedding = embed(grid, solid.points);
  const Points nodes = grid.rest_positions();
  for (auto _ : state) {
    benchmark::DoNotOptimize(deform_points(grid, embedding, nodes).data());
    benchmark::DoNotOptimize(deform_normals(grid, embedding, solid.points, nodes).data());
  }
  state.counters["things"] = double(solid.points.rows());
}

template <class... Arguments>
void add(const std::string& name, void (*run)(benchmark::State&, Arguments...), std::decay_t<Arguments>... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) { run(state, arguments...); })
      ->UseRealTime()
      ->MinTime(0.2)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_stage_benchmarks() {
  for (const char* model : {"bear", "octopus"}) {
    add<const std::string&>(fmt::format("voxelisation/{}", model), voxelisation, model);
    add<const std::string&>(fmt::format("skinning/{}", model), skinning, model);
  }
  for (const int side : {22, 46, 100}) add<double>("make a body/" + box_name(side), body_making, side);
}

}  // namespace sprung::test
