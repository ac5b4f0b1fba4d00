#include <algorithm>

#include "app/film/film_pipeline.h"
#include "app/film/film_stage.h"
#include "app/inspect/inspection.h"
#include "render/brick_cubes.h"
#include "render/renderer.h"

namespace sprung {
namespace {

constexpr int kSide = 900;  // pixels of each half
constexpr double kHalfFull = 0.5;

const Eigen::Vector3f kSound(0.87F, 0.84F, 0.77F);
const Eigen::Vector3f kPartlyFull(0.76F, 0.73F, 0.67F);
const Eigen::Vector3f kThin(0.93F, 0.45F, 0.10F);
const Eigen::Vector3f kDivided(0.16F, 0.44F, 0.78F);
const Eigen::Vector3f kRepaired(0.60F, 0.20F, 0.55F);

/// Points spread over the triangles that close holes, n x 3.
Points cap_points(const Solid& solid) {
  constexpr int kAlong = 12;
  std::vector<Vec3> positions;
  for (Eigen::Index t = 0; t < solid.triangles.rows(); ++t) {
    if (solid.source[t] >= 0) continue;
    const Vec3 a = solid.points.row(solid.triangles(t, 0));
    const Vec3 b = solid.points.row(solid.triangles(t, 1)).transpose() - a;
    const Vec3 c = solid.points.row(solid.triangles(t, 2)).transpose() - a;
    for (int i = 0; i <= kAlong; ++i) {
      for (int j = 0; i + j <= kAlong; ++j) positions.emplace_back(a + (i * b + j * c) / kAlong);
    }
  }
  Points points(positions.size(), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) = positions[i];
  return points;
}

std::vector<Eigen::Vector3f> brick_colors(const BrickGrid& grid, const Solid& solid,
                                          const std::vector<ThinPart>& thin_parts) {
  std::vector<Eigen::Vector3f> colors;
  for (const double fill : grid.fill) colors.push_back(fill < kHalfFull ? kPartlyFull : kSound);
  for (const ThinPart& part : thin_parts) {
    for (const int brick : part.bricks) colors[brick] = kThin;
  }
  for (std::size_t i = 0; i + 1 < grid.cells.size(); ++i) {
    if (grid.cells[i] == grid.cells[i + 1]) colors[i] = colors[i + 1] = kDivided;
  }
  for (const int brick : embed(grid, cap_points(solid)).brick) colors[brick] = kRepaired;
  return colors;
}

Image draw(const std::vector<Skin>& skins, const std::vector<Eigen::Vector3f>& colors, const AlignedBox& bounds,
           const Camera& camera) {
  Stage stage;
  std::vector<SkinShape> shapes;
  for (const Skin& skin : skins) {
    stage.skins.push_back(&skin);
    shapes.push_back({skin.positions.cast<float>(), skin.normals.cast<float>()});
  }
  stage.default_colors = colors;
  stage.bounds = bounds;
  stage.ground.height = bounds.min().y();
  Renderer renderer(stage, {.width = kSide, .height = kSide, .samples = 4});
  return renderer.draw(shapes, camera);
}

}  // namespace

Image draw_bricks(const Preparation& prepared) {
  const Simulation& simulation = prepared.simulation;
  AlignedBox bounds;
  for (const SoftBody& body : simulation.world.bodies) bounds.extend(bounding_box(body.positions));
  std::vector<Skin> skins;
  std::vector<Skin> bricks;
  std::vector<Eigen::Vector3f> colors;
  std::vector<const Solid*> solids;
  for (const LoadedBody& body : prepared.bodies) {
    for (const Solid& solid : body.solids) solids.push_back(&solid);
  }
  for (std::size_t i = 0; i < simulation.world.bodies.size(); ++i) {
    const SoftBody& body = simulation.world.bodies[i];
    Skin& skin = skins.emplace_back(body.drawn.skin);
    skin.positions = body.skin_positions(body.positions);
    skin.normals = deform_normals(body.grid, body.drawn.embedding, body.drawn.skin.normals, body.positions);
    colors.push_back(srgb(body.drawn.color));
    const std::vector<bool> all(body.grid.cells.size(), true);
    const BrickCubes cubes(body.grid, all, false, brick_colors(body.grid, *solids[i], prepared.thin_parts[i]));
    bricks.push_back(with_shape(cubes.skin(), cubes.shape(body.positions)));
  }
  const Camera camera = frame_bounds(bounds, 1, 30, 20);
  return sheet_of({draw(skins, colors, bounds, camera), draw(bricks, colors, bounds, camera)}, 2, 0, 0);
}

}  // namespace sprung
