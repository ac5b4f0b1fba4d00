#include <gtest/gtest.h>

#include <algorithm>

#include "app/scene/scene_file.h"
#include "core/dynamics/statics/statics.h"
#include "core/simulation/drivers.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"
#include "tests/support/run_program.h"

/// Scenes as experiments: what pins, regions, probes and solvers of a scene do, and what `validate` makes of it.
namespace sprung {
namespace {

const std::string kBeam = R"(
gravity = [0, -1, 0]
[[body]]
box = [0.4, 0.1, 0.1]
bricks = 4
material = { young = 1000, poisson = 0.3, density = 40 }
  [[body.pin]]
  name = "root"
  box = { min = [0, 0, 0], max = [0.01, 1, 1] }
[[probe]]
name = "tip"
point = [0.2, 0, 0]
[[probe]]
name = "root"
pin = "root"
)";

Film scene_of(const std::string& text) { return parse_scene(text, "/scene.toml"); }

/// The recording of a scene by simulate().
Recording record(const Film& film, Simulation& simulation) {
  const Observer silent;
  simulation = prepare_simulation(film, silent);
  return simulate(simulation, film, silent);
}
Recording record(const std::string& text) {
  Simulation simulation;
  return record(scene_of(text), simulation);
}

TEST(Experiment, StaticSceneIsTheStaticSolution) {
  Simulation simulation;
  const Recording recording = record(scene_of(kBeam + "[solver]\nscheme = \"static\"\nload_steps = 1\n"), simulation);
  Material material;
  material.young = 1000;
  material.poisson = 0.3;
  material.density = 40;
  Body body = make_body(make_box_grid({4, 1, 1}, 0.1), Model::kCalibrated, material);
  Supports supports(body.node_count());
  for (int i = 0; i < body.node_count(); ++i) {
    if (body.rest_positions(i, 0) < 1e-9) supports.fix(i);
  }
  const Points loads = body.masses * Vec3(0, -1, 0).transpose();
  const auto system = make_direct_solver();
  solve_static(body, supports, loads, body.positions, *system);
  const Points moved = body.positions - body.rest_positions;
  const Body& made = simulation.world.bodies.at(0);
  EXPECT_GT(moved.cwiseAbs().maxCoeff(), 0.1);
  EXPECT_LT((made.positions - made.rest_positions - moved).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(recording.frames.size(), 2U);
  EXPECT_EQ(recording.progress, (std::vector<double>{0, 1}));
}

TEST(Experiment, PinsCarryTheWeight) {
  const Recording recording = record(kBeam + "[solver]\nscheme = \"static\"\nload_steps = 2\n");
  const ProbeTrack& root = recording.probes.at(1);
  const double free_weight = 0.4 * 0.1 * 0.1 * 40;  // in the reaction: all of it, pinned nodes included
  EXPECT_NEAR(root.samples.at(2).force.y(), free_weight, 1e-9);
  EXPECT_NEAR(root.samples.at(1).force.y(), free_weight / 2, 1e-9);
  EXPECT_NEAR(root.samples.at(2).force.x(), 0, 1e-9);
  EXPECT_GT(root.samples.at(2).torque.z(), 0);
  EXPECT_EQ(root.samples.at(2).displacement, Vec3(0, 0, 0));
}

TEST(Experiment, LinearAnswerGrowsWithTheLoad) {
  const Recording recording = record(kBeam + "[solver]\nscheme = \"linear\"\nload_steps = 4\n");
  const ProbeTrack& tip = recording.probes.at(0);
  const double whole = tip.samples.at(4).displacement.y();
  EXPECT_NEAR(whole / 40, -0.97731 * 0.004004546, 1e-6);  // the calibrated brick's 0.977 of the reference
  for (std::size_t frame = 0; frame <= 4; ++frame) {
    EXPECT_NEAR(tip.samples.at(frame).displacement.y(), double(frame) / 4 * whole, 1e-12);
  }
}

TEST(Experiment, StiffRegionHoldsBetter) {
  const std::string linear = "[solver]\nscheme = \"linear\"\nload_steps = 1\n";
  const auto with_region = [&](const std::string& young, const std::string& density) {
    std::string text = kBeam;
    const std::string region =
        "  [[body.region]]\n  box = { min = [0, 0, 0], max = [1, 1, 1] }\n  material = { young = " + young +
        ", poisson = 0.3, density = " + density + " }\n";
    text.insert(text.find("[[probe]]"), region);
    return record(text + linear);
  };
  const double plain = record(kBeam + linear).probes.at(0).samples.back().displacement.y();
  EXPECT_NEAR(with_region("4000", "40").probes.at(0).samples.back().displacement.y(), plain / 4, 1e-12);
  EXPECT_NEAR(with_region("1000", "80").probes.at(0).samples.back().displacement.y(), plain * 2, 1e-12);
}

TEST(Experiment, MovedPinsArriveInMotionAndAtRest) {
  std::string text = kBeam;
  text.insert(text.find("[[probe]]"), "  translate = [0.1, 0.2, 0]\n  rotate = [90, 0, 0]\n");
  for (const std::string scheme : {"euler", "verlet", "static"}) {
    Simulation simulation;
    const Recording recording =
        record(scene_of("duration = 0.25\n" + text + "[solver]\nscheme = \"" + scheme + "\"\n"), simulation);
    const Vec3 shift = recording.probes.at(1).samples.back().displacement;
    EXPECT_LT((shift - Vec3(0.1, 0.2, 0)).norm(), 1e-9) << scheme;
    const Body& body = simulation.world.bodies.at(0);
    const Points goal =
        body.rest_positions + pin_movements(scene_of("duration = 0.25\n" + text), simulation, 0, 0.25, false);
    for (const KinematicNode& pinned : simulation.world.bodies.at(0).pinned) {
      EXPECT_LT((body.positions.row(pinned.node) - goal.row(pinned.node)).norm(), 1e-9) << scheme;
    }
  }
}

TEST(Experiment, FreeAxesOfAPinAreFree) {
  std::string text = kBeam;
  text.insert(text.find("[[probe]]"), R"(  [[body.pin]]
  name = "end"
  box = { min = [0.99, 0, 0], max = [1, 1, 1] }
  axes = "x"
  translate = [0.004, 0, 0]
)");
  const Recording recording = record(text + "[solver]\nscheme = \"linear\"\nload_steps = 1\n");
  const Vec3 tip = recording.probes.at(0).samples.back().displacement;
  EXPECT_NEAR(tip.x(), 0.004, 1e-12);
  EXPECT_LT(tip.y(), -0.01);
}

TEST(Experiment, CutBoxHasTheBricksThatAreLeft) {
  Simulation simulation;
  static_cast<void>(record(scene_of(R"([[body]]
box = [0.3, 0.2, 0.1]
bricks = 6
  [[body.cut]]
  box = { min = [0.334, 0, 0], max = [1, 0.5, 1] }
  [[body.pin]]
  box = { min = [0, 0, 0], max = [1, 0.01, 1] }
[solver]
scheme = "linear"
load_steps = 1
)"),
                           simulation));
  EXPECT_EQ(simulation.world.bodies.at(0).grid.brick_count(), 6 * 4 * 2 - 4 * 2 * 2);
}

TEST(Experiment, BricksMustFitIntoABox) {
  EXPECT_NE(error_message([] { record("[[body]]\nbox = [0.4, 0.1, 0.1]\nbricks = 5\n"); }).find("0.08"),
            std::string::npos);
}

class ExperimentProgram : public testing::Test {
 protected:
  [[nodiscard]] ProgramRun run(const std::string& words) const { return run_program(folder_, words); }
  void write_beam(const std::string& name, double expected) const {
    static_cast<void>(folder_.write(name, kBeam + "[solver]\nscheme = \"linear\"\nload_steps = 1\n[[expect]]\n" +
                                              "quantity = \"tip.displacement.y\"\nsource = \"a book\"\nvalue = " +
                                              std::to_string(expected) + "\n[[expect.gate]]\ntolerance = 0.03\n"));
  }

  TempFolder folder_;
};

TEST_F(ExperimentProgram, SimulateWritesItsProbes) {
  static_cast<void>(folder_.write("beam.toml", kBeam + "[solver]\nscheme = \"static\"\nload_steps = 3\n"));
  const ProgramRun made = run("simulate beam.toml -o out");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out.rfind("state ", 0), 0U) << made.out;
  EXPECT_NE(made.out.find("tip displacement ["), std::string::npos) << made.out;
  const std::string csv = text_of(folder_.path() / "out/probes.csv");
  EXPECT_EQ(csv.rfind("load,tip.position.x_m,tip.position.y_m,tip.position.z_m,tip.displacement.x_m,", 0), 0U) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5) << csv;
  EXPECT_NE(csv.find("root.torque.z_Nm"), std::string::npos);
  EXPECT_NE(text_of(folder_.path() / "out/probes.json").find("\"state_hash\":\"" + made.out.substr(6, 16)),
            std::string::npos);
  EXPECT_EQ(run("simulate beam.toml -o out").exit_code, 2);
  EXPECT_EQ(run("simulate beam.toml -o out --overwrite --threads 1").out, made.out);
}

TEST_F(ExperimentProgram, SchemeOptionReachesTheSolver) {
  static_cast<void>(folder_.write("beam.toml", kBeam));
  const ProgramRun made = run("simulate beam.toml -o out --scheme modes");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("frequency 6 "), std::string::npos) << made.out;
}

TEST_F(ExperimentProgram, ValidatePassesAndFailsByItsGates) {
  write_beam("right.toml", -0.004004546 * 40);
  write_beam("wrong.toml", -0.004004546 * 40 * 1.05);
  const ProgramRun right = run("validate right.toml");
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  EXPECT_NE(right.out.find("pass  a book"), std::string::npos) << right.out;
  const ProgramRun wrong = run("validate right.toml wrong.toml");
  EXPECT_EQ(wrong.exit_code, 1) << wrong.out;
  EXPECT_NE(wrong.out.find("FAIL  a book"), std::string::npos) << wrong.out;
  const ProgramRun json = run("validate wrong.toml --json");
  EXPECT_EQ(json.exit_code, 1);
  EXPECT_NE(json.out.find("\"passed\": false"), std::string::npos) << json.out;
}

TEST_F(ExperimentProgram, ValidateSaysHowFarABodyCarriedItsLoad) {
  std::string text = kBeam;
  text.replace(text.find("young = 1000"), 12, "young = 0.10");
  static_cast<void>(
      folder_.write("weak.toml", text + "[solver]\nscheme = \"static\"\nload_steps = 1\n[experiment]\nmodels = "
                                        "[\"tensile\"]\n[[expect]]\nquantity = \"tip.displacement.y\"\n"
                                        "source = \"none\"\nvalue = 1\n"));
  const ProgramRun made = run("validate weak.toml");
  EXPECT_NE(made.out.find("not measured: no equilibrium found beyond"), std::string::npos) << made.out << made.err;
}

TEST_F(ExperimentProgram, ValidatePrintsTheTableOfEquations) {
  const ProgramRun made = run("validate --case equations");
  EXPECT_EQ(made.exit_code, 0) << made.out;
  EXPECT_NE(made.out.find("M1 cube, corrected"), std::string::npos) << made.out;
  EXPECT_NE(run("validate --case equations --model m1").err.find("does not cover that choice"), std::string::npos);
}

TEST_F(ExperimentProgram, StaticsWarnOfBricksThatAreInverted) {
  static_cast<void>(folder_.write("pushed.toml", R"(duration = 0.1
fps = 24
[[body]]
box = [0.08, 0.02, 0.02]
brick_size = 0.01
material = { young = 1e4, poisson = 0.3, density = 1000 }
[[body.pin]]
box = { min = [0, 0, 0], max = [0.1, 1, 1] }
[[body.pin]]
box = { min = [0.9, 0, 0], max = [1, 1, 1] }
keyframes = [{ t = 0 }, { t = 0.1, translate = [-0.078, 0, 0] }]
)"));
  const ProgramRun pushed = run("simulate pushed.toml -o pushed.h5 --scheme static --set body.model=tensile");
  EXPECT_EQ(pushed.exit_code, 0) << pushed.err;
  EXPECT_NE(pushed.err.find("are inverted at the end"), std::string::npos) << pushed.err;
}

TEST_F(ExperimentProgram, RefusesWhatItsSolversCannotDo) {
  const std::string two_bodies = kBeam + "[[body]]\nbox = [0.4, 0.1, 0.1]\nbricks = 4\n";
  static_cast<void>(folder_.write("two.toml", two_bodies + "[solver]\nscheme = \"modes\"\n"));
  const ProgramRun modes = run("simulate two.toml -o out");
  EXPECT_EQ(modes.exit_code, 3);
  EXPECT_NE(modes.err.find("modes are computed for one body; the scene has 2"), std::string::npos) << modes.err;
  static_cast<void>(folder_.write("ground.toml", kBeam + "[[obstacle]]\nplane = { y = 0 }\n"));
  const ProgramRun ground = run("simulate ground.toml -o out --scheme static");
  EXPECT_EQ(ground.exit_code, 3);
  EXPECT_NE(ground.err.find("only a motion (scheme euler or verlet) meets obstacles"), std::string::npos) << ground.err;
}

/// Pinned at its lowest part or, in the scenario hang, its highest; no ground.
TEST_F(ExperimentProgram, ABareMeshRestsInAStaticScheme) {
  static_cast<void>(folder_.write("cube.obj", kCubeObj));
  for (const std::string scenario : {"drop", "hang", "tumble"}) {
    const ProgramRun done = run("simulate cube.obj -o " + scenario +
                                ".h5 --bricks 4 --duration 0.1 --scheme static --scenario " + scenario);
    EXPECT_EQ(done.exit_code, 0) << scenario << done.err;
  }
}

TEST_F(ExperimentProgram, WhatIsTypedWinsOverTheScenario) {
  static_cast<void>(folder_.write("cube.obj", kCubeObj));
  const ProgramRun floating =
      run("simulate cube.obj -o f.h5 --print-scene --set 'obstacle=[]' --set 'body.position=[0,3,0]'");
  EXPECT_EQ(floating.exit_code, 0) << floating.err;
  EXPECT_EQ(floating.out.find("[[obstacle]]"), std::string::npos) << floating.out;
  EXPECT_NE(floating.out.find("position = [0, 3, 0]"), std::string::npos) << floating.out;
}

TEST_F(ExperimentProgram, OneRatioForAllMaterialsOfABody) {
  std::string text = kBeam;
  text.insert(
      text.find("[[probe]]"),
      "  [[body.region]]\n  box = { min = [0, 0, 0], max = [0.5, 1, 1] }\n  material = { young = 1000, poisson = "
      "0.3, density = 40 }\n");
  static_cast<void>(folder_.write("parts.toml", text));
  const ProgramRun made = run("simulate parts.toml -o out --scheme linear --poisson 0.4");
  EXPECT_EQ(made.exit_code, 3);
  EXPECT_NE(made.err.find("a region has the Poisson's ratio 0.3, its body 0.4"), std::string::npos) << made.err;
}

TEST_F(ExperimentProgram, ValidateNamesWhatItDoesNotKnow) {
  EXPECT_EQ(run("validate --case cantilevr").exit_code, 2);
  EXPECT_NE(run("validate --case cantilevr").err.find("did you mean 'cantilever'?"), std::string::npos);
  static_cast<void>(folder_.write("beam.toml", kBeam));
  EXPECT_EQ(run("validate beam.toml").exit_code, 3);
  EXPECT_EQ(run("validate --model tensil").exit_code, 2);
  EXPECT_NE(run("validate --list").out.find("torsion"), std::string::npos);
}

TEST_F(ExperimentProgram, BuiltInExperimentsHold) {
  const ProgramRun made = run("validate --case stretch --case shear --case cantilever_c3d8i --case cantilever_c3d8");
  EXPECT_EQ(made.exit_code, 0) << made.out << made.err;
  EXPECT_EQ(made.out.find("FAIL"), std::string::npos) << made.out;
}

}  // namespace
}  // namespace sprung
