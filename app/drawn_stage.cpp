#include "app/drawn_stage.h"

namespace sprung {

Stage stage_of(const Production& production, const Bounds& bounds) {
  Stage stage;
  for (const DrawnSkin& drawn : production.skins) {
    stage.skins.push_back(&drawn.skin);
    stage.default_colors.emplace_back(Eigen::Vector3f(drawn.color.red, drawn.color.green, drawn.color.blue) / 255.0F);
  }
  stage.has_ground = production.world.ground.has_value();
  if (stage.has_ground) stage.ground.height = production.world.ground->height;
  stage.bounds = bounds;
  return stage;
}

std::vector<SkinShape> shapes_of(const Production& production, const std::vector<Floats3>& nodes) {
  std::vector<SkinShape> shapes;
  for (std::size_t actor = 0; actor < nodes.size(); ++actor) {
    const Points positions = nodes[actor].cast<double>();
    const DrawnSkin& drawn = production.skins[actor];
    const BrickGrid& grid = production.world.actors[actor].body.grid;
    shapes.push_back({.positions = skin_positions(production, actor, positions).cast<float>(),
                      .normals = deform_normals(grid, drawn.embedding, drawn.skin.normals, positions).cast<float>()});
  }
  return shapes;
}

}  // namespace sprung
