#include <gtest/gtest.h>

#include "app/scene/scene_file.h"
#include "core/error.h"
#include "tests/support/error_message.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

Film two_bodies() {
  return parse_scene(
      "[[body]]\nmesh = \"a.obj\"\nsize = 0.1\n[[body]]\nmesh = \"b.obj\"\nscale = 0.01\nmaterial = \"rubber\"\n",
      "/scene.toml", SceneFiles::kAnywhere);
}

TEST(SetSceneKey, SetsItInEveryBody) {
  Film scene = two_bodies();
  set_scene_key(scene, "body.size", "30 cm");
  set_scene_key(scene, "body.material.young", "5 kPa");
  for (const SceneBody& body : scene.bodies) {
    EXPECT_DOUBLE_EQ(body.size.value(), 0.3);
    EXPECT_FALSE(body.scale.has_value());
    EXPECT_DOUBLE_EQ(body.material.young, 5e3);
  }
  EXPECT_EQ(scene.bodies[1].material.name, "custom");
  EXPECT_DOUBLE_EQ(scene.bodies[1].material.density, built_in_materials()->find("rubber").density);
}

TEST(SetSceneKey, WordsMayHaveTheQuotesOfASceneFile) {
  Film scene = two_bodies();
  set_scene_key(scene, "body.material.young", "\"7 kPa\"");
  EXPECT_DOUBLE_EQ(scene.bodies[0].material.young, 7e3);
  set_scene_key(scene, "solver.scheme", "'verlet'");
  EXPECT_EQ(scene.solver.scheme, Solver::kVerlet);
  set_scene_key(scene, "render.caption", "\"soft\" and \"stiff\"");
  EXPECT_EQ(scene.render.caption, "\"soft\" and \"stiff\"");
}

TEST(SetSceneKey, PairsAreWrittenInThreeWays) {
  Film scene = two_bodies();
  set_scene_key(scene, "render.resolution", "640x360");
  EXPECT_EQ(scene.render.resolution, (std::array<int, 2>{640, 360}));
  for (const char* pair : {"3x2", "[3, 2]", "3,2"}) {
    scene.render.sheet.reset();
    set_scene_key(scene, "render.sheet", pair);
    EXPECT_EQ(scene.render.sheet.value(), (std::array<int, 2>{3, 2})) << pair;
  }
  EXPECT_EQ(error_message([&] { set_scene_key(scene, "render.sheet", "[3]"); }),
            "'[3]' is not a pair of whole numbers; write two, as in 1280x720 or [1280, 720]");
}

TEST(SetSceneKey, SwitchesAreTrueOrOn) {
  Film scene = two_bodies();
  EXPECT_TRUE(scene.render.smooth);
  set_scene_key(scene, "render.smooth", "off");
  EXPECT_FALSE(scene.render.smooth);
  set_scene_key(scene, "render.smooth", "on");
  EXPECT_TRUE(scene.render.smooth);
  EXPECT_EQ(error_message([&] { set_scene_key(scene, "render.smooth", "yes"); }), "must be true or false, not 'yes'");
}

TEST(SetSceneKey, RefusesWhatIsNoKeyOfAValue) {
  Film scene = two_bodies();
  EXPECT_NE(error_message([&] { set_scene_key(scene, "body.sise", "1"); }).find("did you mean 'size'"),
            std::string::npos);
  EXPECT_THROW(set_scene_key(scene, "body", "1"), Error);
  EXPECT_EQ(error_message([&] { set_scene_key(scene, "body.yung", "1"); }),
            "unknown key 'yung'; did you mean 'body.material.young'?");
  EXPECT_NE(error_message([&] { set_scene_key(scene, "zoom", "1"); }).find("did you mean 'camera.zoom'"),
            std::string::npos);
}

TEST(SetWhereOpen, LeavesWhatTheFileSaysAndWhatExcludesIt) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const std::filesystem::path file = folder.write("scene.toml", R"(
fps = 30
[render]
caption = "its own"
[[body]]
mesh = "cube.obj"
size = "30 cm"
material = "silicone-a10"
[[body]]
mesh = "cube.obj"
brick_size = "1 cm"
material = { young = "20 kPa", poisson = 0.4, density = 1000 }
)");
  Film scene = read_scene(file);
  const auto set = [&](std::string_view path, std::string_view text) { set_if_unset(scene, file, path, text); };
  set("fps", "25");
  set("duration", "2 s");
  set("render.caption", "ACME");
  set("render.quality", "high");
  set("camera.azimuth", "45");
  set("body.bricks", "40");
  set("body.size", "10 cm");
  set("body.material.young", "5 kPa");
  EXPECT_EQ(scene.fps, 30);
  EXPECT_EQ(scene.duration, 2);
  EXPECT_EQ(scene.render.caption, "its own");
  EXPECT_EQ(scene.render.quality, Quality::kHigh);
  EXPECT_EQ(scene.camera.azimuth, 45);
  EXPECT_EQ(scene.bodies[0].size, 0.3);
  EXPECT_EQ(scene.bodies[1].size, 0.1);
  EXPECT_EQ(scene.bodies[0].bricks.value().along, 40);
  EXPECT_EQ(scene.bodies[1].brick_size, 0.01) << "which excludes bricks";
  EXPECT_EQ(scene.bodies[0].material.young, built_in_materials()->named("silicone-a10").young);
  EXPECT_EQ(scene.bodies[1].material.young, 20e3);
}

}  // namespace
}  // namespace sprung
