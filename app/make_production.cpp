#include "app/make_production.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/progress.h"
#include "app/units.h"
#include "core/text.h"

namespace sprung {
namespace {

std::vector<LoadedBody> load_bodies(const Scene& scene, const Console& console) {
  Progress progress(console, "read");
  std::vector<LoadedBody> bodies;
  long triangles = 0;
  long solids = 0;
  for (const SceneBody& body : scene.bodies) {
    const LoadedBody& loaded = bodies.emplace_back(load_body(body, console));
    triangles += loaded.mesh.triangles.rows();
    solids += long(loaded.solids.size());
  }
  progress.finish(fmt::format("{}, {}", count_of(triangles, "triangle"), count_of(solids, "solid")));
  return bodies;
}

/// "1.2 cm", or "1.1 cm to 1.2 cm" where the bodies differ.
std::string brick_sizes(const std::vector<LoadedBody>& bodies) {
  const auto by_size = [](const LoadedBody& a, const LoadedBody& b) { return a.brick_size < b.brick_size; };
  const auto [smallest, largest] = std::minmax_element(bodies.begin(), bodies.end(), by_size);
  const std::string low = readable(smallest->brick_size, Dimension::kLength);
  const std::string high = readable(largest->brick_size, Dimension::kLength);
  return low == high ? low : fmt::format("{} to {}", low, high);
}

/// Which parts of the solids of one body are thinner than its bricks; one warning for all.
class ThinParts {
 public:
  explicit ThinParts(const LoadedBody& body) : body_(body) {}

  std::vector<ThinPart> find(const BrickGrid& grid, std::size_t solid) {
    if (solid >= body_.walls.size() || body_.solids[solid].thickness > 0) return {};  // of shells load_body() warns
    std::vector<ThinPart> parts = find_thin_parts(grid, body_.walls[solid]);
    count_ += long(parts.size());
    for (const ThinPart& part : parts) {
      bricks_ += long(part.bricks.size());
      if (thinnest_.thickness == 0 || part.thickness < thinnest_.thickness) thinnest_ = part;
    }
    return parts;
  }

  void warn(const Console& console) const {
    if (count_ == 0) return;
    const Vec3 place = body_.file_from_rest * (body_.bricks_from_rest.transpose() * thinnest_.place);
    console.warn(fmt::format(
        "{}: {} thinner than a brick ({}), in {}: stiffer and blunter than they should be; the thinnest, near ({:.4g}, "
        "{:.4g}, {:.4g}) of the file, is about {} thick: bricks of that size would hold it",
        body_.name, count_of(count_, "part is", "parts are"), readable(body_.brick_size, Dimension::kLength),
        count_of(bricks_, "brick"), place.x(), place.y(), place.z(),
        readable(thinnest_.thickness, Dimension::kLength)));
  }

 private:
  const LoadedBody& body_;
  long count_ = 0;
  long bricks_ = 0;
  ThinPart thinnest_;
};

void find_thin_parts(const Scene& scene, Preparation& prepared, const Console& console) {
  const World& world = prepared.production.world;
  std::size_t actor = 0;
  for (std::size_t body = 0; body < prepared.bodies.size(); ++body) {
    ThinParts parts(prepared.bodies[body]);
    const std::size_t copies = copy_count(scene.bodies[body]);
    for (std::size_t solid = 0; solid < prepared.bodies[body].solids.size(); ++solid, actor += copies) {
      const std::vector<ThinPart> found = parts.find(world.actors[actor].body.grid, solid);
      prepared.thin_parts.insert(prepared.thin_parts.end(), copies, found);
    }
    parts.warn(console);
  }
}

/// See assets/docs/physics.md.
void warn_of_locking(const Scene& scene, const std::vector<LoadedBody>& bodies, const Console& console) {
  constexpr double kMost = 0.49;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double poisson = scene.bodies[i].material.poisson;
    if (poisson <= kMost || scene.bodies[i].model == Model::kFem) continue;
    console.warn(fmt::format(
        "{}: Poisson's ratio {:.6g}: bricks lock above {}, they bend too little; {} is nearly as hard to compress",
        bodies[i].name, poisson, kMost, kMost));
  }
}

/// Sizes and stiffnesses that are rather numbers whose unit was forgotten.
void warn_of_units(const Scene& scene, const std::vector<LoadedBody>& bodies, const Console& console) {
  constexpr double kLarge = 5;   // m
  constexpr double kSoft = 100;  // Pa
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double size = bodies[i].extent.maxCoeff();
    if (size > kLarge) {
      console.warn(fmt::format("{}: {} long; a length without a unit is in metres, '{:.3g}cm' in centimetres",
                               bodies[i].name, readable(size, Dimension::kLength), size));
    }
    const double young = scene.bodies[i].material.young;
    if (young < kSoft) {
      console.warn(
          fmt::format("{}: Young's modulus {}, softer than any gel; without a unit it is in pascals, "
                      "'{:.3g}kPa' in kilopascals",
                      bodies[i].name, readable(young, Dimension::kPressure), young));
    }
  }
}

}  // namespace

Preparation prepare(const Scene& scene, const Console& console) {
  Preparation prepared;
  prepared.bodies = load_bodies(scene, console);
  Progress progress(console, "bricks");
  prepared.production = build_world(scene, prepared.bodies, console);
  find_thin_parts(scene, prepared, console);
  warn_of_locking(scene, prepared.bodies, console);
  warn_of_units(scene, prepared.bodies, console);
  int bricks = 0;
  int nodes = 0;
  double mass = 0;
  for (const Actor& actor : prepared.production.world.actors) {
    bricks += actor.body.grid.brick_count();
    nodes += actor.body.node_count();
    mass += actor.body.masses.sum();
  }
  progress.finish(fmt::format("{} of {}, {} nodes, {:.4g} kg", count_of(bricks, "brick"), brick_sizes(prepared.bodies),
                              nodes, mass));
  return prepared;
}

Production make_production(const Scene& scene, const Console& console) {
  return std::move(prepare(scene, console).production);
}

}  // namespace sprung
