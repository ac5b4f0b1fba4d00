#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "app/scene/scene_file.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/penetration.h"
#include "tests/support/sanitized.h"

/// What happens in every scene of assets/scenes, as its first line says. With bricks so coarse that it takes seconds;
/// SPRUNG_FULL_SCENES=1 uses the scenes unchanged, which takes a quarter of an hour.
namespace sprung {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// A scene and its result.
class FilmFacts {
 public:
  explicit FilmFacts(const std::string& name, const Settings& coarser, const std::function<void(Film&)>& change = {})
      : scene_(read_scene(SPRUNG_SOURCE_DIR "/assets/scenes/" + name + ".toml")) {
    if (std::getenv("SPRUNG_FULL_SCENES") == nullptr) {
      for (const auto& [key, value] : coarser) set_scene_key(scene_, key, value);
    }
    if (change) change(scene_);
    simulation_.emplace(prepare_simulation(scene_, observer_));
    recording_ = simulate(*simulation_, scene_, observer_);
  }

  [[nodiscard]] int last() const { return isize(recording_.frames) - 1; }
  [[nodiscard]] int frame_at(double time) const { return int(std::lround(time * scene_.fps)); }
  [[nodiscard]] std::size_t bodies() const { return simulation_->world.bodies.size(); }
  [[nodiscard]] const Body& body(std::size_t row) const { return simulation_->world.bodies[row]; }
  [[nodiscard]] const Recording& recording() const { return recording_; }

  [[nodiscard]] Points nodes(int frame, std::size_t row = 0) const {
    return recording_.frames.at(frame).at(row).cast<double>();
  }
  [[nodiscard]] Points skin(int frame, std::size_t row = 0) const {
    return simulation_->world.bodies[row].skin_positions(nodes(frame, row));
  }
  /// Centre of mass.
  [[nodiscard]] Vec3 middle(int frame, std::size_t row = 0) const {
    const auto& masses = body(row).masses;
    return (masses.transpose() * nodes(frame, row)).transpose() / masses.sum();
  }
  /// Speed of the body that moves fastest as a whole, m/s.
  [[nodiscard]] double travel_speed(int frame) const {
    double most = 0;
    for (std::size_t row = 0; row < bodies(); ++row) {
      most = std::max(most, (middle(frame, row) - middle(frame - 1, row)).norm() * scene_.fps);
    }
    return most;
  }
  /// Speed of the fastest node of all bodies between the previous frame and this one, m/s.
  [[nodiscard]] double speed(int frame) const {
    double most = 0;
    for (std::size_t row = 0; row < bodies(); ++row) {
      most = std::max(most, (nodes(frame, row) - nodes(frame - 1, row)).rowwise().norm().maxCoeff() * scene_.fps);
    }
    return most;
  }
  /// Of all nodes at the end, m/s.
  [[nodiscard]] double last_speed() const {
    double most = 0;
    for (const SoftBody& body : simulation_->world.bodies) {
      most = std::max(most, body.velocities.rowwise().norm().maxCoeff());
    }
    return most;
  }
  /// Mean position of the nodes in a part of the body at rest (fractions of its bounding box).
  [[nodiscard]] Vec3 part(int frame, std::size_t row, const Vec3& low, const Vec3& high) const {
    const Points first = nodes(0, row);
    const Vec3 origin = first.colwise().minCoeff();
    const Vec3 extent = first.colwise().maxCoeff() - first.colwise().minCoeff();
    const Points now = nodes(frame, row);
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (int node = 0; node < first.rows(); ++node) {
      const Vec3 place = (Vec3(first.row(node)) - origin).cwiseQuotient(extent);
      if ((place.array() < low.array() - 1e-6).any() || (place.array() > high.array() + 1e-6).any()) continue;
      sum += now.row(node);
      ++count;
    }
    return sum / count;
  }

  /// What holds for every scene: no brick is inverted, no contact point penetrates by more than 1 % of the largest
  /// body, and skins cross by less than 5 % (edges of obstacles enter between the points of coarse skins).
  void expect_sound() const {
    int inverted = 0;
    for (const SoftBody& body : simulation_->world.bodies) inverted += inverted_bricks(body);
    EXPECT_EQ(inverted, 0);
    EXPECT_LT(observer_.deepest(), 0.01 * simulation_->size);
    for (const Crossings& frame : recording_.crossings) EXPECT_LT(frame.depth, 0.05 * simulation_->size);
  }
  /// The same, and that no skin crosses one by more than 0.1 %.
  void expect_apart() const {
    expect_sound();
    for (const Crossings& frame : recording_.crossings) EXPECT_LT(frame.share, 1e-3) << frame.time << " s";
  }

 private:
  Film scene_;
  test::PenetrationObserver observer_;
  std::optional<Simulation> simulation_;
  Recording recording_;
};

struct SceneFacts : testing::Test {
  void SetUp() override {
    if (test::kSanitized) GTEST_SKIP() << "minutes each; every_scene_test.cpp runs the same code";
  }
};

TEST_F(SceneFacts, DemoComesToRest) {
  const FilmFacts film("demo", {{"body.bricks", "8"}});
  film.expect_sound();
  EXPECT_GT(film.speed(film.frame_at(0.2)), 0.5);
  EXPECT_LT(film.travel_speed(film.last()), 0.03);
}

TEST_F(SceneFacts, OctopusLandsOnItsTentacles) {
  const FilmFacts film("octopus", {{"body.bricks", "10"}});
  film.expect_sound();
  EXPECT_LT(film.skin(film.last()).col(1).minCoeff(), 0.001);
  EXPECT_LT(film.middle(film.last()).y(), film.middle(0).y() - 0.05);
}

/// In the end the squashed body has the shape that it has without any plate; it may have rolled.
TEST_F(SceneFacts, SquashedDoughnutReturnsToItsShape) {
  const Settings coarser{{"body.bricks", "10"}};
  const FilmFacts film("squash", coarser);
  film.expect_sound();
  const auto height = [&](int frame) { return film.skin(frame).col(1).maxCoeff(); };
  EXPECT_LT(height(film.frame_at(1.1)), 0.65 * height(0));
  const FilmFacts untouched("squash", coarser, [](Film& scene) { scene.obstacles.resize(1); });
  const Points shape = film.skin(film.last());
  const Points other = untouched.skin(untouched.last());
  const Eigen::Affine3d moved(Eigen::umeyama(shape.transpose(), other.transpose(), false));
  const double size = 0.12;
  EXPECT_LT(((moved * shape.transpose()).transpose() - other).rowwise().norm().maxCoeff(), 0.01 * size);
}

TEST_F(SceneFacts, BarIsDrawnToTwiceItsLength) {
  const FilmFacts film("stretch", {{"body.bricks", "8"}});
  film.expect_sound();
  const auto length = [&](int frame) {
    const Points x = film.nodes(frame);
    return x.col(0).maxCoeff() - x.col(0).minCoeff();
  };
  EXPECT_NEAR(length(film.frame_at(1.5)) / length(0), 2, 1e-3);
  EXPECT_NEAR(length(film.last()) / length(0), 1, 1e-3);
  const double width =
      film.nodes(film.frame_at(1.5)).col(1).maxCoeff() - film.nodes(film.frame_at(1.5)).col(1).minCoeff();
  EXPECT_GT(width, 0.03);
  EXPECT_LT((film.nodes(film.last()) - film.nodes(0)).rowwise().norm().maxCoeff(), 0.01 * 0.16);
}

/// Its tip sinks, its clamped end does not.
TEST_F(SceneFacts, BarSagsUnderItsWeight) {
  const FilmFacts film("sag", {});
  film.expect_sound();
  const auto end = [&](int frame, double x) { return film.part(frame, 0, Vec3(x, 0, 0), Vec3(x, 1, 1)); };
  EXPECT_LT(end(film.last(), 1).y() - end(0, 1).y(), -0.01);
  EXPECT_EQ(end(film.last(), 0), end(0, 0));
}

/// Each cross-section has turned by its share of the full turn, and all of it is undone.
TEST_F(SceneFacts, BarIsTwistedByAFullTurnAndBack) {
  const FilmFacts film("twist", {{"body.bricks", "12"}});
  film.expect_sound();
  const int flipped = film.frame_at(1.9);
  const Vec3 low(0.5, 1, 0.5);
  const Vec3 edge = film.part(flipped, 0, low, low) - film.part(flipped, 0, Vec3(0.5, 0, 0.5), Vec3(0.5, 0, 0.5));
  EXPECT_LT(edge.normalized().y(), -0.99);
  EXPECT_LT((film.nodes(film.last()) - film.nodes(0)).rowwise().norm().maxCoeff(), 0.01 * 0.24);
}

/// The ear carries the whole weight, and the bear hangs straight below it.
TEST_F(SceneFacts, BearHangsFromOneEar) {
  const FilmFacts film("hang", {{"body.bricks", "12"}});
  film.expect_sound();
  const ProbeSample& ear = film.recording().probes.at(0).samples.back();
  const double weight = 9.81 * film.body(0).masses.sum();
  EXPECT_NEAR(ear.force.y() / weight, 1, 0.03);
  const Vec3 below = film.middle(film.last()) - ear.position;
  EXPECT_LT(below.y(), -0.05);
  EXPECT_LT(std::hypot(below.x(), below.z()), 0.1 * -below.y());
  EXPECT_LT(film.travel_speed(film.last()), 0.06);  // it still swings by its ear, to and fro by a centimetre
}

TEST_F(SceneFacts, TwentyBodiesComeToRestInTheBowl) {
  const FilmFacts film("bowl", {{"body.bricks", "5"}});
  film.expect_sound();
  EXPECT_EQ(film.bodies(), 20U);
  EXPECT_LT(film.travel_speed(film.last()), 0.02);
  for (std::size_t body = 0; body < film.bodies(); ++body) {
    const Vec3 middle = film.middle(film.last(), body);
    EXPECT_LT(std::max(std::abs(middle.x()), std::abs(middle.z())), 0.12) << body;
    EXPECT_GT(middle.y(), 0.005) << body;
  }
}

TEST_F(SceneFacts, StackOfFiveStands) {
  const FilmFacts film("stack", {{"duration", "2"}});
  film.expect_sound();
  ASSERT_EQ(film.bodies(), 5U);
  double fastest = 0;  // of the last quarter of a second: all five swing together
  for (int back = 0; back < 6; ++back) fastest = std::max(fastest, film.travel_speed(film.last() - back));
  EXPECT_LT(fastest, 0.02);
  for (std::size_t body = 0; body < 5; ++body) {
    const Vec3 shift = film.middle(film.last(), body) - film.middle(0, body);
    EXPECT_LT(std::hypot(shift.x(), shift.z()), 0.01 * 0.08) << body;
    if (body == 0) continue;
    EXPECT_GT(film.middle(film.last(), body).y(), film.middle(film.last(), body - 1).y() + 0.04);
  }
}

TEST_F(SceneFacts, BallGoesThroughTheRing) {
  const FilmFacts film("ring", {{"body.bricks", "12"}, {"duration", "2.6"}});
  film.expect_sound();
  EXPECT_GT(film.skin(0).col(1).minCoeff(), 0.15);
  EXPECT_LT(film.skin(film.last()).col(1).maxCoeff(), 0.15);
  const Points through = film.skin(film.last());
  EXPECT_GT(through.col(0).maxCoeff() - through.col(0).minCoeff(), 0.09);  // as wide again as before
}

/// The pads, half a width apart at rest, meet and do not go through each other.
TEST_F(SceneFacts, FingersCloseOnEachOther) {
  const FilmFacts film("hand", {{"body.bricks", "12"}});
  film.expect_sound();
  const Points rest = film.skin(0);
  const auto gap = [&](int frame) {
    const Points now = film.skin(frame);
    double left = -1;
    double right = 1;
    for (int row = 0; row < rest.rows(); ++row) {
      if (rest(row, 1) < 0.08) continue;
      if (rest(row, 0) < 0) left = std::max(left, now(row, 0));
      if (rest(row, 0) > 0) right = std::min(right, now(row, 0));
    }
    return right - left;
  };
  EXPECT_NEAR(gap(0), 0.06, 1e-5);
  EXPECT_LT(gap(film.frame_at(1.75)), 0.002);
  EXPECT_GT(gap(film.frame_at(1.75)), -0.01 * 0.12);
  EXPECT_GT(gap(film.last()), 0.05);
}

/// The soft one is stretched, the stiff one is not, and the glued faces stay together. Bricks of different size, which
/// the glue cannot hold together everywhere, do not shake.
TEST_F(SceneFacts, GlueHoldsASoftAndAStiffBlock) {
  const FilmFacts film("glue", {{"duration", "1.2"}});
  film.expect_sound();
  const auto height = [&](int frame, std::size_t body) {
    return film.part(frame, body, Vec3(0, 1, 0), Vec3(1, 1, 1)).y() -
           film.part(frame, body, Vec3(0, 0, 0), Vec3(1, 0, 1)).y();
  };
  const int hanging = film.frame_at(0.55);
  EXPECT_GT(height(hanging, 0), 1.02 * height(0, 0));
  EXPECT_NEAR(height(hanging, 1) / height(0, 1), 1, 0.01);
  const auto joint = [&](int frame) {
    return (film.part(frame, 0, Vec3(0.4, 0, 0.4), Vec3(0.6, 0, 0.6)) -
            film.part(frame, 1, Vec3(0.4, 1, 0.4), Vec3(0.6, 1, 0.6)))
        .norm();
  };
  for (int frame = 0; frame <= film.last(); ++frame) EXPECT_NEAR(joint(frame), joint(0), 0.002) << frame;
  EXPECT_LT(film.last_speed(), 2);
}

/// The part of the wheel on the ground does not move: it rolls.
TEST_F(SceneFacts, WheelRolls) {
  const FilmFacts film("wheel", {{"body.bricks", "12"}});
  film.expect_sound();
  EXPECT_NEAR(film.middle(film.last()).x() - film.middle(0).x(), 0.4, 0.01);
  double slipped = 0;
  for (int frame = film.frame_at(0.5) + 1; frame <= film.last(); ++frame) {
    const Points before = film.skin(frame - 1);
    const Points now = film.skin(frame);
    double most = 0;
    for (int row = 0; row < now.rows(); ++row) {
      if (before(row, 1) < 2e-4 && now(row, 1) < 2e-4) most = std::max(most, std::abs(now(row, 0) - before(row, 0)));
    }
    slipped += most;
  }
  EXPECT_LT(slipped, 0.05 * 0.4);
}

TEST_F(SceneFacts, MusclesBendATentacleToBothSides) {
  const FilmFacts film("muscle", {{"body.bricks", "16"}});
  film.expect_sound();
  const auto tip = [&](double time) { return film.part(film.frame_at(time), 0, Vec3(0, 0.95, 0), Vec3(1, 1, 1)); };
  EXPECT_LT(tip(1.25).x() - tip(0).x(), -0.05);
  EXPECT_GT(tip(2.5).x() - tip(0).x(), 0.05);
}

TEST_F(SceneFacts, WindBendsTheSheet) {
  const FilmFacts film("wind", {{"duration", "1.2"}});
  film.expect_sound();
  const auto end = [&](double time) { return film.part(film.frame_at(time), 0, Vec3(0.95, 0, 0), Vec3(1, 1, 1)); };
  EXPECT_GT(end(0.8).z() - end(0).z(), 0.03);
}

/// The wall yields, swings back and throws the ball back.
TEST_F(SceneFacts, WallThrowsABallBack) {
  const FilmFacts film("wall", {});
  film.expect_sound();
  const auto shift = [&](int frame) { return film.middle(frame, 0).x() - film.middle(0, 0).x(); };
  double most = 0;
  for (int frame = 0; frame <= film.last(); ++frame) most = std::max(most, shift(frame));
  EXPECT_GT(most, 0.01);
  EXPECT_LT(shift(film.frame_at(0.85)), -0.01);  // back, and past its initial position
  double furthest = 0;
  for (int frame = 0; frame <= film.last(); ++frame) furthest = std::min(furthest, film.middle(frame, 1).x());
  EXPECT_LT(furthest, film.middle(0, 1).x() - 0.05);  // back to where it came from, and further
}

TEST_F(SceneFacts, HouseOfCardsStands) {
  const FilmFacts film("contact/cards", {{"duration", "0.9"}});
  film.expect_apart();
  ASSERT_EQ(film.bodies(), 14U);
  for (std::size_t card = 0; card < film.bodies(); ++card) {
    EXPECT_LT((film.middle(film.last(), card) - film.middle(film.frame_at(0.5), card)).norm(), 0.01 * 0.18) << card;
    EXPECT_LT((film.middle(film.last(), card) - film.middle(0, card)).norm(), 0.04 * 0.18) << card;
  }
}

TEST_F(SceneFacts, BlockIsSqueezedOutOfABoxWhole) {
  const FilmFacts film("contact/squeeze", {});
  film.expect_apart();
  constexpr double kMouth = 0.019;  // m, its end
  EXPECT_LT(film.skin(0).col(0).maxCoeff(), kMouth);
  EXPECT_GT(film.skin(film.last()).col(0).minCoeff(), kMouth);
  const auto extent = [&](int frame) -> Vec3 {
    return film.skin(frame).colwise().maxCoeff() - film.skin(frame).colwise().minCoeff();
  };
  EXPECT_LT((extent(film.last()) - extent(0)).cwiseAbs().maxCoeff(), 0.01);
}

TEST_F(SceneFacts, OctopusDropsThroughAFunnel) {
  const FilmFacts film("contact/funnel", {{"duration", "0.6"}});
  film.expect_apart();
  EXPECT_GT(film.middle(0).y(), 0.3);
  EXPECT_LT(film.middle(film.last()).y(), 0.08);
  EXPECT_LT(film.skin(film.last()).col(1).maxCoeff(), 0.174);  // the lower end of the funnel
}

TEST_F(SceneFacts, MatLiesOnKnives) {
  const FilmFacts film("contact/knives", {{"duration", "0.5"}});
  film.expect_apart();
  constexpr double kPoints = 0.08;  // m, of the knives
  EXPECT_GT(film.skin(0).col(1).minCoeff(), kPoints + 0.09);
  const Points mat = film.skin(film.last());
  int held = 0;  // vertices between the outermost knives
  for (const auto& point : mat.rowwise()) {
    EXPECT_GT(point.y(), 0.01);
    if (std::abs(point.x()) > 0.09 || std::abs(point.z()) > 0.035) continue;
    ++held;
    EXPECT_NEAR(point.y(), kPoints + 0.004, 0.012);
  }
  EXPECT_GT(held, 50);
}

/// Whichever rings are linked at the start still are: no two neighbours are further apart than two stretched rings.
TEST_F(SceneFacts, NetCatchesABall) {
  const FilmFacts film("contact/net", {{"duration", "0.35"}});
  film.expect_apart();
  const std::size_t ball = film.bodies() - 1;
  EXPECT_EQ(film.bodies(), 97U);
  EXPECT_GT(film.middle(0, ball).y(), 0.3);
  double lowest = film.middle(0, ball).y();
  for (int frame = 1; frame <= film.last(); ++frame) lowest = std::min(lowest, film.middle(frame, ball).y());
  EXPECT_LT(lowest, 0.18);  // below the net at rest
  EXPECT_GT(film.middle(film.last(), ball).y(), lowest + 0.01);
  constexpr double kLinked = 0.03;   // m, at the start at most
  constexpr double kApart = 0.0675;  // m, of two rings of 4.8 cm, stretched by half
  for (std::size_t a = 0; a < ball; ++a) {
    EXPECT_GT(film.middle(film.last(), a).y(), 0.02) << a;
    for (std::size_t b = a + 1; b < ball; ++b) {
      if ((film.middle(0, a) - film.middle(0, b)).norm() > kLinked + 0.005) continue;
      EXPECT_LT((film.middle(film.last(), a) - film.middle(film.last(), b)).norm(), kApart) << a << " " << b;
    }
  }
}

TEST_F(SceneFacts, PouredBodiesStayInTheBowl) {
  const FilmFacts film("contact/hundred", {}, [](Film& scene) {
    if (std::getenv("SPRUNG_FULL_SCENES") != nullptr) return;
    for (SceneBody& body : scene.bodies) body.copies->count = {3, 1, 3};
  });
  film.expect_apart();
  EXPECT_LT(film.travel_speed(film.last()), 0.02);
  for (std::size_t body = 0; body < film.bodies(); ++body) {
    const Vec3 middle = film.middle(film.last(), body);
    EXPECT_LT(std::hypot(middle.x(), middle.z()), 0.165) << body;
    EXPECT_GT(middle.y(), 0.005) << body;
  }
}

}  // namespace
}  // namespace sprung
