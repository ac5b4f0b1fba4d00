#include <gtest/gtest.h>

#include "app/scene/film.h"
#include "core/dynamics/explicit/integrator.h"
#include "core/simulation/time_steps.h"
#include "tests/support/bodies.h"

namespace sprung {
namespace {

World block(double young) {
  World world;
  Body body = make_body(make_box_grid({8, 4, 4}, 0.01), Model::kCalibrated, test::test_material(0.3, young));
  SoftBody& added = world.bodies.emplace_back(std::move(body));
  added.contact.points = embed(added.grid, added.grid.rest_positions());
  world.obstacles = {level_ground(0)};
  return world;
}

Film scene_by(Solver scheme) {
  Film scene;
  scene.solver.scheme = scheme;
  return scene;
}

TEST(StepPlanning, AutoTakesWhatIsForecastToBeQuicker) {
  const Film scene = scene_by(Solver::kAuto);
  const StepPlan soft = plan_steps(block(2e4), scene);
  EXPECT_EQ(soft.scheme, Solver::kEuler);
  EXPECT_LE(soft.steps.dt, stable_step(block(2e4)));
  const StepPlan stiff = plan_steps(block(1e11), scene);
  EXPECT_EQ(stiff.scheme, Solver::kBdf2);
  EXPECT_TRUE(stiff.is_implicit());
  EXPECT_LE(stiff.steps.count, 16);
  EXPECT_NE(stiff.reason.find("explicit steps a frame"), std::string::npos);
}

/// A second block that may touch the first one makes implicit steps more expensive, but does not rule them out.
TEST(StepPlanning, BodiesThatTouchAreForecastDearer) {
  const Film scene = scene_by(Solver::kAuto);
  const auto two_blocks = [](double young) {
    World world = block(young);
    world.bodies.push_back(world.bodies[0]);
    place(world.bodies[1], Mat3::Identity(), {0, 0.1, 0});
    return world;
  };
  EXPECT_EQ(plan_steps(two_blocks(2e11), scene).scheme, Solver::kBdf2);
  double young = 2e4;  // the lowest at which a single block is moved by implicit steps
  while (plan_steps(block(young), scene).scheme == Solver::kEuler) young *= 1.2;
  EXPECT_EQ(plan_steps(two_blocks(young), scene).scheme, Solver::kEuler);
}

TEST(StepPlanning, ThinBodiesAreForecastDearer) {
  const auto limit = [](const World& world) {
    const std::string reason = plan_steps(world, scene_by(Solver::kAuto)).reason;
    return std::stod(reason.substr(reason.find("as about ") + 9));
  };
  World rod = block(2e4);
  rod.bodies[0] =
      SoftBody(make_body(make_box_grid({8, 1, 1}, 0.01), Model::kCalibrated, test::test_material(0.3, 2e4)));
  EXPECT_GT(limit(rod), 5 * limit(block(2e4)));
}

/// Contact makes implicit steps more expensive.
TEST(StepPlanning, BodiesThatMeetNothingOrHangAreForecastCheaper) {
  const Film scene = scene_by(Solver::kAuto);
  const auto alone = [](World world) {
    world.obstacles.clear();
    return world;
  };
  const auto hung = [](World world) {
    world.bodies[0].pinned.push_back({.node = 0});
    return world;
  };
  double young = 2e4;
  while (plan_steps(alone(block(young)), scene).scheme == Solver::kEuler) young *= 1.2;
  EXPECT_EQ(plan_steps(hung(block(young)), scene).scheme, Solver::kBdf2);
  EXPECT_EQ(plan_steps(block(young), scene).scheme, Solver::kEuler);
}

TEST(StepPlanning, RestitutionNeedsExplicitSteps) {
  World world = block(2e9);
  world.obstacles[0].restitution = 0.5;
  const StepPlan plan = plan_steps(world, scene_by(Solver::kAuto));
  EXPECT_EQ(plan.scheme, Solver::kEuler);
  EXPECT_NE(plan.reason.find("restitution"), std::string::npos);
}

TEST(StepPlanning, WhatIsNamedIsTakenAndFillsTheFrame) {
  for (const Solver scheme : {Solver::kEuler, Solver::kVerlet, Solver::kImplicitEuler, Solver::kBdf2}) {
    const Film scene = scene_by(scheme);
    const StepPlan plan = plan_steps(block(1e5), scene);
    EXPECT_EQ(plan.scheme, scheme);
    EXPECT_TRUE(plan.reason.empty());
    EXPECT_NEAR(plan.steps.dt * double(plan.steps.count), 1 / scene.fps, 1e-12);
  }
}

}  // namespace
}  // namespace sprung
