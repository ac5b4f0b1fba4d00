#include <gtest/gtest.h>

#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

/// Ribs of 0.06 and planks of 0.04 upon them, all apart by less than that, in bricks of ten times as much: every point
/// is nearer to the far side of another part than bricks are large.
SurfaceMesh hull() {
  SurfaceMesh mesh = test::box_mesh({0, 0, 0}, {0.06, 1.5, 4});
  for (int rib = 1; rib < 5; ++rib)
    mesh = test::joined(mesh, test::box_mesh(Vec3(rib, 0, 0), Vec3(rib + 0.06, 1.5, 4)));
  for (int plank = 0; plank < 12; ++plank) {
    const double z = 0.33 * plank;
    mesh = test::joined(mesh, test::box_mesh({0, 1.52, z}, {4.06, 1.56, z + 0.31}));
  }
  return mesh;
}

/// Without forces nothing happens: points beyond a thin part are not mistaken for being inside it and pushed out.
TEST(ThinPartContact, CloseToEachOtherAreLeftAlone) {
  Scene scene;
  scene.duration = 0.2;
  scene.gravity.setZero();
  SceneBody& body = scene.bodies.emplace_back();
  body.surface = std::make_shared<const SurfaceMesh>(hull());
  body.size = 0.1;
  body.bricks = 12;
  body.material = {.name = "soft", .young = 2e4, .poisson = 0.45, .density = 1000, .damping = 0.02, .source = {}};
  Simulation simulation = prepare_simulation(scene, Observer());
  ASSERT_EQ(simulation.world.bodies.size(), 17U);
  static_cast<void>(simulate(simulation, scene, Observer()));
  for (const SoftBody& part : simulation.world.bodies) {
    EXPECT_LT(part.velocities.rowwise().norm().maxCoeff(), 1e-4) << "m/s";
  }
}

}  // namespace
}  // namespace sprung
