#include "app/scene/supporting_material.h"

#include <gtest/gtest.h>

#include "app/scene/scene_file.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

SceneBody column(double width, double height) {
  SceneBody body;
  body.box = Vec3(width, height, width);
  return body;
}

Pin foot() {
  Pin pin;
  pin.name = "foot";
  pin.box = Box{.max = Vec3(1, 0.04, 1)};
  return pin;
}

const Vec3 kGravity(0, -9.81, 0);

/// The chosen material supports the body, as confirmed by a scene with finer bricks and the ordinary static scheme; the
/// next softer elastomer of the library does not.
TEST(SupportingMaterial, IsTheSoftestInWhichTheBodyKeepsItsShape) {
  const auto chosen =
      softest_supporting(column(0.16, 0.32), Support::kStands, kGravity, false, *built_in_materials(), Observer());
  ASSERT_TRUE(chosen);
  EXPECT_LE(chosen->sag, 0.04);
  const auto sag_of = [](const LibraryMaterial& material, Solver scheme) {
    Scene scene;
    scene.solver.scheme = scheme;
    scene.solver.load_steps = 1;
    SceneBody& body = scene.bodies.emplace_back(column(0.16, 0.32));
    body.bricks = 32;
    body.material = material.material();
    body.pins = {foot()};
    Simulation simulation = prepare_simulation(scene, Observer());
    static_cast<void>(simulate(simulation, scene, Observer()));
    const SoftBody& still = simulation.world.bodies[0];
    return (still.positions - still.rest_positions).rowwise().norm().maxCoeff() / 0.32;
  };
  EXPECT_NEAR(sag_of(*chosen->material, Solver::kStatic), chosen->sag, 0.1 * chosen->sag);
  double next = 0;  // of those that are softer
  const LibraryMaterial* softer = nullptr;
  for (const LibraryMaterial& material : built_in_materials()->materials()) {
    const bool is_gelatin = material.material_class == MaterialClass::kGelatin;
    if (!is_gelatin && material.material_class != MaterialClass::kSilicone) continue;
    const double stiffness = material.young / material.density;
    if (stiffness >= chosen->material->young / chosen->material->density || stiffness <= next) continue;
    next = stiffness;
    softer = &material;
  }
  ASSERT_NE(softer, nullptr);
  EXPECT_GT(sag_of(*softer, Solver::kLinear), 0.04);
}

constexpr double kLength = 0.2;          // m
constexpr double kWidth = kLength / 16;  // m

/// Hardly off the vertical, so that it buckles if it can.
SceneBody leaning_rod() {
  SceneBody rod = column(kWidth, kLength);
  rod.rotation.z() = 0.1;
  return rod;
}

/// A clamped column buckles under its own weight if rho g A L^3 / (E I) > 7.84 (Greenhill 1881). For twice its weight.
double buckling_load(const SupportingMaterial& chosen, double gravity) {
  return 2 * gravity * chosen.material->density * 12 * chosen.size * std::pow(kLength / kWidth, 2) /
         chosen.material->young;
}
constexpr double kBuckling = 7.84 * 1.2;  // its foot is fixed, so the free length is a little shorter

TEST(SupportingMaterial, CarriesTwiceItsWeightWithoutBuckling) {
  const auto chosen =
      softest_supporting(leaning_rod(), Support::kStands, kGravity, false, *built_in_materials(), Observer());
  ASSERT_TRUE(chosen);
  EXPECT_LT(buckling_load(*chosen, 9.81), kBuckling);
}

/// A rod that no elastomer supports at 20 cm stands if it is smaller: sag grows with the size.
TEST(SupportingMaterial, MakesSlenderBodiesSmaller) {
  const Vec3 heavy = 10 * kGravity;
  EXPECT_FALSE(softest_supporting(leaning_rod(), Support::kStands, heavy, false, *built_in_materials(), Observer()));
  const auto smaller =
      softest_supporting(leaning_rod(), Support::kStands, heavy, true, *built_in_materials(), Observer());
  ASSERT_TRUE(smaller);
  EXPECT_LT(smaller->size, 0.11);
  EXPECT_LT(buckling_load(*smaller, 98.1), kBuckling);
}

/// Hanging bodies do not buckle, so a softer material supports them.
TEST(SupportingMaterial, HangsInASofterOneThanItStandsIn) {
  const auto standing =
      softest_supporting(leaning_rod(), Support::kStands, kGravity, false, *built_in_materials(), Observer());
  const auto hanging =
      softest_supporting(leaning_rod(), Support::kHangs, kGravity, false, *built_in_materials(), Observer());
  ASSERT_TRUE(standing && hanging);
  EXPECT_LT(hanging->material->young, 0.5 * standing->material->young);
}

/// For a bare mesh for which no material is named.
TEST(SupportingMaterial, IsWrittenIntoTheScene) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const ProgramRun run = run_program(folder, "animate cube.obj --print-scene");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Film scene = parse_scene(run.out, folder.path() / "scene.toml");
  EXPECT_NE(run.err.find("material: " + scene.bodies[0].material.name + ", the softest that stands"), std::string::npos)
      << run.err;
  EXPECT_EQ(scene.solver.scheme, Solver::kAuto);
  EXPECT_EQ(print_scene(scene), run.out);
  EXPECT_EQ(run_program(folder, "animate cube.obj --material auto --print-scene").out, run.out);
  const ProgramRun named = run_program(folder, "animate cube.obj --young 30kPa --print-scene");
  EXPECT_EQ(named.err.find("the softest"), std::string::npos) << named.err;
}

/// Bodies of a scene that name none: one stands, a similar one hangs by a pin. Those with regions or a name keep it.
TEST(SupportingMaterial, IsChosenForTheBodiesOfASceneThatNameNone) {
  const TempFolder folder;
  const std::string rod = "[[body]]\nbox = [0.0125, 0.2, 0.0125]\nbricks = 16\nrotation = [0, 0, 0.1]\n";
  static_cast<void>(
      folder.write("scene.toml", rod + rod + "[[body.pin]]\nbox = { min = [0, 0.9, 0], max = [1, 1, 1] }\n" + rod +
                                     "material = \"balsa\"\n" + rod +
                                     "[[body.region]]\nbox = { min = [0, 0.5, 0], max = [1, 1, 1] }\nmaterial = "
                                     "{ young = 1e5, poisson = 0.45, density = 1000 }\n"));
  const ProgramRun run = run_program(folder, "simulate scene.toml --print-scene");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Film scene = parse_scene(run.out, folder.path() / "scene.toml");
  EXPECT_GT(scene.bodies[0].material.young, 2 * scene.bodies[1].material.young) << run.err;
  EXPECT_EQ(scene.bodies[2].material.name, "balsa");
  EXPECT_EQ(scene.bodies[3].material.name, kDefaultMaterial);
  EXPECT_NE(run.err.find("material of body 1: " + scene.bodies[0].material.name + ", the softest that keeps"),
            std::string::npos)
      << run.err;
  EXPECT_EQ(print_scene(scene), run.out);
}

}  // namespace
}  // namespace sprung
