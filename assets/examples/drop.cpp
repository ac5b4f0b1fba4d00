// A mesh, a material, a fall of 0.2 s, a picture: drop MESH PICTURE.png. Build it with the CMakeLists.txt beside it.
#include <sprung/core/simulation/motion.h>
#include <sprung/core/simulation/observer.h>
#include <sprung/core/simulation/simulation.h>
#include <sprung/render/image/png.h>
#include <sprung/render/renderer.h>

int main(int count, char** words) {
  using namespace sprung;
  if (count != 3) return 2;
  Scene scene;
  SceneBody& described = scene.bodies.emplace_back();
  described.mesh = words[1];
  described.material = {.name = "soft rubber", .young = 200e3, .poisson = 0.45, .density = 950, .damping = 0.03};
  described.bricks = 16;
  described.velocity = {0, -2, 0};  // m/s, into the ground
  scene.obstacles.emplace_back().plane = Plane{};

  Simulation simulation = prepare_simulation(scene, Observer());
  SceneMotion motion(simulation, scene);
  motion.advance(
      0, 0.2, 0.2, [](double) {}, [](const std::string&) {});

  const SoftBody& body = simulation.world.bodies.front();  // of the largest of the mesh's solids
  const Points positions = body.skin_positions(body.positions);
  const Points normals = deform_normals(body.grid, body.drawn.embedding, body.drawn.skin.normals, body.positions);
  const SkinShape shape{positions.cast<float>(), normals.cast<float>()};
  Stage stage{.skins = {&body.drawn.skin}, .default_colors = {{0.85F, 0.2F, 0.16F}}};
  stage.bounds = bounding_box(positions);
  Renderer renderer(stage, {.width = 640, .height = 360});
  write_png(renderer.draw({shape}, frame_bounds(stage.bounds, 16. / 9)), words[2]);
}
