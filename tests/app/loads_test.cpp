#include <gtest/gtest.h>

#include "app/scene/scene_file.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"

/// Loads on bodies in a scene, and their timing.
namespace sprung {
namespace {

/// A cube of 10 cm and 1 kg.
const std::string kLoadedCube = R"(
duration = 0.55
fps = 20
gravity = [0, 0, 0]
[[probe]]
name = "middle"
point = [0, 0, 0]
[[body]]
box = [0.1, 0.1, 0.1]
bricks = 4
material = { young = 1e5, poisson = 0.3, density = 1000, damping = 0.2 }
)";
const std::string kHeld = R"(
[[probe]]
name = "foot"
pin = "foot"
)";
const std::string kFoot = R"(
[[body.pin]]
name = "foot"
box = { min = [0, 0, 0], max = [1, 0.01, 1] }
)";

Recording recording_of(const std::string& text) {
  const Film scene = parse_scene(text, "/scene.toml");
  const Observer silent;
  Simulation simulation = prepare_simulation(scene, silent);
  return simulate(simulation, scene, silent);
}

std::vector<Vec3> path_of_load(const std::string& text) {
  std::vector<Vec3> positions;
  const Recording recording = recording_of(text);
  for (const ProbeSample& sample : recording.probes.at(0).samples) positions.push_back(sample.displacement);
  return positions;
}

TEST(SceneLoads, ForceActsFromItsKeyframeOn) {
  const std::vector<Vec3> positions =
      path_of_load(kLoadedCube + "[[body.force]]\ntotal = [2, 0, 0]\ninterpolation = \"held\"\n" +
                   "keyframes = [{ t = 0, strength = 0 }, { t = 0.2, strength = 1 }]\n[solver]\nscheme = \"verlet\"\n");
  EXPECT_LT(positions[4].norm(), 1e-9);
  EXPECT_NEAR(positions[10].x(), 0.5 * 2 * 0.3 * 0.3, 1e-4);
}

/// Flat boxes: the cube pinned at its foot and pulled at its top, which contain no brick's middle.
TEST(SceneLoads, FacesAreHeldAndPulled) {
  const Recording pulled =
      recording_of(kLoadedCube + kHeld +
                   "[[body.pin]]\nname = \"foot\"\nbox = { min = [0, 0, 0], max = [1, 0, 1] }\n[[body.force]]\n"
                   "total = [0, 1, 0]\nbox = { min = [0, 1, 0], max = [1, 1, 1] }\n[solver]\nscheme = \"linear\"\n");
  EXPECT_NEAR(pulled.probes.at(1).samples.back().force.y(), -1, 1e-9);
  // sigma L / (2 E), and a little less since the top layer of bricks is pulled at its middle and held sideways below.
  EXPECT_NEAR(pulled.probes.at(0).samples.back().displacement.y(), 100 * 0.05 / 1e5, 1e-5);
}

TEST(SceneLoads, TotalIsSharedOutByVolumeAndPerVolumeIsNot) {
  const std::string part = "box = { min = [0, 0, 0], max = [0.5, 1, 1] }\n";
  const std::vector<Vec3> total = path_of_load(kLoadedCube + "[[body.force]]\n" + part + "total = [0, 0, 3]\n");
  const std::vector<Vec3> half = path_of_load(kLoadedCube + "[[body.force]]\n" + part + "per_volume = [0, 0, 6000]\n");
  EXPECT_GT(total[10].z(), 0.3);
  EXPECT_LT((total[10] - half[10]).norm(), 1e-9);
}

TEST(SceneLoads, GravityFollowsItsKeyframes) {
  const std::vector<Vec3> positions = path_of_load(
      "gravity_keyframes = [{ t = 0, gravity = [0, -10, 0] }, { t = 0.5, gravity = [0, 0, 0] }]\n" + kLoadedCube);
  EXPECT_NEAR(positions[10].y(), -10 * 0.25 / 2 + 20 * 0.125 / 6, 2e-3);
}

/// After the motion has died away, and in statics: the reaction at the foot balances the force.
TEST(SceneLoads, WhatHoldsABodyAnswersTheForce) {
  for (const std::string solver :
       {"scheme = \"static\"\nload_steps = 2\n", "scheme = \"euler\"\n", "scheme = \"bdf2\"\n"}) {
    const std::size_t body = kLoadedCube.find("[[body]]");
    const Recording recording = recording_of(
        "duration = 3\n" + kLoadedCube.substr(kLoadedCube.find("fps"), body - kLoadedCube.find("fps")) + kHeld +
        kLoadedCube.substr(body) + kFoot + "[[body.force]]\nbox = { min = [0, 0.5, 0], max = [1, 1, 1] }\n" +
        "total = [0.4, 0.2, 0]\n[solver]\n" + solver);
    const Vec3 force = recording.probes.at(1).samples.back().force;
    EXPECT_LT((force + Vec3(0.4, 0.2, 0)).norm(), 0.01) << solver << force.transpose();
  }
}

/// A wind carries a cube, a pressure on one side pushes it: explicit and implicit steps agree.
TEST(SceneLoads, ActInImplicitStepsToo) {
  const std::string wind = "[wind]\nvelocity = [9, 0, 0]\n";
  const std::string pressure =
      "[[body.force]]\nhalf_space = { point = [0.01, 0, 0], normal = [1, 0, 0] }\npressure = 200\n";
  const std::string muscle =
      "[[body.muscle]]\ndirection = [1, 1, 0]\ncontraction = 0.3\n"
      "keyframes = [{ t = 0, strength = 0 }, { t = 0.4, strength = 1 }]\n";
  for (const std::string& load : {wind, pressure, wind + muscle}) {
    const std::vector<Vec3> short_steps = path_of_load(kLoadedCube + load);
    const std::vector<Vec3> long_steps = path_of_load(kLoadedCube + load + "[solver]\nscheme = \"bdf2\"\n");
    EXPECT_GT(short_steps.back().norm(), 0.05) << load;
    EXPECT_LT((short_steps.back() - long_steps.back()).norm(), 0.02 * short_steps.back().norm()) << load;
  }
}

/// Even if they begin late: that is reported, not ignored.
TEST(SceneLoads, WhatCannotBeIsRefused) {
  const std::string late = "keyframes = [{ t = 0, strength = 0 }, { t = 0.3, strength = 1 }]\n";
  const std::string wind = "[wind]\nvelocity = [3, 0, 0]\n" + late;
  const std::string muscle = "[[body.muscle]]\ndirection = [0, 1, 0]\ncontraction = 0.3\n" + late;
  const auto message_by = [&](const std::string& load, Solver scheme) {
    Film scene = parse_scene(kLoadedCube + kFoot + load, "/scene.toml");
    scene.solver.scheme = scheme;
    return error_message([&] {
      const Observer silent;
      Simulation simulation = prepare_simulation(scene, silent);
      static_cast<void>(simulate(simulation, scene, silent));
    });
  };
  EXPECT_NE(message_by(muscle, Solver::kStatic).find("can have a muscle"), std::string::npos);
  EXPECT_NE(message_by(wind, Solver::kStatic).find("can have a wind"), std::string::npos);
}

}  // namespace
}  // namespace sprung
