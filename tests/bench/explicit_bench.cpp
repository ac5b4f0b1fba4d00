#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "core/body/forces.h"
#include "tests/bench/bench_bodies.h"
#include "tests/bench/machine_limits.h"
#include "tests/bench/spring_list.h"
#include "tests/bench/spring_rows.h"

namespace sprung::test {
namespace {

constexpr double kStep = 1e-6;  // s
constexpr double kBeta = 1e-5;  // s

struct Case {
  std::string shape;
  double bricks;
  Model model;
  bool damped;
  int threads;
};

Body body_of(const Case& test) {
  Body body = bench_body(test.shape, test.bricks, test.model);
  body.damping.beta = test.damped ? kBeta : 0;
  return body;
}

void count(benchmark::State& state, double bricks) {
  state.counters["bricks"] = bricks;
  state.counters["brick_steps"] = benchmark::Counter(bricks * double(state.iterations()), benchmark::Counter::kIsRate);
}

void explicit_step(benchmark::State& state, const Case& test) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, test.threads);
  Body body = body_of(test);
  const Eigen::VectorXd inverse_masses = body.masses.cwiseInverse();
  SpringSystem springs;
  for (auto _ : state)
    springs.move(body, {.drift = kStep, .kick = kStep, .damping = body.damping, .gravity = {0, -9.81, 0}},
                 inverse_masses);
  count(state, body.grid.brick_count());
  state.counters["bytes"] = bytes_per_brick(body);
}

void spring_list_step(benchmark::State& state, const Case& test) {
  Body body = body_of(test);
  const Eigen::VectorXd inverse_masses = body.masses.cwiseInverse();
  SpringList springs(body);
  Points forces;
  for (auto _ : state) {
    springs.forces(body, forces);
    body.velocities += kStep * (inverse_masses.asDiagonal() * forces);
    body.velocities.rowwise() += kStep * Eigen::RowVector3d(0, -9.81, 0);
    body.positions += kStep * body.velocities;
  }
  count(state, body.grid.brick_count());
}

void spring_rows_step(benchmark::State& state) {
  SpringRows rows({64, 65, 65});
  const LimitLoops loops = best_loops();
  for (auto _ : state) loops.rows(rows, kStep);
  count(state, double(rows.brick_count()));
}

void add(const char* kind, const Case& test, void (*run)(benchmark::State&, const Case&)) {
  const std::string shape = test.shape == "box" ? box_name(int(std::round(std::cbrt(test.bricks)))) : test.shape;
  benchmark::RegisterBenchmark(fmt::format("{}/{}/{}/{}/{}", kind, shape, model_name(test.model),
                                           test.damped ? "damped" : "undamped", test.threads)
                                   .c_str(),
                               [=](benchmark::State& state) { run(state, test); })
      ->UseRealTime()
      ->MinTime(0.3)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_explicit_benchmarks() {
  benchmark::RegisterBenchmark("rows/box64/springs alone/undamped/1", spring_rows_step)
      ->UseRealTime()
      ->MinTime(0.3)
      ->Unit(benchmark::kMillisecond);
  for (const Model model : {Model::kCalibrated, Model::kTensile}) {
    for (const bool damped : {false, true}) {
      if (has_springs(model)) add("list", {"box", 32.0 * 32 * 32, model, damped, 1}, spring_list_step);
      for (const int threads : {1, 2}) {
        for (const double side : {8.0, 32.0, 64.0, 128.0}) {
          add("explicit", {"box", side * side * side, model, damped, threads}, explicit_step);
        }
        for (const char* shape : {"bear", "octopus", "shell"}) {
          add("explicit", {shape, 100000, model, damped, threads}, explicit_step);
        }
      }
    }
  }
}

}  // namespace sprung::test
