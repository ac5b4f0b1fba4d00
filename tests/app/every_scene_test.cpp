#include <gtest/gtest.h>

#include <algorithm>

#include "app/scene/scene_file.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/penetration.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> scenes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(SPRUNG_SOURCE_DIR "/assets/scenes")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// "stack", or "contact_stack" of the folder contact.
std::string name_of(const fs::path& scene) {
  const std::string folder = scene.parent_path().stem().string();
  return (folder == "scenes" ? "" : folder + "_") + scene.stem().string();
}

/// The first frame of every scene of assets/scenes with all its bricks; scene_facts_test.cpp checks the rest, and
/// tests/bench/scenes those about contact.
class EveryScene : public testing::TestWithParam<fs::path> {};

TEST_P(EveryScene, BeginsSoundly) {
  Film scene = read_scene(GetParam());
  set_scene_key(scene, "duration", std::to_string(1.5 / scene.fps));
  const test::PenetrationObserver silent;
  Simulation simulation = prepare_simulation(scene, silent);
  const Recording recording = simulate(simulation, scene, silent);
  EXPECT_EQ(recording.frames.size(), 2U);
  EXPECT_LT(silent.deepest(), 0.01 * simulation.size);
  for (const Crossings& frame : recording.crossings) EXPECT_LT(frame.depth, 0.01 * simulation.size);
  for (const SoftBody& body : simulation.world.bodies) {
    EXPECT_EQ(inverted_bricks(body), 0);
    EXPECT_NE(body.positions, body.rest_positions) << "nothing moves";
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryScene, testing::ValuesIn(scenes()),
                         [](const auto& scene) { return name_of(scene.param); });

}  // namespace
}  // namespace sprung
