// A mesh, a material, 100 steps, a picture: drop MESH PICTURE.png. Build it with the CMakeLists.txt beside it.
#include <sprung/core/dynamics/explicit/integrator.h>
#include <sprung/core/law/material.h>
#include <sprung/core/mesh/io/read_mesh.h>
#include <sprung/core/simulation/soft_body.h>
#include <sprung/render/image/png.h>
#include <sprung/render/renderer.h>

int main(int count, char** words) {
  using namespace sprung;
  if (count != 3) return 2;
  const Material rubber{.name = "soft rubber", .young = 200e3, .poisson = 0.45, .density = 950, .damping = 0.03};
  // The largest of the mesh's solids.
  SoftBody body = fill_mesh(read_mesh(words[1]), words[1], {.material = rubber, .bricks = 16}).front();
  body.actor.body.velocities.col(1).setConstant(-2);  // m/s, into the ground
  World world{.actors = {body.actor}, .obstacles = {level_ground(0)}};
  advance(world, Scheme::kSymplecticEuler, stable_step(world), 100, 0);

  const auto& [actor, skin, embedding] = body;
  const Points& nodes = world.actors[0].body.positions;
  const Points positions = deform_points(actor.body.grid, embedding, nodes);
  const Points normals = deform_normals(actor.body.grid, embedding, skin.normals, nodes);
  const SkinShape shape{positions.cast<float>(), normals.cast<float>()};
  Stage stage{.skins = {&skin}, .default_colors = {{0.85F, 0.2F, 0.16F}}};
  stage.bounds.include(positions);
  Renderer renderer(stage, {.width = 640, .height = 360});
  write_png(renderer.draw({shape}, frame_bounds(stage.bounds, 16. / 9)), words[2]);
}
