#include "core/simulation/simulation.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <exception>

#include "core/contact/broad_phase.h"
#include "core/contact/glue.h"
#include "core/contact/inversion_guard.h"
#include "core/contact/penetration.h"
#include "core/error.h"
#include "core/simulation/body_loads.h"
#include "core/simulation/build_bodies.h"
#include "core/simulation/observer.h"
#include "core/simulation/thin_part_error.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr double kDrawnPlane = 4;  // sizes of the largest body: half the side of a drawn plane

/// Fills all bodies concurrently. Exceptions are kept, so that the first failing body of the scene is reported.
std::vector<std::exception_ptr> fill_bodies(std::deque<BodyBuilder>& builders) {
  std::vector<std::exception_ptr> failures(builders.size());
  tbb::parallel_for(std::size_t{0}, builders.size(), [&](std::size_t i) {
    try {
      builders[i].fill_solids();
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  return failures;
}

}  // namespace

void add_bodies(const Scene& scene, std::size_t first, const std::vector<LoadedBody>& bodies, Simulation& simulation,
                const Observer& observer) {
  std::deque<BodyBuilder> builders;
  for (std::size_t i = 0; i < bodies.size(); ++i) builders.emplace_back(scene, first + i, bodies[i], simulation);
  const std::vector<std::exception_ptr> failures = fill_bodies(builders);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (failures[i]) std::rethrow_exception(failures[i]);
    builders[i].add_solids();
    builders[i].tell(observer);
    check_loads(scene, first + i, simulation.origins);
    simulation.size = std::max(simulation.size, bodies[i].extent.maxCoeff());
  }
}

Simulation build_world(const Scene& scene, const std::vector<LoadedBody>& bodies, const Observer& observer) {
  Simulation simulation;
  simulation.world.gravity = scene.gravity;
  simulation.world.bodies_collide = scene.contact.bodies;
  add_bodies(scene, 0, bodies, simulation, observer);
  simulation.obstacles = make_obstacles(scene, kDrawnPlane * simulation.size, observer);
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    simulation.world.obstacles.push_back(obstacle_between(simulation.obstacles[i], scene.obstacles[i], 0, 0));
  }
  if (!is_motion(scene)) return simulation;
  for (std::size_t i = 0; i < scene.glue.size(); ++i) glue_bodies(scene, i, simulation);
  check_start(scene, simulation, observer);
  return simulation;
}

namespace {

std::vector<LoadedBody> load_bodies(const Scene& scene, const Observer& observer) {
  Progress progress(observer, "read");
  std::vector<LoadedBody> bodies;
  long triangles = 0;
  long solids = 0;
  for (const SceneBody& body : scene.bodies) {
    const LoadedBody& loaded = bodies.emplace_back(load_body(body, observer));
    triangles += loaded.mesh.triangles.rows();
    solids += long(loaded.solids.size());
  }
  progress.finish(fmt::format("{}, {}", count_of(triangles, "triangle"), count_of(solids, "solid")));
  return bodies;
}

/// "1.2 cm", or "1.1 cm to 1.2 cm" if the bodies differ.
std::string brick_sizes(const std::vector<LoadedBody>& bodies) {
  const auto by_size = [](const LoadedBody& a, const LoadedBody& b) { return a.brick_size < b.brick_size; };
  const auto [smallest, largest] = std::minmax_element(bodies.begin(), bodies.end(), by_size);
  const std::string low = readable(smallest->brick_size, Dimension::kLength);
  const std::string high = readable(largest->brick_size, Dimension::kLength);
  return low == high ? low : fmt::format("{} to {}", low, high);
}

/// Warns once of all parts of one body's solids that are thinner than its bricks.
class ThinParts {
 public:
  ThinParts(const LoadedBody& body, Model model) : body_(body), model_(model) {}

  std::vector<ThinPart> find(const BrickGrid& grid, std::size_t solid) {
    if (solid >= body_.walls.size() || body_.solids[solid].thickness > 0) return {};  // load_body() warns of shells
    std::vector<ThinPart> parts = find_thin_parts(grid, body_.walls[solid]);
    count_ += long(parts.size());
    for (const ThinPart& part : parts) {
      bricks_ += long(part.bricks.size());
      if (thinnest_.thickness == 0 || part.thickness < thinnest_.thickness) thinnest_ = part;
    }
    return parts;
  }

  /// `is_measured`: whether the figures of the result matter, not only its look.
  void tell(bool is_measured, const Observer& observer) const {
    if (count_ > 0) return warn(observer);
    const double wall = body_.thinnest_wall();
    const double across = wall / body_.brick_size;
    if (!is_measured || model_ != Model::kCalibrated || !(wall > 0) || across >= kResolvedWall) return;
    observer.note(fmt::format(
        "{}: its thinnest walls, {}, are {:.2g} bricks thick: they bend up to {:.0f} % too little where they are "
        "curved or meet; more bricks make that less",
        body_.name, readable(wall, Dimension::kLength), across, std::ceil(100 * missing_bend(across))));
  }

 private:
  void warn(const Observer& observer) const {
    const Vec3 place = body_.file_from_rest * (body_.bricks_from_rest.transpose() * thinnest_.position);
    const bool is_known = model_ == Model::kCalibrated;
    observer.warn(fmt::format(
        "{}: {} thinner than a brick ({}), in {}: {}; the thinnest, near ({:.4g}, {:.4g}, {:.4g}) of the file, is "
        "about {} thick{}",
        body_.name, count_of(count_, "part is", "parts are"), readable(body_.brick_size, Dimension::kLength),
        count_of(bricks_, "brick"),
        is_known ? fmt::format("they bend up to {:.0f} % too little where they are curved",
                               100 * missing_bend(thinnest_.across))
                 : "stiffer and blunter than they should be",
        place.x(), place.y(), place.z(), readable(thinnest_.thickness, Dimension::kLength),
        is_known ? "" : ": bricks of that size would hold it"));
  }

  const LoadedBody& body_;
  Model model_;
  long count_ = 0;
  long bricks_ = 0;
  ThinPart thinnest_;
};

void find_thin_parts(const Scene& scene, Preparation& prepared, const Observer& observer) {
  const World& world = prepared.simulation.world;
  std::size_t soft_body = 0;
  for (std::size_t body = 0; body < prepared.bodies.size(); ++body) {
    ThinParts parts(prepared.bodies[body], scene.bodies[body].model);
    const std::size_t copies = copy_count(scene.bodies[body]);
    for (std::size_t solid = 0; solid < prepared.bodies[body].solids.size(); ++solid, soft_body += copies) {
      const std::vector<ThinPart> found = parts.find(world.bodies[soft_body].grid, solid);
      prepared.thin_parts.insert(prepared.thin_parts.end(), copies, found);
    }
    parts.tell(!is_motion(scene), observer);
  }
}

/// See assets/docs/physics.md.
void warn_of_locking(const Scene& scene, const std::vector<LoadedBody>& bodies, const Observer& observer) {
  constexpr double kMost = 0.49;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double poisson = simulated_material(scene, scene.bodies[i]).poisson;
    if (poisson <= kMost || !has_springs(scene.bodies[i].model)) continue;
    observer.warn(fmt::format(
        "{}: Poisson's ratio {:.6g}: bricks lock above {}, they bend too little; {} is nearly as hard to compress",
        bodies[i].name, poisson, kMost, kMost));
  }
}

/// Sizes and materials that suggest a forgotten unit: ten times beyond all that the library has.
void warn_of_units(const Scene& scene, const std::vector<LoadedBody>& bodies, const Observer& observer) {
  constexpr double kLarge = 5;      // m
  constexpr double kSoft = 100;     // Pa
  constexpr double kStiff = 2e12;   // Pa
  constexpr double kLight = 2.5;    // kg/m^3
  constexpr double kHeavy = 80000;  // kg/m^3
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double size = bodies[i].extent.maxCoeff();
    if (size > kLarge) {
      observer.warn(fmt::format("{}: {} long; a length without a unit is in metres, '{:.3g}cm' in centimetres",
                                bodies[i].name, readable(size, Dimension::kLength), size));
    }
    const double young = scene.bodies[i].material.young;
    if (young < kSoft) {
      observer.warn(
          fmt::format("{}: Young's modulus {}, softer than any gel; without a unit it is in pascals, "
                      "'{:.3g}kPa' in kilopascals, '{:.3g}GPa' in gigapascals",
                      bodies[i].name, readable(young, Dimension::kPressure), young, young));
    }
    if (young > kStiff) {
      observer.warn(fmt::format("{}: Young's modulus {}, stiffer than diamond; without a unit it is in pascals",
                                bodies[i].name, readable(young, Dimension::kPressure)));
    }
    const double density = scene.bodies[i].material.density;
    if (density < kLight) {
      observer.warn(
          fmt::format("{}: density {:.3g} kg/m3, lighter than any foam; without a unit it is in kg/m3, "
                      "'{:.3g}g/cm3' in grams per cubic centimetre",
                      bodies[i].name, density, density));
    }
    if (density > kHeavy) {
      observer.warn(fmt::format("{}: density {:.3g} kg/m3, heavier than any metal; without a unit it is in kg/m3",
                                bodies[i].name, density));
    }
  }
}

}  // namespace

Preparation prepare(const Scene& scene, const Observer& observer) {
  Preparation prepared;
  prepared.bodies = load_bodies(scene, observer);
  Progress progress(observer, "bricks");
  prepared.simulation = build_world(scene, prepared.bodies, observer);
  find_thin_parts(scene, prepared, observer);
  warn_of_locking(scene, prepared.bodies, observer);
  warn_of_units(scene, prepared.bodies, observer);
  int bricks = 0;
  int nodes = 0;
  double mass = 0;
  for (const SoftBody& body : prepared.simulation.world.bodies) {
    bricks += body.grid.brick_count();
    nodes += body.node_count();
    mass += body.masses.sum();
  }
  progress.finish(fmt::format("{} of {}, {} nodes, {:.4g} kg", count_of(bricks, "brick"), brick_sizes(prepared.bodies),
                              nodes, mass));
  return prepared;
}

Simulation prepare_simulation(const Scene& scene, const Observer& observer) {
  return std::move(prepare(scene, observer).simulation);
}

namespace {

constexpr double kNear = 0.5;       // of the smaller bricks
constexpr double kTouching = 1e-3;  // likewise: bodies that overlap no more only touch

std::vector<std::size_t> soft_bodies_of(const Simulation& simulation, int body) {
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < simulation.origins.size(); ++i) {
    if (simulation.origins[i].body + 1 == std::size_t(body)) bodies.push_back(i);
  }
  return bodies;
}

}  // namespace

void glue_bodies(const Scene& scene, std::size_t row, Simulation& simulation) {
  const SceneGlue& glue = scene.glue[row];
  World& world = simulation.world;
  double distance = 0;
  const std::size_t before = world.glue.size();
  for (const std::size_t a : soft_bodies_of(simulation, glue.bodies[0])) {
    for (const std::size_t b : soft_bodies_of(simulation, glue.bodies[1])) {
      if (glue.bodies[0] == glue.bodies[1] && b <= a) continue;
      const double brick = std::min(world.bodies[a].grid.brick_size, world.bodies[b].grid.brick_size);
      distance = glue.distance.value_or(kNear * brick);
      const std::vector<GluedPoint> points = glue_between(world, a, b, distance);
      world.glue.insert(world.glue.end(), points.begin(), points.end());
    }
  }
  if (world.glue.size() > before) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("glue {}: bodies {} and {} are nowhere within {} of each other; move them together or give "
                          "the glue a larger distance",
                          row + 1, glue.bodies[0], glue.bodies[1], readable(distance, Dimension::kLength)));
}

namespace {

std::string allowance(const SoftBody& body) {
  return fmt::format("may overlap it by one brick ({}) at most", readable(body.grid.brick_size, Dimension::kLength));
}

void check_obstacle(const Scene& scene, const Simulation& simulation, std::size_t body_row, std::size_t row) {
  const SoftBody& body = simulation.world.bodies[body_row];
  const Obstacle& obstacle = simulation.world.obstacles[row];
  const double depth = penetration_depth(obstacle, body);
  if (depth <= body.grid.brick_size) return;
  const std::size_t index = simulation.origins[body_row].body;
  const std::string deep = readable(depth, Dimension::kLength);
  const std::optional<double> ground = ground_height(obstacle);
  if (!ground) {
    throw Error(ErrorKind::kBadInput, fmt::format("body {} starts {} inside obstacle {}; a body {}: move one of them",
                                                  index + 1, deep, row + 1, allowance(body)));
  }
  const double y = scene.bodies[index].position.y();
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("body {} starts {} below the ground (y = {:.6g} m); a body {}: raise its position from y = "
                  "{:.6g} m to {:.6g} m or lower the ground",
                  index + 1, deep, *ground, allowance(body), y, std::abs(y + depth) < 1e-9 * depth ? 0 : y + depth));
}

/// Returns how deep (m) body `a` starts inside body `b`.
double check_pair(const Simulation& simulation, std::size_t a, std::size_t b) {
  const SoftBody& one = simulation.world.bodies[a];
  const SoftBody& other = simulation.world.bodies[b];
  const double depth = penetration_depth(other, one);
  const double allowed = std::min(one.grid.brick_size, other.grid.brick_size);
  if (depth <= allowed) return depth;
  throw Error(ErrorKind::kBadInput,
              fmt::format("body {} starts {} inside body {}; bodies may overlap by one brick ({}) at most: move them "
                          "apart, or let bodies not touch each other ([contact] bodies = false)",
                          simulation.origins[a].body + 1, readable(depth, Dimension::kLength),
                          simulation.origins[b].body + 1, readable(allowed, Dimension::kLength)));
}

/// Two bodies that start inside each other.
struct Overlap {
  int a;
  int b;
  double depth;  // m
};

void tell(const std::vector<Overlap>& overlaps, const Simulation& simulation, const Observer& observer) {
  if (overlaps.empty()) return;
  const Overlap& deepest = *std::max_element(overlaps.begin(), overlaps.end(),
                                             [](const Overlap& a, const Overlap& b) { return a.depth < b.depth; });
  const std::string others =
      overlaps.size() > 1 ? fmt::format("; {} pairs of bodies do, these the deepest", overlaps.size()) : "";
  const std::size_t one = simulation.origins[deepest.a].body + 1;
  const std::size_t other = simulation.origins[deepest.b].body + 1;
  const std::string which =
      one == other ? fmt::format("two copies of body {}", one) : fmt::format("bodies {} and {}", one, other);
  observer.note(fmt::format("{} start {} inside each other{}: contact moves them apart", which,
                            readable(deepest.depth, Dimension::kLength), others));
}

}  // namespace

void check_start(const Scene& scene, const Simulation& simulation, const Observer& observer) {
  const World& world = simulation.world;
  std::vector<AlignedBox> boxes;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    boxes.push_back(bounding_box(world.bodies[i].positions));
    for (std::size_t row = 0; row < world.obstacles.size(); ++row) check_obstacle(scene, simulation, i, row);
  }
  if (!world.bodies_collide) return;
  std::vector<Overlap> overlaps;
  for (const auto& [a, b] : overlapping_boxes(boxes)) {
    const double of_first = check_pair(simulation, a, b);
    const double depth = std::max(of_first, check_pair(simulation, b, a));
    const double brick = std::min(world.bodies[a].grid.brick_size, world.bodies[b].grid.brick_size);
    if (depth > kTouching * brick) overlaps.push_back({a, b, depth});
  }
  tell(overlaps, simulation, observer);
}

}  // namespace sprung
