#include <gtest/gtest.h>

#include "app/scene/scene_file.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"

/// Which nodes the pins of a scene hold, move and release, and when.
namespace sprung {
namespace {

/// A soft cube 10 cm high with a pin around all of it.
const std::string kCube = R"(
duration = 0.55
fps = 20
gravity = [0, -10, 0]
[[body]]
box = [0.1, 0.1, 0.1]
bricks = 2
material = { young = 1e5, poisson = 0.3, density = 1000 }
[[probe]]
name = "middle"
point = [0, 0, 0]
[[body.pin]]
box = { min = [0, 0, 0], max = [1, 1, 1] }
)";

/// The path of the cube's middle, frame by frame.
std::vector<Vec3> path(const std::string& text) {
  const Film scene = parse_scene(text, "/scene.toml");
  const Observer silent;
  Simulation simulation = prepare_simulation(scene, silent);
  std::vector<Vec3> displacements;
  const Recording recording = simulate(simulation, scene, silent);
  for (const ProbeSample& sample : recording.probes.at(0).samples) {
    displacements.push_back(sample.displacement);
  }
  return displacements;
}

TEST(Handles, NodesAreAtTheirKeyframesInEveryFrame) {
  const std::string keyframes =
      "keyframes = [{ t = 0.12, translate = [0.3, 0, 0] }, { t = 0.2 }, { t = 0.5, rotate = [0, 90, 0], scale = 1.2, "
      "translate = [0, 0.1, 0] }]\n";
  for (const std::string scheme : {"euler", "verlet", "bdf2"}) {
    const std::vector<Vec3> displacements = path(kCube + keyframes + "[solver]\nscheme = \"" + scheme + "\"\n");
    ASSERT_EQ(displacements.size(), 11U);
    EXPECT_LT((displacements[2] - Vec3(0.25, 0, 0)).norm(), 1e-9) << scheme;
    EXPECT_LT((displacements[3] - Vec3(0.3 * 5 / 8, 0, 0)).norm(), 1e-9) << scheme;
    EXPECT_LT(displacements[4].norm(), 1e-9) << scheme;
    EXPECT_LT((displacements[7] - Vec3(0, 0.05, 0)).norm(), 1e-9) << scheme;
    EXPECT_LT((displacements[10] - Vec3(0, 0.1, 0)).norm(), 1e-9) << scheme;
  }
}

/// Between frames: the pin lets go at 0.12 s, and the frame at 0.15 s shows 0.03 s of flight.
TEST(Handles, WhatIsLetGoFliesOnWithItsVelocity) {
  const std::vector<Vec3> displacements =
      path(kCube + "keyframes = [{ t = 1, translate = [2, 0, 0] }]\nuntil = 0.12\n[solver]\nscheme = \"verlet\"\n");
  EXPECT_LT((displacements[2] - Vec3(0.2, 0, 0)).norm(), 1e-9);
  for (const auto frame : {3, 6, 10}) {
    const double flight = 0.05 * frame - 0.12;
    const Vec3 expected(2 * 0.05 * frame, -5 * flight * flight, 0);
    EXPECT_LT((displacements[frame] - expected).norm(), 1e-9) << frame;
  }
}

TEST(Handles, WhatIsCaughtLateStaysWhereItIs) {
  const std::vector<Vec3> displacements = path(kCube + "from = 0.3\n[solver]\nscheme = \"verlet\"\n");
  EXPECT_NEAR(displacements[6].y(), -5 * 0.09, 1e-9);
  EXPECT_NEAR(displacements[10].y(), displacements[6].y(), 1e-9);
}

/// The rest of a movement starts where the pin catches its nodes.
TEST(Handles, WhatIsCaughtLateIsCarriedOn) {
  const std::vector<Vec3> displacements = path("gravity = [0, 0, 0]\n" + kCube.substr(kCube.find("[[body]]")) +
                                               "from = 1\nkeyframes = [{ t = 2, translate = [2, 0, 0] }]\n");
  EXPECT_LT(displacements[24].norm(), 1e-12);
  EXPECT_LT((displacements[36] - Vec3(0.5, 0, 0)).norm(), 1e-9);
  EXPECT_LT((displacements[71] - Vec3(1, 0, 0)).norm(), 1e-9);
}

TEST(Handles, StaticsTakeKeyframesAtTheirShareOfTheFilm) {
  const std::vector<Vec3> displacements =
      path("duration = 2\n" + kCube.substr(kCube.find("gravity")) +
           "keyframes = [{ t = 1, translate = [0.1, 0, 0] }]\n[solver]\nscheme = \"static\"\nload_steps = 4\n");
  ASSERT_EQ(displacements.size(), 5U);
  EXPECT_NEAR(displacements[1].x(), 0.05, 1e-9);
  EXPECT_NEAR(displacements[2].x(), 0.1, 1e-9);
  EXPECT_NEAR(displacements[4].x(), 0.1, 1e-9);
}

TEST(Handles, ScenesThatCannotBeAreRefused) {
  const auto mistake = [](const std::string& lines) {
    return error_message([&] { static_cast<void>(parse_scene(kCube + lines, "/scene.toml")); });
  };
  EXPECT_NE(mistake("keyframes = [{ t = 1 }, { t = 1 }]").find("/scene.toml:14:25: body.pin.keyframes: t = 1 s is not"),
            std::string::npos)
      << mistake("keyframes = [{ t = 1 }, { t = 1 }]");
  EXPECT_NE(mistake("keyframes = [{ t = 0, scale = 2 }]").find("at t = 0 the nodes are where the body is"),
            std::string::npos);
  EXPECT_NE(mistake("keyframes = [{ t = -1 }]").find("at least 0 s"), std::string::npos);
  EXPECT_NE(mistake("keyframes = [{ time = 1 }]").find("unknown key 'body.pin.keyframes.time'"), std::string::npos);
  EXPECT_NE(mistake("from = 2\nuntil = 1").find(":15:9: body.pin.until: must be after body.pin.from"),
            std::string::npos);
  EXPECT_NE(mistake("rotate = [1, 0, 0]\nkeyframes = [{ t = 1 }]").find("give rotate or keyframes, not both"),
            std::string::npos);
  EXPECT_NE(mistake("interpolation = \"smoth\"").find("did you mean 'smooth'?"), std::string::npos);
  EXPECT_NE(mistake("until = 1\n[solver]\nscheme = \"static\"").find("only in a motion"), std::string::npos);
}

}  // namespace
}  // namespace sprung
