// Solves the stiffness of cantilevers and of bears with pinned feet under gravity and prints a table: multigrid against
// CHOLMOD and conjugate gradients with the diagonal, two models, all in one run, so that ratios hold on a busy machine.
// Options: the bricks along the longest sides, and "--direct-up-to N" bricks (default 20 000; beyond, the direct solver
// takes minutes and gigabytes).
#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "core/dynamics/implicit/implicit_motion.h"
#include "core/dynamics/linear/stiffness.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "tests/bench/bench_bodies.h"

namespace {

using namespace sprung;

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The paper's cantilever, n x n/4 x n/4 bricks.
Body cantilever(int n, Model model) {
  return make_body(make_box_grid({n, n / 4, n / 4}, 0.4 / n), model,
                   {.name = "bench", .young = 1000, .poisson = 0.3, .density = 1, .damping = 0.02, .source = ""});
}

/// A bear at rest, with about as many bricks as that cantilever.
Body bear(int n, Model model) {
  Body body = test::bench_body("bear", n * (n / 4) * (n / 4), model);
  body.positions = body.rest_positions;
  body.velocities.setZero();
  return body;
}

struct BenchShape {
  const char* name;
  Body (*make)(int n, Model model);
  int pinned_axis;  // where the lattice is lowest along it
};
constexpr std::array kShapes{BenchShape{"cantilever", cantilever, 0}, BenchShape{"bear", bear, 1}};

constexpr std::array kModels{Model::kCalibrated, Model::kTensile};

struct SupportedBody {
  SoftBody body;
  Supports supports;
  Points loads;

  SupportedBody(const BenchShape& shape, int n, Model model)
      : body(shape.make(n, model)), supports(body.node_count()), loads(body.masses * Vec3(0, -1, 0).transpose()) {
    const std::vector<Eigen::Vector3i>& lattice = body.grid.lattice;
    int low = lattice.front()[shape.pinned_axis];
    for (const Eigen::Vector3i& place : lattice) low = std::min(low, place[shape.pinned_axis]);
    for (int node = 0; node < body.node_count(); ++node) {
      if (lattice[node][shape.pinned_axis] != low) continue;
      supports.fix(node);
      body.pinned.push_back({.node = node});
    }
  }
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // s: it did not converge

double static_solve(SupportedBody supported, LinearSolver& system) {
  const Points start = supported.body.positions;
  try {
    return seconds(
        [&] { solve_static(supported.body, supported.supports, supported.loads, start, system, {.tolerance = 1e-6}); });
  } catch (const Error&) {
    return kNone;
  }
}

/// Linearize and solve once.
double linear_solve(const SupportedBody& supported, LinearSolver& system, double tolerance) {
  const StepTerms none;
  const Eigen::Map<const Eigen::VectorXd> forces(supported.loads.data(), supported.loads.size());
  bool is_solved = false;
  const double time = seconds([&] {
    is_solved =
        system.linearize(supported.body, supported.supports, false, none) && system.solve(forces, tolerance).size() > 0;
  });
  return is_solved ? time : kNone;
}

double diagonal_solve(const SupportedBody& supported) {
  const FreeDofs dofs(supported.supports);
  const Eigen::Map<const Eigen::VectorXd> forces(supported.loads.data(), supported.loads.size());
  return seconds([&] {
    const Eigen::SparseMatrix<double> matrix = stiffness_matrix(supported.body, dofs, false, {});
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower> solver(matrix);
    solver.setTolerance(1e-6);
    if (solver.solve(dofs.gather(forces)).size() == 0) std::abort();
  });
}

/// The time of the second of two steps, and its number of Newton iterations.
std::pair<double, long> implicit_step(SupportedBody supported) {
  World world;
  world.bodies.push_back(std::move(supported.body));
  world.gravity = {0, -1, 0};
  ImplicitMotion motion(world, {});
  motion.advance(0.01, 1, 0);
  const long before = motion.report().newton_iterations;
  const double time = seconds([&] { motion.advance(0.01, 1, 0.01); });
  return {time, motion.report().newton_iterations - before};
}

void print_row(const char* name, const SupportedBody& body, int direct_up_to) {
  const int bricks = body.body.grid.brick_count();
  const double linear = linear_solve(body, *make_multigrid_solver(), 1e-6);
  const double still = static_solve(body, *make_multigrid_solver());
  const auto [step, iterations] = implicit_step(body);
  const bool has_direct = bricks <= direct_up_to;
  const double direct = has_direct ? linear_solve(body, *make_direct_solver(), 0) : kNone;
  const double still_direct = has_direct ? static_solve(body, *make_direct_solver()) : kNone;
  const auto time = [](double value) { return std::isnan(value) ? "-" : fmt::format("{:.3g}", value); };
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", name, model_name(body.body.model), bricks,
             time(linear), time(direct), time(diagonal_solve(body)), time(still), time(still_direct), time(step),
             iterations);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  int direct_up_to = 20000;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--direct-up-to" && i + 1 < argc) {
      direct_up_to = std::atoi(argv[++i]);
    } else {
      const int size = std::atoi(argv[i]);
      if (size < 4 || size % 4 != 0) {
        fmt::print(stderr, "{}: what is '{}'? Bricks along the longest side: multiples of 4\n", argv[0], argv[i]);
        return 2;
      }
      sizes.push_back(size);
    }
  }
  if (sizes.empty()) sizes = {32, 64, 128};
  fmt::print(
      "| body | model | bricks | linear, s | CHOLMOD, s | diagonal CG, s | static to 1e-6, s | CHOLMOD, s "
      "| implicit step, s | Newton iterations |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const BenchShape& shape : kShapes) {
    for (const int n : sizes) {
      for (const Model model : kModels) print_row(shape.name, SupportedBody(shape, n, model), direct_up_to);
    }
  }
}
