#include "app/scene/scene_file.h"

#include <gtest/gtest.h>

#include "tests/support/error_message.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

const std::string kWholeScene = R"(duration = "1500 ms"
fps = 30
gravity = [0, "-1.62 m/s2", 0]

[[body]]
mesh = "cube.obj"
size = "12 cm"
position = [0, 0.3, "-2 cm"]
rotation = [0, 30, 15.5]
bricks = 12
material = { young = "20 kPa", poisson = 0.4, density = "1.1 g/cm3", damping = 0.01 }
model = "tensile"
color = "#d8322a"
velocity = [1, 0, 0]
  [[body.pin]]
  name = "foot"
  box = { min = [0, 0, 0], max = [1, 0.1, 1] }
  axes = "xz"
  translate = [0, 0, "1 cm"]
  rotate = [0, 90, 0]
  [[body.pin]]
  box = { min = [0, 0.9, 0], max = [1, 1, 1] }
  keyframes = [{ t = "500 ms" }, { t = 1, translate = [0, 0.1, 0], rotate = [0, 0, 360], scale = 0.5 }]
  interpolation = "smooth"
  from = 0.25
  until = 1.25
  [[body.region]]
  box = { min = [0, 0.5, 0], max = [1, 1, 1] }
  material = { young = "80 kPa", poisson = 0.4, density = 1300 }

[[body]]
mesh = "cube.obj"
scale = 0.01
brick_size = "5 mm"
material = "rubber"

[[body]]
box = [0.3, "20 cm", 0.1]
bricks = 3
  [[body.cut]]
  box = { min = [0.34, 0, 0], max = [1, 0.5, 1] }

[[obstacle]]
plane = { y = -1 }
friction = 0.7
restitution = 0.1

[[probe]]
name = "foot"
pin = "foot"
[[probe]]
name = "middle"
body = 3
point = [0, 0, 0]

[experiment]
title = "all keys"
models = ["calibrated", "fem"]
poisson = [0.3, 0.4]
bricks = [4, 8]

[[expect]]
quantity = "foot.force.y"
value = 2.5
source = "nowhere"
poisson = [0.4]
  [[expect.gate]]
  bricks = [8]
  tolerance = 0.03
  [[expect.gate]]
  no_worse_than = "fem"

[solver]
scheme = "verlet"
load_steps = 7
modes = 3

[camera]
azimuth = 10
elevation = 20
orbit = 30
[render]
resolution = [320, 240]
samples = 1
)";

class SceneFile : public testing::Test {
 protected:
  [[nodiscard]] Film parse(const std::string& text) const { return parse_scene(text, folder_.path() / "scene.toml"); }

  [[nodiscard]] std::string mistakes(const std::string& text) const {
    return error_message([&] { static_cast<void>(parse(text)); });
  }

  /// The scene with one body whose table has these further lines; they begin in line 3.
  [[nodiscard]] std::string body_mistakes(const std::string& lines) const {
    return mistakes("[[body]]\nmesh = \"cube.obj\"\n" + lines);
  }

  TempFolder folder_;
  std::filesystem::path cube_ = folder_.write("cube.obj", kCubeObj);
};

TEST_F(SceneFile, ReadsWhatIsWritten) {
  const Film scene = parse(kWholeScene);
  EXPECT_DOUBLE_EQ(scene.duration, 1.5);
  EXPECT_DOUBLE_EQ(scene.fps, 30);
  EXPECT_DOUBLE_EQ(scene.gravity.y(), -1.62);
  EXPECT_EQ(scene.solver.scheme, Solver::kVerlet);
  ASSERT_EQ(scene.bodies.size(), 3U);
  const SceneBody& body = scene.bodies[0];
  EXPECT_EQ(body.mesh, cube_);
  EXPECT_DOUBLE_EQ(body.size.value(), 0.12);
  EXPECT_EQ(body.position, Vec3(0, 0.3, -0.02));
  EXPECT_EQ(body.rotation, Vec3(0, 30, 15.5));
  EXPECT_EQ(body.bricks, 12);
  EXPECT_DOUBLE_EQ(body.material.young, 20e3);
  EXPECT_DOUBLE_EQ(body.material.density, 1100);
  EXPECT_EQ(body.model, Model::kTensile);
  EXPECT_EQ(body.color.value().red, 0xd8);
  EXPECT_EQ(body.velocity, Vec3(1, 0, 0));
  ASSERT_EQ(body.pins.size(), 2U);
  EXPECT_EQ(body.pins[0].box->max, Vec3(1, 0.1, 1));
  EXPECT_DOUBLE_EQ(scene.bodies[1].scale.value(), 0.01);
  EXPECT_DOUBLE_EQ(scene.bodies[1].brick_size.value(), 0.005);
  EXPECT_EQ(scene.bodies[1].material.name, "rubber");
  ASSERT_EQ(scene.obstacles.size(), 1U);
  EXPECT_DOUBLE_EQ(scene.obstacles[0].plane->y, -1);
  EXPECT_DOUBLE_EQ(scene.obstacles[0].friction, 0.7);
  EXPECT_DOUBLE_EQ(scene.camera.orbit, 30);
  EXPECT_EQ(scene.render.resolution, (std::array<int, 2>{320, 240}));
  EXPECT_EQ(scene.render.samples, 1);
}

TEST_F(SceneFile, ReadsWhatIsMeasuredAndExpected) {
  const Film scene = parse(kWholeScene);
  EXPECT_EQ(scene.solver.load_steps, 7);
  EXPECT_EQ(scene.solver.modes, 3);
  const Pin& pin = scene.bodies[0].pins.at(0);
  EXPECT_EQ(pin.name, "foot");
  EXPECT_EQ(pin.axes.fixed, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(pin.translate, Vec3(0, 0, 0.01));
  EXPECT_EQ(pin.rotate, Vec3(0, 90, 0));
  EXPECT_DOUBLE_EQ(scene.bodies[0].regions.at(0).material.young, 80e3);
  EXPECT_EQ(scene.bodies[2].box, Vec3(0.3, 0.2, 0.1));
  EXPECT_EQ(scene.bodies[2].cuts.at(0).box->max, Vec3(1, 0.5, 1));
  ASSERT_EQ(scene.probes.size(), 2U);
  EXPECT_EQ(scene.probes[0].pin, "foot");
  EXPECT_EQ(scene.probes[1].point, Vec3(0, 0, 0));
  EXPECT_EQ(scene.experiment.models, (std::vector<Model>{Model::kCalibrated, Model::kFem}));
  EXPECT_EQ(scene.experiment.bricks, (std::vector<int>{4, 8}));
  const Expectation& expectation = scene.expectations.at(0);
  EXPECT_DOUBLE_EQ(expectation.value, 2.5);
  EXPECT_EQ(expectation.gates.at(0).tolerance, 0.03);
  EXPECT_EQ(expectation.gates.at(1).no_worse_than, Model::kFem);
}

TEST_F(SceneFile, RefusesWhatCannotBeMeasuredOrHeld) {
  const std::string probe = "[[probe]]\nname = \"a\"\n";
  EXPECT_NE(body_mistakes(probe + "point = [0, 0, 0]\nnearest = [0, 0, 0]").find("give point or nearest, not both"),
            std::string::npos);
  EXPECT_NE(body_mistakes(probe + "pin = \"fot\"").find("the body has no pin 'fot'"), std::string::npos);
  EXPECT_NE(body_mistakes(probe + "body = 2\npoint = [0, 0, 0]").find("there is no body 2"), std::string::npos);
  EXPECT_NE(body_mistakes("box = [1, 1, 1]").find("give mesh or box, not both"), std::string::npos);
  EXPECT_NE(mistakes("[[body]]\nbox = [1, 0, 1]").find("above 0 m"), std::string::npos);
  const std::string pin = "[[body.pin]]\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\n";
  EXPECT_NE(body_mistakes(pin + "axes = \"xx\"").find("'xx' are not directions"), std::string::npos);
  const std::string region = "[[body.region]]\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\n";
  EXPECT_NE(body_mistakes(region + "material = { young = 1, poisson = 0.1, density = 1 }").find("Poisson's ratio 0.1"),
            std::string::npos);
  EXPECT_NE(mistakes("scheme = \"euler\"\n[[body]]\nmesh = \"cube.obj\"\n").find("unknown key 'scheme'"),
            std::string::npos);
  EXPECT_NE(body_mistakes("[solver]\nscheme = \"statc\"").find("did you mean 'static'?"), std::string::npos);
  EXPECT_NE(body_mistakes("[solver]\nscheme = \"static\"\n[[obstacle]]\nplane = { y = 0 }").find("[[obstacle]]"),
            std::string::npos);
}

TEST_F(SceneFile, PrintedSceneParsesToTheSameScene) {
  const std::string printed = print_scene(parse(kWholeScene));
  const Film again = parse(printed);
  EXPECT_EQ(print_scene(again), printed);
  EXPECT_EQ(again.bodies[0].mesh, cube_);
  EXPECT_EQ(again.bodies[0].position, Vec3(0, 0.3, -0.02));
  EXPECT_DOUBLE_EQ(again.bodies[0].material.young, 20e3);
  EXPECT_EQ(again.bodies[1].material.source, built_in_materials()->find("rubber").young_source);
  const Pin& pin = again.bodies[0].pins.at(1);
  EXPECT_DOUBLE_EQ(pin.keyframes.at(0).time, 0.5);
  EXPECT_EQ(pin.keyframes.at(1).rotate, Vec3(0, 0, 360));
  EXPECT_DOUBLE_EQ(pin.keyframes.at(1).scale, 0.5);
  EXPECT_EQ(pin.interpolation, Interpolation::kSmooth);
  EXPECT_DOUBLE_EQ(pin.from, 0.25);
  EXPECT_DOUBLE_EQ(pin.until.value(), 1.25);
  EXPECT_EQ(again.solver.scheme, Solver::kVerlet);
  EXPECT_DOUBLE_EQ(again.obstacles.at(0).restitution, 0.1);
  // TOML has no whole number -0.
  const Film zero = parse("[[body]]\nbox = [1, 1, 1]\nbricks = 4\nposition = [-0.0, 0, 0]\n");
  EXPECT_EQ(print_scene(parse(print_scene(zero))), print_scene(zero));
}

TEST_F(SceneFile, PrintedPathsWithQuotesParse) {
  const auto odd = folder_.write("a \"b\\c.obj", kCubeObj);
  Film scene = parse(kWholeScene);
  scene.bodies[0].mesh = odd;
  EXPECT_EQ(parse(print_scene(scene)).bodies[0].mesh, odd);
}

TEST_F(SceneFile, AllMistakesInOneRunWithTheirPlaces) {
  const std::string text = mistakes(
      "duration = \"3 parsec\"\n"
      "fbs = 24\n"
      "[[body]]\n"
      "mesh = \"missing.obj\"\n"
      "bricks = 0\n"
      "material = \"gelatine\"\n"
      "  [body.pim]\n");
  EXPECT_NE(text.find("scene.toml:1:12: duration: '3 parsec'"), std::string::npos) << text;
  EXPECT_NE(text.find("scene.toml:2:1: unknown key 'fbs'; did you mean 'fps'?"), std::string::npos) << text;
  EXPECT_NE(text.find("scene.toml:4:8: body.mesh: "), std::string::npos) << text;
  EXPECT_NE(text.find("no such file"), std::string::npos) << text;
  EXPECT_NE(text.find("scene.toml:5:10: body.bricks: 0 is out of range"), std::string::npos) << text;
  EXPECT_NE(text.find("scene.toml:6:12: body.material: there is no material 'gelatine'; did you mean 'gelatin'?"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("unknown key 'body.pim'; did you mean 'pin'?"), std::string::npos) << text;
}

TEST_F(SceneFile, WrongTypesAreNamed) {
  EXPECT_NE(body_mistakes("bricks = 2.5").find(":3:10: body.bricks: must be a whole number, not a number"),
            std::string::npos);
  EXPECT_NE(body_mistakes("size = true").find("must be a number or a string with a unit, not true or false"),
            std::string::npos);
  EXPECT_NE(body_mistakes("position = [1, 2]").find("must be an array of 3 numbers, not an array of 2"),
            std::string::npos);
  EXPECT_NE(body_mistakes("color = \"red\"").find("\"#rrggbb\""), std::string::npos);
  EXPECT_NE(body_mistakes("material = 3").find("the name of a material or a table"), std::string::npos);
  EXPECT_NE(mistakes("body = 3").find("[[body]]"), std::string::npos);
  EXPECT_NE(mistakes("fps = [").find("scene.toml:1:"), std::string::npos);
}

TEST_F(SceneFile, WhatExcludesEachOtherOrIsMissing) {
  EXPECT_NE(body_mistakes("size = 1\nscale = 2").find(":4:9: body: give size or scale, not both"), std::string::npos);
  EXPECT_NE(body_mistakes("bricks = 1\nbrick_size = 2").find("give bricks or brick_size"), std::string::npos);
  EXPECT_NE(body_mistakes("material = { young = 3 }").find("body.material lacks the key 'poisson'"), std::string::npos);
  EXPECT_NE(mistakes("[[body]]\n").find(":1:1: body lacks the key 'mesh' or 'box'"), std::string::npos);
  EXPECT_NE(mistakes("fps = 24").find("the scene lacks the key 'body'"), std::string::npos);
  EXPECT_NE(body_mistakes("[render]\nsamples = 3").find("3 is not one of 1, 4"), std::string::npos);
  EXPECT_NE(body_mistakes("pin = [{ box = { min = [0, 0, 0], max = [-1, 1, 1] } }]").find("min must not be above"),
            std::string::npos);
  EXPECT_EQ(body_mistakes("pin = [{ box = { min = [0, 0, 0], max = [0, 1, 1] } }]"), "");  // a face
  const std::string plane = "[[obstacle]]\nplane = { y = 0 }\n";
  EXPECT_EQ(body_mistakes(plane), "");
  EXPECT_NE(body_mistakes("[[obstacle]]\nplane = { y = 0 }\nbox = [1, 1, 1]\n").find("obstacle"), std::string::npos);
  EXPECT_NE(body_mistakes("[[obstacle]]\nbox = [1, 1, 1]\nsize = 2\n").find("mesh"), std::string::npos);
  EXPECT_NE(body_mistakes("[[obstacle]]\nmesh = \"torus.ply\"\n").find("'size' or 'scale'"), std::string::npos);
  EXPECT_NE(body_mistakes(plane + "keyframes = [{ t = 1, scale = 2 }]\n").find("keeps its size"), std::string::npos);
  EXPECT_NE(body_mistakes(plane + "interpolation = \"held\"\n").find("cannot jump"), std::string::npos);
}

TEST_F(SceneFile, RangesAreKept) {
  EXPECT_NE(mistakes("fps = 0").find("above 0 fps"), std::string::npos);
  EXPECT_NE(mistakes("duration = nan").find("not a finite number"), std::string::npos);
  EXPECT_NE(body_mistakes("material = { young = 1, poisson = 0.5, density = 1 }").find("above -1 and below 0.5"),
            std::string::npos);
  EXPECT_NE(body_mistakes("size = \"-3 cm\"").find("at least 1e-06 m"), std::string::npos);
}

TEST(SceneFrames, ShowTimesFromZero) {
  Film scene;
  scene.duration = 1;
  scene.fps = 24;
  EXPECT_EQ(frame_count(scene), 24);
  scene.duration = 0.001;
  EXPECT_EQ(frame_count(scene), 1);
}

}  // namespace
}  // namespace sprung
