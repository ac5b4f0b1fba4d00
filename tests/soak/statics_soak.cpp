// Random parts, pins and loads in statics: every case must converge to an equilibrium whose reactions carry its loads
// and which, for small displacements, is that of a direct solver, or end with a reason. Prints the cases that did
// neither, and those that took over 20 times as long as others of their size.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "core/mesh/io/read_mesh.h"
#include "core/simulation/body_loads.h"
#include "core/simulation/drivers.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/external/external_mesh.h"
#include "tests/soak/dice.h"
#include "tests/soak/trials.h"
#include "tests/support/meshes.h"

namespace sprung::test {
namespace {

using Clock = std::chrono::steady_clock;

/// The prism over the filled cells of a grid of lines, from z = 0 to `depth`; closed, outward.
SurfaceMesh prism(const std::vector<double>& xs, const std::vector<double>& ys, const std::vector<std::string>& cells,
                  double depth) {
  std::map<std::array<int, 3>, int> vertices;
  std::vector<Vec3> points;
  std::vector<Eigen::Vector3i> triangles;
  const auto vertex = [&](int x, int y, int z) {
    const auto [found, is_new] = vertices.try_emplace({x, y, z}, int(points.size()));
    if (is_new) points.emplace_back(xs[x], ys[y], z * depth);
    return found->second;
  };
  const auto quad = [&](int a, int b, int c, int d) {
    triangles.emplace_back(a, b, c);
    triangles.emplace_back(a, c, d);
  };
  const auto is_filled = [&](int x, int y) {
    return x >= 0 && y >= 0 && x + 1 < int(xs.size()) && y + 1 < int(ys.size()) && cells[y][x] == '#';
  };
  for (int y = 0; y + 1 < int(ys.size()); ++y) {
    for (int x = 0; x + 1 < int(xs.size()); ++x) {
      if (!is_filled(x, y)) continue;
      quad(vertex(x, y, 0), vertex(x, y + 1, 0), vertex(x + 1, y + 1, 0), vertex(x + 1, y, 0));
      quad(vertex(x, y, 1), vertex(x + 1, y, 1), vertex(x + 1, y + 1, 1), vertex(x, y + 1, 1));
      const auto side = [&](int ax, int ay, int bx, int by) {
        quad(vertex(ax, ay, 0), vertex(bx, by, 0), vertex(bx, by, 1), vertex(ax, ay, 1));
      };
      if (!is_filled(x, y - 1)) side(x, y, x + 1, y);
      if (!is_filled(x + 1, y)) side(x + 1, y, x + 1, y + 1);
      if (!is_filled(x, y + 1)) side(x + 1, y + 1, x, y + 1);
      if (!is_filled(x - 1, y)) side(x, y + 1, x, y);
    }
  }
  Points positions(points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i) positions.row(Eigen::Index(i)) = points[i];
  Triangles rows(triangles.size(), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) rows.row(Eigen::Index(i)) = triangles[i];
  return mesh_of(std::move(positions), std::move(rows));
}

struct Part {
  std::string name;
  SurfaceMesh mesh;
};

/// 80 x 60 x 30 and such, in mm.
Part random_part(Dice& dice) {
  const double wide = dice.between(60, 100);
  const double high = dice.between(40, 80);
  const double deep = dice.between(10, 60);
  const double wall = dice.between(3, 12);
  switch (dice.whole(0, 6)) {
    case 0:
      return {"bracket", prism({0, wall, wide}, {0, wall, high}, {"##", "#."}, deep)};
    case 1:
      return {"plate", prism({0, wide}, {0, high}, {"#"}, wall)};
    case 2:
      return {"plate with a hole",
              prism({0, 0.3 * wide, 0.6 * wide, wide}, {0, 0.4 * high, 0.7 * high, high}, {"###", "#.#", "###"}, wall)};
    case 3:
      return {"square tube",
              prism({0, wall, high - wall, high}, {0, wall, high - wall, high}, {"###", "#.#", "###"}, wide)};
    case 4:
      return {"channel", prism({0, wall, wide - wall, wide}, {0, wall, high}, {"###", "#.#"}, deep)};
    case 5:
      return {"ring", torus_mesh(wide / 2, wall, 64, 24)};
    default:
      return {"frame", prism({0, wall, 0.5 * (wide - wall), 0.5 * (wide + wall), wide - wall, wide},
                             {0, wall, high - wall, high}, {"#####", "#.#.#", "#####"}, deep)};
  }
}

Part random_mesh_of_a_file(Dice& dice) {
  static const std::array names{
      "bunny.obj",           "hand_lowres.obj", "scorpion_low_resolution.obj", "bob_small.ply", "eight.off",
      "blobby-shuffled.off", "scallop.glb",     "spot_triangulated.obj"};
  const std::string name = names[std::size_t(dice.whole(0, int(names.size()) - 1))];
  return {name, read_mesh(external_mesh(name))};
}

struct Case {
  std::string description;
  Scene scene;
};

constexpr int kMaxDirect = 20000;  // bricks, up to which a direct solver checks the solution
constexpr double kWrong = 1e-5;    // a direct solver's own rounding in slender bodies is a tenth of that

Case random_case(std::uint32_t seed, std::uint32_t index) {
  Dice dice(seed, index);
  const bool has_files = std::filesystem::exists(external_mesh("bunny.obj"));
  const Part part = has_files && dice.is_so(0.25) ? random_mesh_of_a_file(dice) : random_part(dice);
  Case made;
  Scene& scene = made.scene;
  scene.duration = 1;
  scene.solver.scheme = dice.is_so(0.5) ? Solver::kStatic : Solver::kLinear;
  scene.solver.load_steps = 1;
  SceneBody& body = scene.bodies.emplace_back();
  body.surface = std::make_shared<const SurfaceMesh>(part.mesh);
  body.size = 0.1;
  const int bricks = int(dice.log_between(10, 60.99));
  body.bricks = bricks;
  if (dice.is_so(0.3)) {
    body.brick_rotation = {dice.between(-45, 45), dice.between(-45, 45), dice.between(-45, 45)};
  }
  body.material = {.name = "random",
                   .young = dice.log_between(1e5, 1e10),
                   .poisson = dice.between(0, 0.48),
                   .density = 1000,
                   .damping = 0.02,
                   .source = {}};
  Pin pin;
  pin.name = "pin";
  const int axis = dice.whole(0, 2);
  const double sign = dice.is_so(0.5) ? 1 : -1;
  const double depth = dice.between(0.02, 0.3);
  pin.half_space = HalfSpace{.point = Vec3::Constant(sign > 0 ? 1 - depth : depth), .normal = sign * Vec3::Unit(axis)};
  body.pins.push_back(pin);
  BodyForce force;
  const double opposite = dice.between(0.02, 0.3);
  force.half_space =
      HalfSpace{.point = Vec3::Constant(sign > 0 ? opposite : 1 - opposite), .normal = -sign * Vec3::Unit(axis)};
  // Shears a cube of that size by some parts in a million to percent.
  const double strength = body.material.young * 1e-2 * dice.log_between(1e-8, 1e-4);
  force.total = strength * Vec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
  body.forces.push_back(force);
  scene.probes.push_back({.name = "held", .point = {}, .pin = "pin", .selection = {}});
  made.description = fmt::format("{}, {} bricks{}, {}, E {:.3g} Pa, nu {:.2f}, pinned at {}{} to {:.2f}, {:.3g} N",
                                 part.name, bricks, body.brick_rotation.isZero() ? "" : " askew",
                                 scene.solver.scheme == Solver::kStatic ? "static" : "linear", body.material.young,
                                 body.material.poisson, sign > 0 ? "+" : "-", "xyz"[axis], depth, force.total->norm());
  return made;
}

/// The deviation of small displacements from those of a direct solver in double precision, relative to the largest.
double error_of_displacements(const Simulation& simulation, const Scene& scene) {
  Body body = simulation.world.bodies[0];
  const Points found = body.positions - body.rest_positions;
  body.positions = body.rest_positions;
  const Loads loads = loads_and_weight(scene, simulation, 0, forced_wholes(scene, simulation.origins)[0]);
  const auto system = make_direct_solver();
  const LinearResponse direct = linear_response(body, supports_of(simulation.world.bodies[0]), loads.forces,
                                                Points::Zero(body.node_count(), 3), *system);
  return (found - direct.displacements).cwiseAbs().maxCoeff() / direct.displacements.cwiseAbs().maxCoeff();
}

struct Result {
  int bricks = 0;
  double seconds = 0;  // of the solution
  std::string reason;  // it has no equilibrium
  std::string fault;
};

Result run(const Scene& scene) {
  Result result;
  try {
    Simulation simulation = prepare_simulation(scene, Observer());
    double weight = 0;
    for (const SoftBody& body : simulation.world.bodies) {
      result.bricks += body.grid.brick_count();
      weight += body.masses.sum();
    }
    const auto start = Clock::now();
    const Recording recording = simulate(simulation, scene, Observer());
    result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (scene.solver.scheme == Solver::kLinear && simulation.world.bodies.size() == 1 && result.bricks <= kMaxDirect) {
      const double wrong = error_of_displacements(simulation, scene);
      if (!(wrong < kWrong)) result.fault = fmt::format("displacements are wrong by {:.2g} of the largest", wrong);
    }
    const Vec3 load = *scene.bodies[0].forces[0].total + weight * scene.gravity;
    const Vec3 held = recording.probes[0].samples.back().force;
    const double error = (held + load).norm() / load.norm();
    if (simulation.world.bodies.size() == 1 && !(error < 1e-6)) {
      result.fault = fmt::format("the pin holds {:.6f} of the load (off by {:.2g})", held.norm() / load.norm(), error);
    }
  } catch (const Error& error) {
    result.reason = error.what();
  }
  return result;
}

using Options = Trials;

int soak(const Options& options) {
  int failed = 0;
  int refused = 0;
  std::vector<std::pair<Result, std::string>> done;
  for (std::uint32_t index = options.first; index < options.first + options.count; ++index) {
    const Case one = random_case(options.seed, index);
    const auto start = Clock::now();
    const Result result = run(one.scene);
    const double all = std::chrono::duration<double>(Clock::now() - start).count();
    failed += result.fault.empty() ? 0 : 1;
    refused += result.reason.empty() ? 0 : 1;
    const std::string line = fmt::format("seed {} case {}: {}: {}{}; {} bricks, {:.2f} s, {:.2f} s in all",
                                         options.seed, index, one.description, result.fault,
                                         result.reason.empty() && result.fault.empty() ? "well" : result.reason,
                                         result.bricks, result.seconds, all);
    if (options.verbose || !result.fault.empty() || !result.reason.empty()) fmt::print("{}\n", line);
    std::fflush(stdout);
    if (result.reason.empty()) done.emplace_back(result, line);
  }
  // Among the ten nearest in size on each side.
  std::sort(done.begin(), done.end(), [](const auto& a, const auto& b) { return a.first.bricks < b.first.bricks; });
  for (std::size_t i = 0; i < done.size(); ++i) {
    std::vector<double> like;
    for (std::size_t k = i < 10 ? 0 : i - 10; k < std::min(done.size(), i + 11); ++k)
      like.push_back(done[k].first.seconds);
    std::nth_element(like.begin(), like.begin() + long(like.size() / 2), like.end());
    const double median = like[like.size() / 2];
    if (done[i].first.seconds <= 20 * std::max(median, 0.02)) continue;
    fmt::print("slow, {:.0f} times the median of its size: {}\n", done[i].first.seconds / median, done[i].second);
  }
  fmt::print("seed {}: {} of {} cases failed; {} have no equilibrium, as the program says\n", options.seed, failed,
             options.count, refused);
  return failed;
}

}  // namespace
}  // namespace sprung::test

int main(int argc, char** argv) {
  sprung::test::Options options;
  options.count = 100;
  CLI::App app("Finds the equilibria of random parts, and fails where a pin does not hold the load.");
  options.add_options(app, "case");
  CLI11_PARSE(app, argc, argv);
  return sprung::test::soak(options) == 0 ? 0 : 1;
}
