#include "app/scene/scenarios.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/scene/scene_file.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

/// A soft cube of 20 cm that does this for 3 s, with the middle of its upper face, its own and that
/// of an upper edge watched.
Recording record(Scenario scenario) {
  Film scene;
  scene.duration = 3;
  SceneBody& body = scene.bodies.emplace_back(default_body());
  body.box = Vec3::Constant(0.2);
  body.size = 0.2;
  body.bricks = 3;
  body.material = Material{.name = "soft", .young = 2e4, .poisson = 0.3, .density = 500, .damping = 0.05, .source = ""};
  scene.probes.resize(3);
  scene.probes[0].name = "face";
  scene.probes[0].point = Vec3(0, 0.1, 0);
  scene.probes[1].name = "middle";
  scene.probes[1].point = Vec3::Zero();
  scene.probes[2].name = "edge";
  scene.probes[2].point = Vec3(0.1, 0.1, 0);
  stage_scenario(scene, scenario, 0.2);
  const Observer silent;
  Simulation simulation = prepare_simulation(scene, silent);
  return simulate(simulation, scene, silent);
}

/// The displacement of the probe at a time, m.
Vec3 at(const Recording& recording, std::size_t probe, double time) {
  return recording.probes.at(probe).samples.at(std::size_t(time * 24)).displacement;
}

TEST(Scenarios, StretchPullsAndBringsBack) {
  const Recording recording = record(Scenario::kStretch);
  EXPECT_LT((at(recording, 0, 1.5) - Vec3(0, 0.12, 0)).norm(), 1e-9);
  EXPECT_LT(at(recording, 0, 2.999).norm(), 2e-3);  // smoothly to rest, a frame before the end
  EXPECT_NEAR(at(recording, 1, 1.5).y(), 0.06, 0.03);
}

TEST(Scenarios, SquashPressesBetweenPlatesAndLetsGo) {
  const Recording recording = record(Scenario::kSquash);
  EXPECT_NEAR(at(recording, 0, 1.5).y(), -0.04, 0.005);
  EXPECT_NEAR(at(recording, 1, 1.5).y(), 0, 0.005);
  EXPECT_NEAR((at(recording, 0, 2.999) - at(recording, 1, 2.999)).y(), 0, 3e-3);  // its weight presses it a little
}

TEST(Scenarios, TwistTurnsAndBringsBack) {
  const Recording recording = record(Scenario::kTwist);
  EXPECT_LT(at(recording, 0, 1.5).norm(), 1e-9);  // on the axis
  EXPECT_LT((at(recording, 2, 1.5) - Vec3(-0.2, 0, 0)).norm(), 1e-9);
  EXPECT_LT(at(recording, 1, 2.999).norm(), 5e-3);
}

TEST(Scenarios, WobbleSwingsThroughTheMiddleAndDiesDown) {
  const Recording recording = record(Scenario::kWobble);
  EXPECT_NEAR(at(recording, 0, 0.5).x(), 0.06, 1e-3);
  double lowest = 0;
  for (double time = 0.63; time < 1.5; time += 1.0 / 24) lowest = std::min(lowest, at(recording, 0, time).x());
  EXPECT_LT(lowest, -0.005);
  EXPECT_LT(std::abs(at(recording, 0, 2.999).x()), 0.5 * std::abs(lowest));
}

TEST(Scenarios, ThrowFliesInABowAndLands) {
  const Recording recording = record(Scenario::kThrow);
  const double speed = std::sqrt(9.81 * 0.2);
  const double top = 1.1 * speed / 9.81;
  EXPECT_NEAR(at(recording, 1, std::floor(top * 24) / 24).y(), 0.55 * top * speed, 0.01);
  EXPECT_NEAR(at(recording, 1, 0.25).x(), 0.25 * 0.55 * speed, 0.005);
  EXPECT_LT(at(recording, 1, 2.999).y(), 0.02);
}

TEST(Scenarios, DropLandsUprightAndStays) {
  const Recording recording = record(Scenario::kDrop);
  EXPECT_NEAR(at(recording, 1, 2.999).y(), -0.017, 0.006);                      // from 0.08 sizes to the ground
  EXPECT_LT((at(recording, 2, 2.999) - at(recording, 0, 2.999)).norm(), 2e-3);  // it has not turned
}

TEST(Scenarios, AShortFilmIsTheBeginningOfALongOne) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  for (const std::string_view name : scenario_names()) {
    const auto scene = [&](const char* duration) {
      std::string text =
          run_program(folder, fmt::format("animate cube.obj --print-scene --scenario {} --duration {}", name, duration))
              .out;
      const std::size_t begin = text.find("duration = ");
      return text.erase(begin, text.find('\n', begin) - begin);
    };
    EXPECT_EQ(scene("0.2s"), scene("3s")) << name;
  }
}

TEST(Scenarios, FilesWithZUpStandUpright) {
  const TempFolder folder;
  static_cast<void>(
      folder.write("tent.obj", "v 0 0 0\nv 4 0 0\nv 0 0 1\nv 1 2 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"));
  const ProgramRun z = run_program(folder, "animate tent.obj --size 40cm --scenario stretch --up z --print-scene");
  EXPECT_NE(z.out.find("rotation = [-90, 0, 0]"), std::string::npos) << z.out << z.err;
  EXPECT_NE(z.out.find("translate = [0, 0.06, 0]"), std::string::npos) << z.out;  // 1 of 4 units high
  const ProgramRun wrong = run_program(folder, "animate tent.obj --up x --print-scene");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("--up: 'x' is not a vertical axis"), std::string::npos) << wrong.err;
}

TEST(Scenarios, AreSeenFromWhereOneSays) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const auto azimuth = [&](const std::string& view) {
    const ProgramRun run = run_program(folder, "animate cube.obj --print-scene --view " + view);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return parse_scene(run.out, folder.path() / "scene.toml").camera.azimuth;
  };
  EXPECT_DOUBLE_EQ(azimuth("back"), 180);
  EXPECT_DOUBLE_EQ(azimuth("left"), -90);
  EXPECT_DOUBLE_EQ(azimuth("75"), 75);
  EXPECT_NE(run_program(folder, "animate cube.obj --view bottm -o out/").err.find("--view: 'bottm'"),
            std::string::npos);
}

TEST(Scenarios, ATypedQualityWinsOverTheSamplesOfAScene) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  static_cast<void>(folder.write("scene.toml", "[render]\nsamples = 1\n[[body]]\nmesh = \"cube.obj\"\n"));
  const auto samples = [&](const std::string& options) {
    const ProgramRun run = run_program(folder, "animate scene.toml --print-scene " + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return parse_scene(run.out, folder.path() / "printed.toml").render.samples;
  };
  EXPECT_EQ(samples(""), 1);
  EXPECT_EQ(samples("--quality high"), std::nullopt);
  EXPECT_EQ(samples("--quality high --samples 4"), 4);
}

TEST(Scenarios, KnowHowHighAMeshIs) {
  const TempFolder folder;
  static_cast<void>(
      folder.write("tent.obj", "v 0 0 0\nv 4 0 0\nv 0 0 1\nv 1 2 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"));
  const ProgramRun run = run_program(folder, "animate tent.obj --size 40cm --scenario stretch --print-scene");
  EXPECT_NE(run.out.find("translate = [0, 0.12, 0]"), std::string::npos) << run.out << run.err;
}

TEST(Scenarios, AreScenesThatCanBePrintedAndSet) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  for (const std::string_view name : scenario_names()) {
    const std::string words = fmt::format("animate cube.obj --print-scene --scenario {}", name);
    const ProgramRun run = run_program(folder, words + " --set 'body.spin=[0, 0, 1 rad/s]' --set camera.orbit=20");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Film scene = parse_scene(run.out, folder.path() / "scene.toml");
    EXPECT_EQ(print_scene(scene), run.out) << name;
    EXPECT_DOUBLE_EQ(scene.camera.orbit, 20);
    EXPECT_NEAR(scene.bodies[0].spin.z(), 57.296, 1e-3);  // degrees/s; what is typed wins over that of throw
  }
  EXPECT_NE(run_program(folder, "animate cube.obj --print-scene --set orbit").err.find("not of the form KEY=VALUE"),
            std::string::npos);
  EXPECT_NE(run_program(folder, "animate cube.obj --print-scene --set body.spin=3").err.find("must be 3 numbers"),
            std::string::npos);
  EXPECT_NE(run_program(folder, "animate cube.obj --print-scene --set camera.orbt=3").err.find("did you mean 'orbit'?"),
            std::string::npos);
}

}  // namespace
}  // namespace sprung
