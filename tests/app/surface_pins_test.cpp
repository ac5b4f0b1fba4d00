#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "app/scene/scene_file.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"

/// Pins that hold the skin of a face, wherever the bricks lie.
namespace sprung {
namespace {

constexpr double kBarYoung = 1e6;   // Pa
constexpr double kBarLength = 0.2;  // m, of the beam
constexpr double kBarSide = 0.05;   // m

/// `damping`: of critical.
std::string beam(const std::string& grid, const std::string& scheme = "linear", double poisson = 0.3,
                 double damping = 0.02) {
  return "duration = 1\nfps = 2\ngravity = [0, 0, 0]\n[solver]\nscheme = \"" + scheme + "\"\n" +
         (scheme == "modes"                          ? "modes = 2\n"
          : scheme == "linear" || scheme == "static" ? "load_steps = 1\n"
                                                     : "") +
         "[[probe]]\nname = \"foot\"\npin = \"foot\"\n"
         "[[probe]]\nname = \"tip\"\npoint = [-0.0999, 0, 0]\n"
         "[[body]]\nmesh = \"" SPRUNG_SOURCE_DIR "/assets/models/beam.ply\"\nsize = 0.2\n" +
         grid +
         fmt::format("\nmaterial = {{ young = 1e6, poisson = {}, density = 1000, damping = {} }}\n", poisson, damping);
}

constexpr const char* kFoot =
    "[[body.pin]]\nname = \"foot\"\non_surface = true\nbox = { min = [1, 0, 0], max = [1, 1, 1] }\n";
constexpr const char* kPull = "[[body.force]]\nbox = { min = [0, 0, 0], max = [0, 1, 1] }\ntotal = [-1, 0, 0]\n";

std::vector<ProbeSample> last_samples(const std::string& text) {
  const Film scene = parse_scene(text, "/scene.toml");
  const Observer silent;
  Simulation simulation = prepare_simulation(scene, silent);
  const Recording recording = simulate(simulation, scene, silent);
  std::vector<ProbeSample> last;
  for (const ProbeTrack& track : recording.probes) last.push_back(track.samples.back());
  return last;
}

/// Pinned at the end where the last bricks are cut, more or less.
TEST(SurfacePins, DoNotMoveWithTheGrid) {
  const double stretch = kBarLength / (kBarYoung * kBarSide * kBarSide);
  for (const double brick : {0.0112, 0.0123, 0.0145, 0.0171, 0.0198}) {
    for (const char* scheme : {"linear", "static"}) {
      const auto probes = last_samples(beam(fmt::format("brick_size = {}", brick), scheme, 0) + kFoot + kPull);
      // With 2.5 bricks across, the cut ones bend by themselves.
      EXPECT_NEAR(probes[1].displacement.x(), -stretch, (brick < 0.018 ? 0.005 : 0.025) * stretch)
          << brick << " " << scheme;
      EXPECT_NEAR(probes[0].force.x(), 1, 1e-5) << brick << " " << scheme;
      EXPECT_NEAR(probes[0].position.x(), 0.1, 1e-4) << brick;
    }
  }
}

/// A pulled bar between planes that are not those of its bricks keeps its uniform strain.
TEST(SurfacePins, SlideAlongPlanesOfAnyDirection) {
  const Mat3 turned = Eigen::AngleAxisd(std::numbers::pi / 6, Vec3::UnitZ()).toRotationMatrix();
  const auto normal = [&](int axis) {
    const Vec3 n = turned.col(axis);
    return fmt::format("on_surface = true\nnormal = [{}, {}, {}]\n", n.x(), n.y(), n.z());
  };
  const Vec3 pull = -turned.col(0);
  const std::string text =
      beam("brick_size = 0.0083\nrotation = [0, 0, 30]\nbrick_rotation = [10, 20, 30]") +
      "[[body.pin]]\nname = \"foot\"\n" + normal(0) + "box = { min = [1, 0, 0], max = [1, 1, 1] }\n[[body.pin]]\n" +
      normal(1) + "box = { min = [0, 0, 0], max = [1, 0, 1] }\n[[body.pin]]\n" + normal(2) +
      "box = { min = [0, 0, 0], max = [1, 1, 0] }\n[[body.force]]\nbox = { min = [0, 0, 0], max = [0, 1, 1] }\n" +
      fmt::format("total = [{}, {}, {}]\n", pull.x(), pull.y(), pull.z()) +
      "[[probe]]\nname = \"middle\"\npoint = [0, 0, 0]\n";
  const auto probes = last_samples(text);
  const double strain = 1 / (kBarYoung * kBarSide * kBarSide);
  const Vec3 tip = turned.transpose() * probes[1].displacement;
  const Vec3 middle = turned.transpose() * probes[2].displacement;
  EXPECT_NEAR(tip.x(), -strain * kBarLength, 0.02 * strain * kBarLength);
  EXPECT_NEAR(middle.y(), -0.3 * strain * kBarSide / 2, 0.03 * 0.3 * strain * kBarSide / 2);
  EXPECT_NEAR(middle.z(), -0.3 * strain * kBarSide / 2, 0.03 * 0.3 * strain * kBarSide / 2);
  EXPECT_NEAR((turned.transpose() * probes[0].force).x(), 1, 1e-5);
  EXPECT_NEAR((turned.transpose() * probes[0].force).y(), 0, 1e-9);
}

/// P = E A u / L and, where the end turns, M = E I theta / L.
TEST(SurfacePins, MovementsHaveTheirReactions) {
  const std::string held = "[[body.pin]]\non_surface = true\nbox = { min = [0, 0, 0], max = [0, 1, 1] }\n";
  const auto pulled =
      last_samples(beam("brick_size = 0.0123", "static", 0) + kFoot + "translate = [0.001, 0, 0]\n" + held);
  EXPECT_NEAR(pulled[0].force.x(), kBarYoung * kBarSide * kBarSide * 0.001 / kBarLength, 0.01 * 12.5);
  const auto turned =
      last_samples(beam("brick_size = 0.005", "linear", 0) + kFoot + "axes = \"x\"\nrotate = [0, 0, 1]\n" + held);
  const double inertia = std::pow(kBarSide, 4) / 12;
  const double moment = kBarYoung * inertia * std::numbers::pi / 180 / kBarLength;
  EXPECT_NEAR(turned[0].torque.z(), moment, 0.01 * moment);
  EXPECT_NEAR(turned[0].force.x(), 0, 1e-4);
}

/// A damped beam comes to rest in its equilibrium, with every scheme, moved by its pin or not.
TEST(SurfacePins, AMotionEndsInTheEquilibriumOfStatics) {
  for (const char* movement : {"", "keyframes = [{ t = 0.1, translate = [0.05, 0, 0] }]\n"}) {
    const auto text = [&](const std::string& scheme) {
      return beam("brick_size = 0.0123", scheme, 0, 0.5) + kFoot + movement + kPull;
    };
    const auto at_rest = last_samples(beam("brick_size = 0.0123", "static", 0) + kFoot + kPull);
    const Vec3 moved = *movement == 0 ? Vec3::Zero() : Vec3(0.05, 0, 0);
    for (const char* scheme : {"euler", "verlet", "bdf2"}) {
      const auto probes = last_samples(text(scheme));
      EXPECT_LT((probes[0].displacement - moved - at_rest[0].displacement).norm(), 1e-7) << scheme;
      EXPECT_NEAR(probes[1].displacement.x() - moved.x(), at_rest[1].displacement.x(), 8e-8) << scheme;
      EXPECT_NEAR(probes[0].force.x(), 1, 2e-3) << scheme;
    }
  }
}

/// A part is held from a time, where it is then, until another.
TEST(SurfacePins, CatchAndReleaseInAMotion) {
  const std::string falls = "[[body.force]]\nper_volume = [0, -1000, 0]\n";  // 1 m/s^2
  const auto probes = [&](const std::string& times) {
    return last_samples(beam("brick_size = 0.0123", "euler", 0, 0.5) + kFoot + times + falls);
  };
  const auto caught = probes("from = 0.4\n");
  EXPECT_NEAR(caught[0].displacement.y(), -0.08, 2e-3);
  const auto released = probes("until = 0.1\n");
  EXPECT_NEAR(released[0].displacement.y(), -0.08, 0.01);
  EXPECT_EQ(released[0].force.norm(), 0);
}

/// f = 1.8751^2 / (2 pi L^2) sqrt(E I / (rho A)), reduced by shear: as with whole bricks and pinned nodes.
TEST(SurfacePins, HoldVibrations) {
  const auto first = [](const std::string& text) {
    const Film scene = parse_scene(text, "/scene.toml");
    Simulation simulation = prepare_simulation(scene, Observer{});
    return simulate(simulation, scene, Observer{}).frequencies[0];
  };
  const std::string nodes = "[[body.pin]]\nname = \"foot\"\nhalf_space = { point = [1, 0, 0], normal = [1, 0, 0] }\n";
  const double whole = first(beam("brick_size = 0.005", "modes") + nodes);
  EXPECT_NEAR(first(beam("brick_size = 0.005", "modes") + kFoot), whole, 0.005 * whole);
}

TEST(SurfacePins, AreRefusedByName) {
  const auto message = [](const std::string& text) { return error_message([&] { last_samples(text); }); };
  EXPECT_NE(
      message(beam("bricks = 10") + "[[body.pin]]\nnormal = [1, 0, 0]\nbox = { min = [1, 0, 0] }\n").find("normal"),
      std::string::npos);
  EXPECT_NE(message(beam("bricks = 10") + kFoot + "[[body.pin]]\nbox = { max = [0, 1, 1] }\n").find("all pins"),
            std::string::npos);
}

}  // namespace
}  // namespace sprung
