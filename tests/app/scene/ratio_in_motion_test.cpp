#include <gtest/gtest.h>

#include "app/scene/scene_file.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"

namespace sprung {
namespace {

Film box_of(const std::string& material, const std::string& scheme) {
  return parse_scene("[solver]\nscheme = \"" + scheme + "\"\n[[body]]\nbox = [0.1, 0.1, 0.1]\nbricks = 2\nmaterial = " +
                         material + "\npin = [{ nearest = [0, 0, 0] }]\n",
                     "/scene.toml");
}

double simulated_ratio(const Film& scene) {
  return prepare_simulation(scene, Observer()).world.bodies.at(0).material.poisson;
}

const std::string kSoft = "{ young = 1e4, poisson = 0.499, poisson_in_motion = 0.46, density = 1000 }";

TEST(RatioInMotion, IsThatOfMotionsOnly) {
  const LibraryMaterial& gelatin = built_in_materials()->find("gelatin");
  ASSERT_TRUE(gelatin.poisson_in_motion);
  for (const char* scheme : {"euler", "verlet", "bdf2", "implicit-euler", "auto"}) {
    EXPECT_EQ(simulated_ratio(box_of("\"gelatin\"", scheme)), gelatin.poisson_in_motion) << scheme;
    EXPECT_EQ(simulated_ratio(box_of(kSoft, scheme)), 0.46) << scheme;
  }
  for (const char* scheme : {"static", "linear", "modes"}) {
    EXPECT_EQ(simulated_ratio(box_of("\"gelatin\"", scheme)), gelatin.poisson) << scheme;
    EXPECT_EQ(simulated_ratio(box_of(kSoft, scheme)), 0.499) << scheme;
  }
}

TEST(RatioInMotion, GivesWayToARatioThatIsSet) {
  Film scene = box_of("\"gelatin\"", "euler");
  set_scene_key(scene, "body.material.young", "30 kPa");
  EXPECT_EQ(simulated_ratio(scene), built_in_materials()->find("gelatin").poisson_in_motion);
  set_scene_key(scene, "body.material.poisson", "0.47");
  EXPECT_EQ(simulated_ratio(scene), 0.47);
  set_scene_key(scene, "body.material.poisson_in_motion", "0.3");
  EXPECT_EQ(simulated_ratio(scene), 0.3);
}

TEST(RatioInMotion, IsReadAsItWasPrinted) {
  for (const std::string& material : {std::string("\"gelatin\""), kSoft}) {
    const Film scene = box_of(material, "euler");
    const Film again = parse_scene(print_scene(scene), "/scene.toml");
    EXPECT_EQ(again.bodies[0].material.poisson, scene.bodies[0].material.poisson);
    EXPECT_EQ(again.bodies[0].material.poisson_in_motion, scene.bodies[0].material.poisson_in_motion);
  }
}

TEST(RatioInMotion, ARegionHasOneOfItsBody) {
  const auto scene = [](const std::string& ratios) {
    return "[[body]]\nbox = [0.1, 0.1, 0.1]\nbricks = 2\nmaterial = " + kSoft +
           "\nregion = [{ box = { min = [0, 0, 0], max = [1, 1, 1] }, material = { young = 2e4, density = 1000, " +
           ratios + " } }]\n";
  };
  const std::string refused = error_message([&] { static_cast<void>(parse_scene(scene("poisson = 0.3"), "/a.toml")); });
  EXPECT_NE(refused.find("its Poisson's ratio 0.3 is not that of the body, 0.499"), std::string::npos) << refused;
  for (const char* ratios : {"poisson = 0.46", "poisson = 0.499", "poisson = 0.499, poisson_in_motion = 0.46"}) {
    EXPECT_EQ(simulated_ratio(parse_scene(scene(ratios), "/scene.toml")), 0.46) << ratios;
  }
}

TEST(RatioInMotion, HasARange) {
  EXPECT_NE(
      error_message([] {
        static_cast<void>(box_of("{ young = 1e4, poisson = 0.4, poisson_in_motion = 0.5, density = 1000 }", "euler"));
      }).find("poisson_in_motion"),
      std::string::npos);
}

}  // namespace
}  // namespace sprung
