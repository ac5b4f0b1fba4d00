#include <gtest/gtest.h>

#include <cmath>

#include "app/film/field_colors.h"
#include "app/scene/scene_file.h"
#include "core/simulation/simulation.h"

namespace sprung {
namespace {

constexpr double kStretch = 1.2;
constexpr double kYoung = 20e3;
constexpr double kFps = 4;

/// A bar that is stretched along x, by kStretch, and has moved 10 cm further in the next frame.
struct DrawnBar {
  Simulation simulation;
  Recording recording;

  DrawnBar() {
    simulation =
        prepare_simulation(parse_scene("[[body]]\nbox = [\"20 cm\", \"10 cm\", \"10 cm\"]\nbrick_size = \"5 cm\"\n"
                                       "material = { young = \"20 kPa\", poisson = 0.25, density = 1000 }\n",
                                       "/scene.toml"),
                           Observer());
    Points nodes = simulation.world.bodies[0].rest_positions;
    nodes.col(0) *= kStretch;
    recording.frames.push_back({nodes.cast<float>()});
    nodes.col(1).array() += 0.1;
    recording.frames.push_back({nodes.cast<float>()});
  }
  [[nodiscard]] Eigen::VectorXd values(Field field) const {
    return field_values(field, simulation, recording, 0, 0, kFps);
  }
};

// Closed forms, the same at every node but for the displacement.
TEST(FieldValues, AreThoseOfADrawnBar) {
  const DrawnBar bar;
  const double e = (kStretch * kStretch - 1) / 2;
  const double shear = 0.4 * kYoung;  // at a ratio of 1/4 both of Lame's constants are that
  const double along = shear * (kStretch * kStretch - 1) / kStretch + shear * (kStretch - 1);  // neo-Hooke's
  const double across = shear * (kStretch - 1);
  const std::vector<std::pair<Field, double>> expected{{Field::kSpeed, 0.1 * kFps}, {Field::kStretch, kStretch},
                                                       {Field::kStrain, 2 * e / 3}, {Field::kStress, along - across},
                                                       {Field::kVolume, kStretch},  {Field::kFill, 1},
                                                       {Field::kRegion, kYoung}};
  for (const auto& [field, value] : expected) {
    const Eigen::VectorXd found = bar.values(field);
    ASSERT_EQ(found.size(), 5 * 3 * 3);
    EXPECT_LT((found.array() - value).abs().maxCoeff(), 1e-5 * value) << int(field);
  }
  EXPECT_NEAR(bar.values(Field::kDisplacement).maxCoeff(), 0.1 * (kStretch - 1), 1e-6);
  EXPECT_NEAR(bar.values(Field::kDisplacement).minCoeff(), 0, 1e-6);
}

// The bar is stretched twice as far in its last frame.
TEST(FieldColors, SpanTheFilmOrEachFrame) {
  DrawnBar bar;
  Points nodes = bar.simulation.world.bodies[0].rest_positions;
  nodes.col(0) *= 1 + 2 * (kStretch - 1);
  bar.recording.frames.push_back({nodes.cast<float>()});
  Film film;
  film.render.color_by = Field::kStretch;
  const auto highest = [&](std::size_t frame) {
    return FieldColors(film, bar.simulation, bar.recording).legend(frame).high;
  };
  EXPECT_NEAR(highest(0), 1.4, 1e-5);
  film.render.color_range = RangeOver::kFrame;
  EXPECT_NEAR(highest(0), kStretch, 1e-5);
  EXPECT_NEAR(highest(2), 1.4, 1e-5);
  const FieldColors colors(film, bar.simulation, bar.recording);
  EXPECT_NEAR(colors.map_coordinates(0, 0).maxCoeff(), 1, 1e-4);
  film.render.color_high = 2;
  EXPECT_EQ(highest(0), 2);
  film.render.color_high.reset();
  film.render.sheet = {3, 1};
  EXPECT_NEAR(highest(0), 1.4, 1e-5);
}

// A film of two frames next to one of three.
TEST(FieldColors, OfSeveralFilmsShowWhatAllShow) {
  const ColorRanges both = merged({{0, 2}, {1, 3}}, {{1, 4}, {0, 1}, {-1, 2}});
  ASSERT_EQ(both.size(), 3);
  EXPECT_EQ(both[0].high, 4);
  EXPECT_EQ(both[1].low, 0);
  EXPECT_EQ(both[2].low, -1);
  EXPECT_EQ(both[2].high, 3);
}

}  // namespace
}  // namespace sprung
