#include "app/film/film_cameras.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace sprung {
namespace {

/// A cube of 20 cm that moves 1 m to the right over five frames of a second.
Reach moving_cube(double offset = 0) {
  Reach reach;
  reach.ground = 0;
  for (int frame = 0; frame < 5; ++frame) {
    const Vec3 middle(0.25 * frame + offset, 0.1, 0);
    Points corners(8, 3);
    for (int c = 0; c < 8; ++c) {
      for (int k = 0; k < 3; ++k) corners(c, k) = middle[k] + (((c >> k) & 1) != 0 ? 0.1 : -0.1);
    }
    reach.bodies.push_back(corners);
    reach.middles.push_back(middle);
    reach.bounds.extend(bounding_box(corners));
  }
  return reach;
}

Film scene_with(const SceneCamera& camera) {
  Film scene;
  scene.fps = 4;
  scene.duration = 1;
  scene.camera = camera;
  return scene;
}

double azimuth_of(const Camera& camera) {
  const Vec3 back = camera.eye - camera.target;
  return std::atan2(back.x(), back.z()) * 180 / std::numbers::pi;
}

double distance_of(const Camera& camera) { return (camera.eye - camera.target).norm(); }

TEST(FilmCameras, GoThroughTheirKeyframesSlowlyAtBothEnds) {
  const Reach reach = moving_cube();
  const std::vector<Camera> cameras =
      cameras_of(scene_with({.keyframes = {{.time = 0, .azimuth = 0, .elevation = 10, .zoom = 1},
                                           {.time = 1, .azimuth = 80, .elevation = 10, .zoom = 2}}}),
                 reach, 0);
  ASSERT_EQ(cameras.size(), 5U);
  EXPECT_NEAR(azimuth_of(cameras[0]), 0, 1e-9);
  EXPECT_NEAR(azimuth_of(cameras[2]), 40, 1e-9);
  EXPECT_NEAR(azimuth_of(cameras[4]), 80, 1e-9);
  EXPECT_NEAR(azimuth_of(cameras[1]), 80 * (3 * 0.0625 - 2 * 0.015625), 1e-9);  // 3 t^2 - 2 t^3 at a quarter
  const std::vector<Camera> without =
      cameras_of(scene_with({.keyframes = {{.time = 1, .azimuth = 80, .elevation = 10, .zoom = 1}}}), reach, 0);
  EXPECT_NEAR(distance_of(cameras[4]), 0.5 * distance_of(without[4]), 1e-9);
}

TEST(FilmCameras, FollowTheBodies) {
  const Reach reach = moving_cube();
  const std::vector<Camera> still = cameras_of(scene_with({}), reach, 0);
  const std::vector<Camera> following = cameras_of(scene_with({.follow = true, .keyframes = {}}), reach, 0);
  for (std::size_t frame = 1; frame < 5; ++frame) {
    EXPECT_TRUE(still[frame].eye.isApprox(still[0].eye));
    EXPECT_TRUE((following[frame].eye - following[0].eye).isApprox(reach.middles[frame] - reach.middles[0], 1e-9));
  }
  EXPECT_LT(distance_of(following[0]), 0.5 * distance_of(still[0]));  // a following camera may be nearer
}

TEST(FilmCameras, ParallelLinesSeeEverything) {
  const Reach reach = moving_cube();
  const std::vector<Camera> cameras =
      cameras_of(scene_with({.azimuth = 0, .elevation = 0, .orthographic = true, .keyframes = {}}), reach, 0);
  ASSERT_TRUE(cameras[0].orthographic);
  const double half = std::tan(cameras[0].vertical_field_of_view * std::numbers::pi / 360) * distance_of(cameras[0]);
  EXPECT_GT(half * 16 / 9, 0.5 * 1.2);  // the motion is 1.2 m wide
  EXPECT_LT(half * 16 / 9, 0.5 * 1.2 * 1.3);
}

TEST(FilmCameras, StepBackUntilTheBodiesAreAsLowAsAskedFor) {
  const Reach reach = moving_cube();
  for (const double asked : {0.1, 0.25}) {
    const SceneCamera level{.azimuth = 0, .elevation = 0, .follow = true, .keyframes = {}, .body_height = asked};
    const Camera camera = cameras_of(scene_with(level), reach, 0).back();
    // The front face, 10 cm nearer than the middle, is 20 cm high.
    const double depth = camera.eye.z() - 0.1;
    const double half = std::tan(camera.vertical_field_of_view * std::numbers::pi / 360) * depth;
    EXPECT_NEAR(0.2 / (2 * half), asked, 1e-6);
  }
  const SceneCamera wide{.keyframes = {}, .body_height = 1.0};
  EXPECT_TRUE(cameras_of(scene_with(wide), reach, 0)[0].eye.isApprox(cameras_of(scene_with({}), reach, 0)[0].eye));
}

TEST(FilmCameras, SeveralRunsAreSeenAtOnce) {
  Reach shorter = moving_cube(-2);
  shorter.bodies.resize(3);
  shorter.middles.resize(3);
  const Reach both = joined({shorter, moving_cube()});
  ASSERT_EQ(both.bodies.size(), 5U);
  EXPECT_EQ(both.bodies[4].rows(), 16);
  EXPECT_TRUE(both.bodies[4].topRows(8).isApprox(shorter.bodies[2]));  // stays where it ends
  EXPECT_NEAR(both.bounds.min().x(), -2.1, 1e-12);
  EXPECT_NEAR(both.bounds.max().x(), 1.1, 1e-12);
  EXPECT_NEAR(both.middles[4].x(), 0.5 * (-1.5 + 1), 1e-12);
}

/// A cube of 20 cm whose bottom is 5 cm above the ground, with the keys that bare meshes get.
struct FallingCube {
  Film film = scene_with({});
  Simulation simulation;
  Recording recording;

  FallingCube() {
    SceneBody& body = film.bodies.emplace_back();
    body.box = Vec3::Constant(0.2);
    body.bricks = 2;
    body.position.y() = 0.05;
    film.camera.body_height = 0.44;
    film.obstacles.emplace_back().plane.emplace();
    simulation = prepare_simulation(film, Observer());
    recording.frames.push_back({simulation.world.bodies.front().positions.cast<float>()});
    recording.progress = {0, 0.25, 0.5, 0.75, 1};
  }
  [[nodiscard]] std::optional<Reach> reach() const { return foreseen_reach(film, simulation, recording); }
};

TEST(ForeseenReach, IsFromTheStartToTheGround) {
  const FallingCube cube;
  const Reach reach = cube.reach().value();
  EXPECT_EQ(reach.bodies.size(), 5U);
  EXPECT_NEAR(reach.bodies.back().col(1).minCoeff(), 0, 1e-6);
  EXPECT_NEAR(reach.bodies.back().col(1).maxCoeff(), 0.2, 1e-6);
  AlignedBox bounds = reach.bounds;
  EXPECT_TRUE(is_foreseen(reach, bounds));
  EXPECT_TRUE(is_foreseen(reach, bounds.extend(Vec3(0, -0.1, 0)))) << "below the ground nothing is seen";
  EXPECT_FALSE(is_foreseen(reach, bounds.extend(Vec3(0, 0.3, 0))));
  EXPECT_FALSE(is_foreseen(reach, AlignedBox(reach.bounds).extend(Vec3(-0.2, 0.1, 0))));
}

TEST(ForeseenReach, IsNotKnownOfOtherMotions) {
  FallingCube thrown;
  thrown.film.bodies.front().velocity = Vec3(1, 0, 0);
  EXPECT_FALSE(thrown.reach());
  FallingCube pinned;
  pinned.film.bodies.front().pins.emplace_back();
  EXPECT_FALSE(pinned.reach());
  FallingCube between_planes;
  between_planes.film.obstacles.emplace_back().plane.emplace();
  EXPECT_FALSE(between_planes.reach());
  FallingCube seen_from_around;
  seen_from_around.film.camera.orbit = 90;
  EXPECT_FALSE(seen_from_around.reach());
  FallingCube of_a_scene;
  of_a_scene.film.camera.body_height.reset();
  EXPECT_FALSE(of_a_scene.reach());
}

}  // namespace
}  // namespace sprung
