#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/scene/scene_file.h"
#include "core/simulation/crossing_watch.h"
#include "render/image/png.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

using nlohmann::json;

/// A ball comes down on a needle, which pierces it: implicit steps do not guard against crossings.
constexpr const char* kNeedle = R"(duration = 0.2
fps = 50
solver.scheme = "implicit-euler"
[[body]]
sphere = { radius = "4 cm" }
position = [0.011, 0.125, 0.012]
velocity = [0, -1, 0]
bricks = 6
material = { young = "20 kPa", poisson = 0.35, density = 1000, damping = 0.08 }
[[obstacle]]
cylinder = { radius = "1 mm", height = "10 cm" }
position = [0, 0.05, 0]
[[obstacle]]
plane = {}
)";

/// Two bodies of coarse bricks meet, whose drawn skins are above their contact skins, the more the more they bend.
constexpr const char* kMeeting = R"(duration = 0.06
fps = 200
gravity = [0, 0, 0]
[[body]]
sphere = { radius = "2.2 cm" }
position = [0, 0, 0]
velocity = [0, 0, 1.4]
bricks = 6
material = { young = "25 kPa", poisson = 0.3, density = 900, damping = 0.12 }
[[body]]
torus = { radius = "1.7 cm", tube = "8 mm" }
position = [0.012, 0.006, 0.06]
rotation = [60, 20, 0]
velocity = [0, 0, -1.4]
bricks = 6
material = { young = "40 kPa", poisson = 0.3, density = 900, damping = 0.12 }
)";

class CrossingsOfARun : public testing::Test {
 protected:
  [[nodiscard]] ProgramRun run(const std::string& words) const { return run_program(folder_, words); }

  TempFolder folder_;
  std::filesystem::path scene_ = folder_.write("needle.toml", kNeedle);
};

TEST_F(CrossingsOfARun, AreToldWhileItRunsAndFromItsCache) {
  const ProgramRun made = run("simulate needle.toml -o run.h5 -o out/ --json --log-json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json frames = json::parse(made.out)["crossings"];
  ASSERT_EQ(frames.size(), 9U);
  const auto depth = [](const json& frame) { return frame["depth_m"].get<double>(); };
  const auto deepest =
      std::max_element(frames.begin(), frames.end(), [&](const json& a, const json& b) { return depth(a) < depth(b); });
  EXPECT_GT(depth(*deepest), 1e-3);
  EXPECT_LT(depth(*deepest), 0.03);
  EXPECT_NEAR((*deepest)["depth_percent"].get<double>(), 100 * depth(*deepest) / 0.08, 0.5);
  EXPECT_EQ((*deepest)["between"], "body 1 and obstacle 1");
  EXPECT_EQ((*deepest)["crossing_pairs_at_start"], 0);
  EXPECT_EQ(frames[0]["frame"], 2);
  EXPECT_EQ(frames[0]["crossing_pairs"], 0) << "still above the needle";
  EXPECT_NE(made.err.find("skins cross in"), std::string::npos) << made.err;
  EXPECT_EQ(json::parse(text_of(folder_.path() / "out" / "manifest.json"))["crossings"], frames);
  int told = 0;
  std::istringstream lines(made.err);
  for (std::string line; std::getline(lines, line);) {
    json event = json::parse(line);
    if (event["kind"] != "frame") continue;
    event.erase("kind");
    EXPECT_EQ(event, frames[told]);
    ++told;
  }
  EXPECT_EQ(told, 9);

  const ProgramRun found = run("inspect run.h5 --crossings --json --picture deepest.png");
  ASSERT_EQ(found.exit_code, 0) << found.err;
  EXPECT_EQ(json::parse(found.out), frames);
  EXPECT_EQ(read_png(folder_.path() / "deepest.png").width, 1800);
  const ProgramRun table = run("inspect run.h5 --crossings");
  EXPECT_NE(table.out.find("body 1 and obstacle 1"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find(", deepest in frame " + std::to_string((*deepest)["frame"].get<int>())), std::string::npos);
}

TEST_F(CrossingsOfARun, AreNotOfMeshesNorOfStatics) {
  const ProgramRun mesh = run("inspect needle.toml --crossings");
  EXPECT_EQ(mesh.exit_code, 2);
  EXPECT_NE(mesh.err.find("--crossings applies to a cache"), std::string::npos) << mesh.err;
  static_cast<void>(
      folder_.write("beam.toml",
                    "[solver]\nscheme = \"static\"\n[[body]]\nbox = [0.04, 0.01, 0.01]\nbrick_size = 0.01\n"
                    "material = \"silicone-a20\"\n[[body.pin]]\nbox = { min = [0, 0, 0], max = [0, 1, 1] }\n"));
  ASSERT_EQ(run("simulate beam.toml -o beam.h5").exit_code, 0);
  EXPECT_NE(run("inspect beam.h5 --crossings").err.find("applies to motions"), std::string::npos);
}

Simulation boxes(const std::string& contact, Film& film) {
  film = parse_scene(contact +
                         "[[body]]\nbox = [0.04, 0.04, 0.04]\nbrick_size = 0.01\nmaterial = \"silicone-a20\"\n"
                         "copies = { count = [1, 2, 1], spacing = [0, 0.039, 0] }\n[[obstacle]]\nplane = {}\n",
                     "/scene.toml", SceneFiles::kAnywhere);
  const Observer silent;
  return prepare_simulation(film, silent);
}

/// The two boxes overlap by 1 mm in the beginning.
TEST(CrossingWatch, TellsWhatCrossedAtTheStartApart) {
  Film scene;
  Simulation simulation = boxes("", scene);
  CrossingWatch watch(scene, simulation);
  std::vector<Points> nodes{simulation.world.bodies[0].positions, simulation.world.bodies[1].positions};
  const Crossings still = watch.look({&nodes[0], &nodes[1]}, 1, 0);
  EXPECT_EQ(still.pairs, 0);
  EXPECT_GT(still.pairs_at_start, 0);
  nodes[1].col(1).array() += 0.01;
  EXPECT_EQ(watch.look({&nodes[0], &nodes[1]}, 2, 0).pairs_at_start, 0) << "apart";
  // A different side than at the start enters the other box.
  nodes[1].col(0).array() += 0.038;
  nodes[1].col(1).array() -= 0.044;
  const Crossings beside = watch.look({&nodes[0], &nodes[1]}, 3, 0);
  EXPECT_GT(beside.pairs, 0);
  EXPECT_NEAR(beside.depth, 0.002, 1e-9);
  EXPECT_NEAR(beside.share, 0.05, 1e-6);
  EXPECT_EQ(beside.names, "body 1 and body 1, copy 2");
}

TEST(CrossingWatch, LooksBelowPlanesAndNotAtBodiesThatMayCross) {
  Film scene;
  Simulation simulation = boxes("[contact]\nbodies = false\n", scene);
  CrossingWatch watch(scene, simulation);
  std::vector<Points> nodes{simulation.world.bodies[0].positions, simulation.world.bodies[1].positions};
  EXPECT_EQ(watch.look({&nodes[0], &nodes[1]}, 1, 0).pairs_at_start, 0);
  nodes[0].col(1).array() -= 0.003;
  const Crossings below = watch.look({&nodes[0], &nodes[1]}, 2, 0);
  EXPECT_NEAR(below.depth, 0.003, 1e-9);
  EXPECT_EQ(below.names, "body 1 and obstacle 1");
}

TEST_F(CrossingsOfARun, AreBelowAMicrometreWhereCoarseBodiesMeet) {
  const std::filesystem::path scene = folder_.write("meeting.toml", kMeeting);
  const ProgramRun made = run("simulate " + scene.filename().string() + " -o run.h5 --json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json report = json::parse(made.out);
  ASSERT_FALSE(report["crossings"].empty());
  for (const json& frame : report["crossings"]) EXPECT_LT(frame["depth_m"].get<double>(), 1e-6) << frame;
}

}  // namespace
}  // namespace sprung
