#include "app/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace sprung {
namespace {

/// What of a material may differ within a body.
struct Stuff {
  double young = 0;    // Pa
  double density = 0;  // kg/m^3
};

/// A brick's law depends on its Poisson's ratio in many constants, on its stiffness in one factor.
void check_ratio(const Material& material, const Material& body) {
  if (material.poisson == body.poisson) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("a region has the Poisson's ratio {}, its body {}: the materials of one body may differ in "
                          "stiffness and density only; give both the same ratio",
                          material.poisson, body.poisson));
}

/// The material of a region at a place.
Stuff stuff_at(const Region& region, const Selector& selector, const Vec3& place) {
  const Material& first = region.material;
  if (!region.gradient) return {.young = first.young, .density = first.density};
  const Material& second = region.gradient->material;
  const Vec3 from = selector.place_of(region.gradient->from);
  const Vec3 way = selector.place_of(region.gradient->to) - from;
  const double share = std::clamp(way.dot(place - from) / way.squaredNorm(), 0.0, 1.0);
  return {.young = std::lerp(first.young, second.young, share),
          .density = std::lerp(first.density, second.density, share)};
}

}  // namespace

std::vector<int> apply_regions(const std::vector<Region>& regions, const Selector& selector, Body& body,
                               std::size_t solid) {
  std::vector<int> regions_of_bricks(body.grid.cells.size(), 0);
  if (regions.empty()) return regions_of_bricks;
  const Points middles = brick_middles(body.grid);
  std::vector<Stuff> filled(body.grid.cells.size());
  for (std::size_t row = 0; row < regions.size(); ++row) {
    const Region& region = regions[row];
    check_ratio(region.material, body.material);
    if (region.gradient) check_ratio(region.gradient->material, body.material);
    for (const int brick : selector.bricks(region, body.grid, solid)) {
      filled[brick] = stuff_at(region, selector, middles.row(brick));
      regions_of_bricks[brick] = int(row) + 1;
    }
  }
  const double corner_mass = body.material.density * body.grid.brick_volume() / 8;
  for (std::size_t brick = 0; brick < filled.size(); ++brick) {
    if (regions_of_bricks[brick] == 0) continue;
    const double more_mass = (filled[brick].density / body.material.density - 1) * corner_mass;
    for (const int node : body.grid.nodes[brick]) body.masses[node] += more_mass * body.stiffness_scale[brick];
    body.stiffness_scale[brick] *= filled[brick].young / body.material.young;
  }
  build_tiles(body);
  return regions_of_bricks;
}

}  // namespace sprung
