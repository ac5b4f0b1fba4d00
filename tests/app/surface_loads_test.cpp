#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/scene/scene_file.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"

/// Loads on faces: their resultants are exact, regardless of the grid.
namespace sprung {
namespace {

constexpr double kYoung = 1e6;  // Pa

std::string scene_with(const std::string& body, const std::string& rest, const std::string& solver = "linear") {
  return "duration = 1\nfps = 2\ngravity = [0, 0, 0]\n[solver]\nscheme = \"" + solver +
         "\"\nload_steps = 1\n"
         "[[probe]]\nname = \"foot\"\npin = \"foot\"\n[[body]]\n" +
         body +
         "material = { young = 1e6, poisson = 0.3, density = 1000 }\n[[body.pin]]\nname = \"foot\"\n"
         "half_space = { point = [0.02, 0.5, 0.5], normal = [-1, 0, 0] }\n" +
         rest;
}

/// 20 cm along x, 4 cm x 4 cm across.
const std::string kBeam = "box = [0.2, 0.04, 0.04]\nbricks = 20\n";
const std::string kAskew =
    "mesh = \"" SPRUNG_SOURCE_DIR "/assets/models/beam.ply\"\nsize = 0.2\nbricks = 20\nbrick_rotation = [10, 20, 30]\n";
const std::string kEnd = "[[body.force]]\nbox = { min = [1, 0, 0], max = [1, 1, 1] }\n";

struct Done {
  Simulation simulation;
  Recording recording;

  [[nodiscard]] const ProbeSample& probe(std::size_t row = 0) const { return recording.probes.at(row).samples.back(); }
};

Done run(const std::string& text) {
  const Film scene = parse_scene(text, "/scene.toml");
  const Observer silent;
  Done done{.simulation = prepare_simulation(scene, silent), .recording = {}};
  done.recording = simulate(done.simulation, scene, silent);
  return done;
}

AlignedBox box_of(const Done& done) {
  const SoftBody& body = done.simulation.world.bodies.at(0);
  return bounding_box(body.skin_positions(body.rest_positions));
}

/// The end of a beam that is not aligned with its bricks.
TEST(SurfaceLoads, ResultantsAreExactOnCutBricks) {
  const Done total = run(scene_with(kAskew, kEnd + "total = [1, -2, 3]\n"));
  EXPECT_LT((total.probe().force + Vec3(1, -2, 3)).norm(), 1e-6);
  const Vec3 sides = box_of(total).sizes();
  const double area = sides.y() * sides.z();
  const Done traction = run(scene_with(kAskew, kEnd + "traction = [100, -200, 300]\n"));
  EXPECT_LT((traction.probe().force + area * Vec3(100, -200, 300)).norm(), 1e-5 * area * 374);
  const Done pressure = run(scene_with(kAskew, kEnd + "pressure = 500\n"));
  EXPECT_LT((pressure.probe().force - Vec3(500 * area, 0, 0)).norm(), 1e-5 * area * 500);
  const Done moment = run(scene_with(kAskew, kEnd + "moment = [0.01, 0.02, -0.03]\n"));
  EXPECT_LT(moment.probe().force.norm(), 1e-7);
  EXPECT_LT((moment.probe().torque + Vec3(0.01, 0.02, -0.03)).norm(), 1e-6);
}

/// By less than a triangle: a disc on the beam's upper side, and a share of it that ends between nodes.
TEST(SurfaceLoads, PartsOfAFaceEndWhereTheyAreTold) {
  const Done disc =
      run(scene_with(kBeam, "[[body.force]]\nsphere = { center = [0.7, 1, 0.5], radius = 0.07 }\npressure = 500\n"));
  const double area = std::numbers::pi * std::pow(0.07 * 0.2, 2);
  EXPECT_NEAR(disc.probe().force.y(), 500 * area, 0.002 * 500 * area);
  const Done band =
      run(scene_with(kBeam, "[[body.force]]\nbox = { min = [0.333, 1, 0], max = [0.777, 1, 1] }\npressure = 500\n"));
  const double strip = 0.444 * 0.2 * 0.04;
  EXPECT_NEAR(band.probe().force.y(), 500 * strip, 0.002 * 500 * strip);
}

/// theta = M L / (E I), and the deflection half of that times the length.
TEST(SurfaceLoads, EndMomentBendsABeamByTheory) {
  const std::string probe = "[[probe]]\nname = \"tip\"\npoint = [0.1, 0, 0]\n";
  const Done done = run(scene_with(kBeam, kEnd + "moment = [0, 0, 0.005]\n" + probe));
  const double inertia = std::pow(0.04, 4) / 12;
  const double tip = 0.005 * 0.2 * 0.2 / (2 * kYoung * inertia);
  EXPECT_NEAR(done.probe(1).displacement.y(), tip, 0.02 * tip);
}

TEST(SurfaceLoads, MeanTheSameInMotion) {
  const std::string loads = kEnd + "traction = [0, 40, 0]\n" + kEnd + "moment = [0.002, 0, 0]\n";
  const Done rest = run(scene_with(kBeam, loads, "static"));
  const std::string moving =
      "duration = 3\nfps = 4\ngravity = [0, 0, 0]\n[solver]\nscheme = \"bdf2\"\n[[probe]]\nname = \"foot\"\npin = "
      "\"foot\"\n[[body]]\n" +
      kBeam +
      "material = { young = 1e6, poisson = 0.3, density = 1000, damping = 0.5 }\n[[body.pin]]\nname = \"foot\"\n"
      "half_space = { point = [0.02, 0.5, 0.5], normal = [-1, 0, 0] }\n" +
      loads;
  const Done motion = run(moving);
  EXPECT_LT((motion.probe().force - rest.probe().force).norm(), 0.01 * rest.probe().force.norm());
  EXPECT_LT((motion.probe().torque - rest.probe().torque).norm(), 0.01 * rest.probe().torque.norm());
}

/// The reaction is the pressure times the area of the skin in its stretched state.
TEST(SurfaceLoads, PressureFollowsTheSkinInStatics) {
  const Done done =
      run(scene_with(kBeam, "[[body.force]]\nbox = { min = [0, 1, 0], max = [1, 1, 1] }\npressure = 1500\n", "static"));
  const SoftBody& body = done.simulation.world.bodies.at(0);
  const Points rest = body.drawn.skin.positions;
  const Points moved = body.skin_positions(body.positions);
  const double top = rest.col(1).maxCoeff();
  Vec3 area = Vec3::Zero();
  for (const auto& corners : body.drawn.skin.triangles.rowwise()) {
    if (rest(corners[0], 1) < top - 1e-9 || rest(corners[1], 1) < top - 1e-9 || rest(corners[2], 1) < top - 1e-9) {
      continue;
    }
    const Vec3 a = moved.row(corners[0]);
    const Vec3 b = moved.row(corners[1]);
    const Vec3 c = moved.row(corners[2]);
    area += (b - a).cross(c - a) / 2;
  }
  EXPECT_LT((done.probe().force - 1500 * area).norm(), 1e-5 * 1500 * area.norm());
  EXPECT_GT(std::abs(area.x()), 0.05 * area.norm());  // it has turned
}

TEST(SurfaceLoads, WhatMissesTheSkinIsRefused) {
  const std::string inside = "[[body.force]]\nbox = { min = [0.5, 0, 0], max = [0.5, 1, 1] }\ntotal = [0, 1, 0]\n";
  EXPECT_NE(error_message([&] { static_cast<void>(run(scene_with(kBeam, inside))); }).find("flat box"),
            std::string::npos);
  const std::string both = kEnd + "per_volume = [0, 1, 0]\non_surface = true\n";
  EXPECT_NE(error_message([&] { static_cast<void>(run(scene_with(kBeam, both))); }).find("on_surface"),
            std::string::npos);
}

}  // namespace
}  // namespace sprung
