#include "app/load/part_solution.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "core/body/stress.h"
#include "core/error.h"
#include "core/simulation/simulate.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {

long PartSolution::brick_count() const {
  long count = 0;
  for (const SoftBody& body : simulation.world.bodies) count += body.grid.brick_count();
  return count;
}

Film scene_of(const LoadPart& part, const LoadCase& loads, double brick_size, bool linear) {
  Film scene;
  scene.duration = 1;
  scene.fps = 1;
  scene.gravity = loads.gravity;
  scene.solver.scheme = linear ? Solver::kLinear : Solver::kStatic;
  scene.solver.load_steps = 1;
  SceneBody& body = scene.bodies.emplace_back(part.body);
  body.bricks.reset();
  body.brick_size = brick_size;
  for (const PartFix& fix : loads.fixes) body.pins.push_back(fix.pin);
  for (const PartLoad& load : loads.loads) {
    if (load.force) body.forces.push_back(*load.force);
    if (load.movement) body.pins.push_back(*load.movement);
  }
  return scene;
}

namespace {

constexpr double kPatience = 45;     // s; the most that a grid that was not requested may be forecast to take
constexpr double kGrowthOfTime = 4;  // power of the ratio of brick sizes: somewhat more than their number

/// Each solid needs supports of its own.
void check_supported(const PartSolution& solution, const LoadPart& part) {
  const std::vector<SoftBody>& bodies = solution.simulation.world.bodies;
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    if (!solution.simulation.origins[row].pinned_skins.empty()) continue;
    const Points skin = part_from_world(solution, part, bodies[row].skin_positions(bodies[row].rest_positions));
    const Vec3 middle = part.file_from_rest(bounding_box(skin).center());
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: solid {} of {}, about ({:.4g}, {:.4g}, {:.4g}) {}, has no support: solids of a "
                    "file that touch or overlap in parts are not joined; --fix something of it, or unite them",
                    part.loaded.name, row + 1, bodies.size(), middle.x(), middle.y(), middle.z(), part.unit_name));
  }
}

}  // namespace

std::vector<PartSolution> solve_part(const LoadPart& part, const LoadCase& loads, const PartBricks& bricks, bool linear,
                                     const Observer& observer) {
  Progress progress(observer, "load", double(bricks.sizes.size()));
  std::vector<PartSolution> solutions(bricks.sizes.size());
  double seconds = 0;  // of the previous grid
  for (std::size_t done = 0; done < solutions.size(); ++done) {
    const std::size_t grid = solutions.size() - 1 - done;  // the coarsest first: it finds mistakes early
    const QuietObserver quiet(observer, grid == 0);
    PartSolution& solution = solutions[grid];
    solution.brick_size = bricks.sizes[grid];
    solution.is_linear = linear;
    const double forecast =
        done == 0 ? 0 : seconds * std::pow(bricks.sizes[grid + 1] / bricks.sizes[grid], kGrowthOfTime);
    if (bricks.is_chosen && done >= 2 && forecast > kPatience) {
      observer.note(fmt::format("bricks of {} would take some {}; the answers are of {}: --brick-size for others",
                                readable(solution.brick_size, Dimension::kLength), duration_text(forecast),
                                readable(bricks.sizes[grid + 1], Dimension::kLength)));
      solutions.erase(solutions.begin(), solutions.begin() + std::ptrdiff_t(grid) + 1);
      break;
    }
    const auto began = std::chrono::steady_clock::now();
    solution.scene = scene_of(part, loads, solution.brick_size, linear);
    solution.simulation = prepare_simulation(solution.scene, quiet);
    check_supported(solution, part);
    try {
      solution.recording = simulate(solution.simulation, solution.scene, quiet);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kFailed || done == 0) throw;
      observer.warn(fmt::format("a grid of {} could not be solved; the answers are of a coarser one of {}",
                                readable(solution.brick_size, Dimension::kLength),
                                readable(bricks.sizes[grid + 1], Dimension::kLength)));
      solutions.erase(solutions.begin(), solutions.begin() + std::ptrdiff_t(grid) + 1);
      break;
    }
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    progress.update(double(done + 1));
  }
  progress.finish(fmt::format("{} bricks, and {}", solutions.front().brick_count(),
                              count_of(long(solutions.size()) - 1, "coarser grid")));
  return solutions;
}

Points part_from_world(const PartSolution& solution, const LoadPart& part, const Points& points) {
  AlignedBox box;
  for (const SoftBody& body : solution.simulation.world.bodies) {
    box.extend(bounding_box(body.skin_positions(body.rest_positions)));
  }
  return (points.rowwise() - box.center().transpose()) * part.world_from_file;
}

StressTensors turned_back(StressTensors stresses, const Mat3& world_from_file) {
  for (auto stress : stresses.rowwise()) {
    Mat3 tensor;
    tensor << stress[0], stress[3], stress[5], stress[3], stress[1], stress[4], stress[5], stress[4], stress[2];
    const Mat3 here = world_from_file.transpose() * tensor * world_from_file;
    stress << here(0, 0), here(1, 1), here(2, 2), here(0, 1), here(1, 2), here(2, 0);
  }
  return stresses;
}

StressTensors skin_stress(const PartSolution& solution, const SoftBody& body) {
  return stress_at(body.grid, body.drawn.embedding,
                   recover_stress(body, body.positions, strain_measure(solution.scene)));
}

PartSkin skin_of(const PartSolution& solution, const LoadPart& part) {
  const std::vector<SoftBody>& bodies = solution.simulation.world.bodies;
  long count = 0;
  for (const SoftBody& body : bodies) count += body.drawn.embedding.local.rows();
  const Mat3& turned = part.world_from_file;
  PartSkin skin{.positions = Points(count, 3), .displacements = Points(count, 3), .stresses = StressTensors(count, 6)};
  long row = 0;
  for (const SoftBody& body : bodies) {
    const long rows = body.drawn.embedding.local.rows();
    const Points rest = body.skin_positions(body.rest_positions);
    const Points now = body.skin_positions(body.positions);
    skin.positions.middleRows(row, rows) = part_from_world(solution, part, rest);
    skin.displacements.middleRows(row, rows) = (now - rest) * turned;
    skin.stresses.middleRows(row, rows) = skin_stress(solution, body);
    row += rows;
  }
  skin.stresses = turned_back(std::move(skin.stresses), part.world_from_file);
  return skin;
}

}  // namespace sprung
