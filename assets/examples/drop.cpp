// A mesh, a material, 100 steps, a picture: drop MESH PICTURE.png. Build it with the CMakeLists.txt beside it.
#include <sprung/core/law/material.h>
#include <sprung/core/mesh/read_mesh.h>
#include <sprung/core/motion/integrator.h>
#include <sprung/core/soft_body.h>
#include <sprung/render/png.h>
#include <sprung/render/renderer.h>

int main(int count, char** words) {
  using namespace sprung;
  if (count != 3) return 2;
  const Material rubber{.name = "soft rubber", .young = 200e3, .poisson = 0.45, .density = 950, .damping = 0.03};
  World world{.actors = {}, .obstacles = {level_ground(0)}};
  std::vector<SoftBody> bodies = fill_mesh(read_mesh(words[1]), words[1], {.material = rubber, .bricks = 16});
  for (SoftBody& body : bodies) {
    body.actor.body.velocities.rowwise() += Eigen::RowVector3d(0, -2, 0);  // m/s, into the ground
    world.actors.push_back(body.actor);
  }
  advance(world, Scheme::kSymplecticEuler, stable_step(world), 100, 0);

  Stage stage;
  std::vector<SkinShape> shapes;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& [actor, skin, embedding] = bodies[i];
    const Points& nodes = world.actors[i].body.positions;
    const Points positions = deform_points(actor.body.grid, embedding, nodes);
    const Points normals = deform_normals(actor.body.grid, embedding, skin.normals, nodes);
    shapes.push_back({positions.cast<float>(), normals.cast<float>()});
    stage.skins.push_back(&skin);
    stage.default_colors.emplace_back(0.85F, 0.2F, 0.16F);
    stage.bounds.include(positions);
  }
  const Image picture =
      Renderer(stage, {.width = 640, .height = 360}).draw(shapes, frame_bounds(stage.bounds, 16. / 9));
  write_png(picture, words[2]);
}
