#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "app/scene/scene_file.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"
#include "tests/support/temp_folder.h"

/// The part of a body that pins, regions and cuts select.
namespace sprung {
namespace {

/// 1 m, 4 bricks along each side.
const std::string kBox = R"(
[[body]]
box = [1, 1, 1]
bricks = 4
material = { young = 1000, poisson = 0.3, density = 100 }
)";
const std::string kStiff = "material = { young = 5000, poisson = 0.3, density = 300 }\n";

/// A cube of 2 m about (11, 1, 1) whose upper face is a part of its own, its upper vertices red.
const std::string kPaintedPly = R"(ply
format ascii 1.0
element vertex 8
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 6
property list uchar int vertex_indices
end_header
10 0 0 0 0 255
12 0 0 0 0 255
12 0 2 0 0 255
10 0 2 0 0 255
10 2 0 255 0 0
12 2 0 255 0 0
12 2 2 255 0 0
10 2 2 255 0 0
4 0 1 2 3
4 4 7 6 5
4 0 4 5 1
4 1 5 6 2
4 2 6 7 3
4 3 7 4 0
)";
const std::string kTwoPartsObj = R"(v 10 0 0
v 12 0 0
v 12 0 2
v 10 0 2
v 10 2 0
v 12 2 0
v 12 2 2
v 10 2 2
o walls
f 1 2 3 4
f 1 5 6 2
f 2 6 7 3
f 3 7 8 4
f 4 8 5 1
o lid
f 5 8 7 6
)";

class SelectorTest : public testing::Test {
 protected:
  [[nodiscard]] Simulation produce(const std::string& text) const {
    const Observer silent;
    return prepare_simulation(parse_scene(text, folder_.path() / "scene.toml"), silent);
  }

  /// A body of that mesh, 2 m high, on 4 bricks a side.
  [[nodiscard]] std::string mesh_body(const std::string& name, const std::string& text) {
    static_cast<void>(folder_.write(name, text));
    return "[[body]]\nmesh = \"" + name + "\"\nscale = 1\nbricks = 4\nmaterial = { young = 1000, poisson = 0.3, " +
           "density = 100 }\n";
  }

  /// Positions of the nodes that the only pin holds, in a body whose middle is at (0, half its height, 0).
  [[nodiscard]] std::vector<Vec3> pinned(const std::string& body, const std::string& selection) const {
    const Simulation simulation = produce(body + "[[body.pin]]\n" + selection);
    const SoftBody& made = simulation.world.bodies.at(0);
    std::vector<Vec3> places;
    for (const KinematicNode& node : made.pinned) places.emplace_back(made.rest_positions.row(node.node));
    return places;
  }

  /// How many bricks are five times as stiff as the others.
  [[nodiscard]] long stiff_bricks(const std::string& body, const std::string& selection) const {
    const Simulation simulation = produce(body + "[[body.region]]\n" + selection + kStiff);
    const std::vector<double>& scale = simulation.world.bodies.at(0).stiffness_scale;
    return std::count_if(scale.begin(), scale.end(), [](double value) { return std::abs(value - 5) < 1e-9; });
  }

  TempFolder folder_;
};

TEST_F(SelectorTest, BallsHalfSpacesAndSingleNodes) {
  EXPECT_EQ(pinned(kBox, "sphere = { center = [0, 0, 0], radius = 0.3 }").size(), 7U);
  EXPECT_EQ(pinned(kBox, "half_space = { point = [0.5, 0.75, 0.5], normal = [0, 2, 0] }").size(), 50U);
  const std::vector<Vec3> corner = pinned(kBox, "nearest = [0.9, 1, 1.2]");
  ASSERT_EQ(corner.size(), 1U);
  EXPECT_LT((corner[0] - Vec3(0.5, 1, 0.5)).norm(), 1e-12);
}

TEST_F(SelectorTest, RegionsHaveTheBricksWhoseMiddlesAreInThem) {
  EXPECT_EQ(stiff_bricks(kBox, "sphere = { center = [0, 0, 0], radius = 0.3 }\n"), 1);
  EXPECT_EQ(stiff_bricks(kBox, "sphere = { center = [0, 0, 0], radius = 0.42 }\n"), 4);
  EXPECT_EQ(stiff_bricks(kBox, "half_space = { point = [0, 0.5, 0], normal = [0, -1, 0] }\n"), 32);
  EXPECT_EQ(stiff_bricks(kBox, "nearest = [0.6, 0.6, 0.6]\n"), 1);
  EXPECT_EQ(stiff_bricks(kBox, "box = { min = [0, 0, 0], max = [1, 0.25, 1] }\n"), 16);
}

TEST_F(SelectorTest, NamedPartsAndPaint) {
  for (const auto& [body, selection] : {std::pair{mesh_body("parts.obj", kTwoPartsObj), "part = \"lid\"\n"},
                                        std::pair{mesh_body("paint.ply", kPaintedPly), "painted = \"#ff0000\"\n"}}) {
    // What is nearest to the lid: a pyramid down to the middle; to the paint: the upper half. Pins only hold its skin.
    const std::vector<Vec3> positions = pinned(body, selection);
    EXPECT_GE(positions.size(), 25U) << selection;
    for (const Vec3& position : positions) EXPECT_GE(position.y(), 1) << selection;
    EXPECT_EQ(
        std::count_if(positions.begin(), positions.end(), [](const Vec3& position) { return position.y() > 1.99; }),
        25);
  }
  EXPECT_EQ(stiff_bricks(mesh_body("paint.ply", kPaintedPly), "painted = \"#ff0000\"\n"), 32);
}

TEST_F(SelectorTest, WhatAMeshEnclosesInTheFrameOfTheBodysOwn) {
  static_cast<void>(folder_.write("part.obj", R"(v 9 -1 -1
v 11.01 -1 -1
v 11.01 -1 3
v 9 -1 3
v 9 3 -1
v 11.01 3 -1
v 11.01 3 3
v 9 3 3
f 1 2 3 4
f 1 5 6 2
f 2 6 7 3
f 3 7 8 4
f 4 8 5 1
f 5 8 7 6
)"));
  const std::string body = mesh_body("parts.obj", kTwoPartsObj);
  EXPECT_EQ(stiff_bricks(body, "mesh = \"part.obj\"\n"), 32);
  EXPECT_EQ(stiff_bricks(body + "rotation = [10, 20, 30]\nbrick_rotation = [0, 90, 0]\n", "mesh = \"part.obj\"\n"), 32);
  for (const Vec3& position : pinned(body, "mesh = \"part.obj\"\n")) EXPECT_LT(position.x(), 0.02);
}

TEST_F(SelectorTest, GradientsAreLinearBetweenTwoMaterials) {
  const Simulation simulation = produce(kBox + R"([[body.region]]
material = { young = 1000, poisson = 0.3, density = 100 }
[body.region.gradient]
from = [0, 0.25, 0]
to = [0, 1, 0]
material = { young = 4000, poisson = 0.3, density = 400 }
)");
  const Body& body = simulation.world.bodies.at(0);
  for (std::size_t brick = 0; brick < body.grid.cells.size(); ++brick) {
    const double height = 0.25 * (body.grid.cells[brick].y() + 0.5);
    const double share = std::max(0.0, (height - 0.25) / 0.75);
    EXPECT_NEAR(body.stiffness_scale[brick], 1 + 3 * share, 1e-12);
  }
  EXPECT_NEAR(body.masses.sum(), 100 * (1 + 3 * (0.125 + 0.375 + 0.625) / 0.75 / 4), 1e-9);
}

TEST_F(SelectorTest, CutsTakeWhateverPartOfABox) {
  const Simulation simulation = produce(kBox + "[[body.cut]]\nsphere = { center = [0, 0, 0], radius = 0.42 }\n");
  EXPECT_EQ(simulation.world.bodies.at(0).grid.brick_count(), 60);
}

TEST_F(SelectorTest, WhatIsNotThereIsRefused) {
  const auto mistake = [&](const std::string& text) {
    return error_message([&] { static_cast<void>(produce(text)); });
  };
  const std::string parts = mesh_body("parts.obj", kTwoPartsObj);
  EXPECT_NE(mistake(parts + "[[body.pin]]\npart = \"lit\"").find("has no part 'lit'; did you mean 'lid'?"),
            std::string::npos);
  EXPECT_NE(mistake(parts + "[[body.pin]]\npainted = \"#ff0000\"").find("no vertex colours at all"), std::string::npos);
  EXPECT_NE(mistake(kBox + "[[body.pin]]\n").find("body.pin lacks the key 'box' or 'sphere'"), std::string::npos);
  EXPECT_NE(mistake(kBox + "[[body.pin]]\npart = \"a\"\nnearest = [0, 0, 0]").find("give part or nearest, not both"),
            std::string::npos);
  EXPECT_NE(mistake(kBox + "[[body.region]]\n" + kStiff).find("body.region lacks the key 'box'"), std::string::npos);
  EXPECT_NE(mistake(kBox + "[[body.pin]]\nhalf_space = { point = [0, 0, 0], normal = [0, 0, 0] }")
                .find("must point somewhere"),
            std::string::npos);
  EXPECT_NE(mistake(kBox + "[[body.region]]\n" + kStiff +
                    "gradient = { from = [0, 0, 0], to = [1, 1, 1], material = \"rubber\" }")
                .find("Poisson's ratio"),
            std::string::npos);
  EXPECT_NE(mistake(kBox + "[[body.region]]\nbox = { min = [0, 0, 0], max = [0, 1, 1] }\n" + kStiff)
                .find("its region 1 holds the middle of no brick"),
            std::string::npos);
}

}  // namespace
}  // namespace sprung
