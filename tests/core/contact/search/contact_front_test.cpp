#include "core/contact/search/contact_front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <string>

#include "core/world/world.h"
#include "tests/support/horseshoe.h"
#include "tests/support/touching.h"
#include "tests/support/waves.h"

namespace sprung {
namespace {

using test::test_material;
using test::touching_box;
using test::Waves;

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto to_segment = [&](const Vec3& s, const Vec3& e) {
    const double share = std::clamp((p - s).dot(e - s) / (e - s).squaredNorm(), 0.0, 1.0);
    return (p - s - share * (e - s)).norm();
  };
  const Vec3 normal = (b - a).cross(c - a).normalized();
  const Vec3 foot = p - normal.dot(p - a) * normal;
  const auto is_left = [&](const Vec3& s, const Vec3& e) { return (e - s).cross(foot - s).dot(normal) >= 0; };
  if (is_left(a, b) && is_left(b, c) && is_left(c, a)) return std::abs(normal.dot(p - a));
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

/// The bricks that a front lists, by number of the list.
class BrickLists : public NearLists {
 public:
  bool fill(const NearBricks& bricks) override {
    ++fills;
    lists_[bricks.list] = {bricks.a, bricks.b};
    return true;
  }
  bool clear(int list) override { return lists_.erase(list) > 0; }
  void clear() override { lists_.clear(); }

  [[nodiscard]] std::set<std::array<int, 2>> listed() const {
    std::set<std::array<int, 2>> pairs;
    for (const auto& [list, bricks] : lists_) pairs.insert(bricks);
    return pairs;
  }

  long fills = 0;

 private:
  std::map<int, std::array<int, 2>> lists_;
};

/// Two surfaces, or one, on random trajectories, a front between them, and all pairs of points and triangles.
class FrontRace {
 public:
  FrontRace(SoftBody& a, SoftBody& b, double dt)
      : a_(a),
        b_(b),
        tree_a_(contact_surface_of(a), a),
        tree_b_(contact_surface_of(b), b),
        front_(tree_a_, is_self() ? tree_a_ : tree_b_, 0.3 * a.grid.brick_size, lists_),
        dt_(dt) {}

  /// Returns how many pairs that can meet in this step are of bricks in no list; adds all that can to near.
  long step(long& near) {
    for (SurfaceTree* tree : {&tree_a_, &tree_b_}) tree->refresh();
    tree_a_.follow(dt_, 0);
    if (!is_self()) tree_b_.follow(dt_, 0);
    static_cast<void>(front_.advance());
    const std::set<std::array<int, 2>> listed = lists_.listed();
    long missed = count_missed(a_, b_, 0, listed, near);
    if (!is_self()) missed += count_missed(b_, a_, 1, listed, near);
    a_.positions += dt_ * a_.velocities;
    if (!is_self()) b_.positions += dt_ * b_.velocities;
    return missed;
  }

 private:
  [[nodiscard]] bool is_self() const { return &a_ == &b_; }

  long count_missed(SoftBody& points_of, SoftBody& triangles_of, int side, const std::set<std::array<int, 2>>& listed,
                    long& near) {
    const ContactSurface& skin = contact_surface_of(points_of);
    const ContactSurface& other = contact_surface_of(triangles_of);
    std::vector<Vec3> places;
    std::vector<Vec3> speeds;
    for (const ContactPoint& point : other.points) {
      places.push_back(carried(triangles_of, point, triangles_of.positions));
      speeds.push_back(carried(triangles_of, point, triangles_of.velocities));
    }
    long missed = 0;
    for (int row = 0; row < isize(skin.bricks); ++row) {
      for (int i = skin.first_point[row]; i < skin.first_point[row + 1]; ++i) {
        const Vec3 place = carried(points_of, skin.points[i], points_of.positions);
        const Vec3 speed = carried(points_of, skin.points[i], points_of.velocities);
        const Vec3 normal = carried_normal(points_of, skin.bricks[row], skin.normals.row(i));
        for (int other_row = 0; other_row < isize(other.bricks); ++other_row) {
          if (is_self() && std::binary_search(skin.connected[row].begin(), skin.connected[row].end(), other_row)) {
            continue;
          }
          for (int t = other.first_triangle[other_row]; t < other.first_triangle[other_row + 1]; ++t) {
            const auto& [a, b, c] = other.triangles[t];
            if ((place - places[a]).norm() > 3 * points_of.grid.brick_size) continue;
            const double way =
                dt_ * std::max({(speed - speeds[a]).norm(), (speed - speeds[b]).norm(), (speed - speeds[c]).norm()});
            if (distance_to_triangle(place, places[a], places[b], places[c]) > way) continue;
            const Vec3 across = (places[b] - places[a]).cross(places[c] - places[a]).normalized();
            if (is_self() && !(normal.dot(across) <= kFacing)) continue;
            const auto hangs = [&](int corner) {
              return share_a_node(points_of, skin.bricks[row], other.points[corner].brick);
            };
            if (is_self() && (hangs(a) || hangs(b) || hangs(c))) continue;
            ++near;
            const bool is_listed = listed.contains({row, other_row}) && (side == 0 || is_self());
            if (!is_listed && !((side == 1 || is_self()) && listed.contains({other_row, row}))) ++missed;
          }
        }
      }
    }
    return missed;
  }

  SoftBody& a_;
  SoftBody& b_;
  SurfaceTree tree_a_;
  SurfaceTree tree_b_;
  BrickLists lists_;
  ContactFront front_;
  double dt_;
};

/// SPRUNG_FRONT_STEPS=100000 for long.
long steps_of_a_race() {
  const char* steps = std::getenv("SPRUNG_FRONT_STEPS");
  return steps != nullptr ? std::stol(steps) : 2000;
}

TEST(ContactFront, NoPairOfTwoBodiesSleepsThatCanTouch) {
  std::mt19937 random(7);
  long near = 0;
  long missed = 0;
  const long steps = steps_of_a_race();
  for (long done = 0; done < steps;) {
    SoftBody a = touching_box({3, 3, 3}, 0.02, test_material(0.3), Vec3::Zero());
    SoftBody b = touching_box({3, 2, 3}, 0.02, test_material(0.3), Vec3(0.01, 0.065, -0.012));
    FrontRace race(a, b, 2e-4);
    const Waves of_a(random, 0.3);
    const Waves of_b(random, 0.3);
    for (int step = 0; step < 250; ++step, ++done) {
      of_a.set_velocities(a, step * 2e-4);
      of_b.set_velocities(b, step * 2e-4);
      missed += race.step(near);
    }
  }
  EXPECT_GT(near, steps / 10);
  RecordProperty("near", int(near));
  EXPECT_EQ(missed, 0);
}

TEST(ContactFront, NoPairOfABodyWithItselfSleepsThatCanTouch) {
  std::mt19937 random(8);
  long near = 0;
  long missed = 0;
  const long steps = steps_of_a_race();
  for (long done = 0; done < steps;) {
    SoftBody body = test::closing_horseshoe(0.01);
    const Waves waves(random, 0.2);
    const Points closing = body.velocities;
    FrontRace race(body, body, 2e-4);
    for (int step = 0; step < 500; ++step, ++done) {
      waves.set_velocities(body, step * 2e-4);
      body.velocities += closing;
      missed += race.step(near);
    }
  }
  EXPECT_GT(near, steps / 10);
  RecordProperty("near", int(near));
  EXPECT_EQ(missed, 0);
}

/// Two boxes of 3 x 3 x 3 bricks, a quarter of a brick apart.
struct BoxesAboveEachOther {
  SoftBody a = touching_box({3, 3, 3}, 0.02, test_material(0.3), Vec3::Zero());
  SoftBody b = touching_box({3, 3, 3}, 0.02, test_material(0.3), Vec3(0, 0.065, 0));
  SurfaceTree tree_a{contact_surface_of(a), a};
  SurfaceTree tree_b{contact_surface_of(b), b};
  BrickLists lists;
  ContactFront front{tree_a, tree_b, 0.006, lists};

  /// Advances the front, then the bodies. Returns whether any list has changed.
  bool step(double dt) {
    for (SurfaceTree* tree : {&tree_a, &tree_b}) tree->refresh();
    tree_a.follow(dt, 0);
    tree_b.follow(dt, 0);
    const bool has_changed = front.advance();
    for (SoftBody* body : {&a, &b}) body->positions += dt * body->velocities;
    return has_changed;
  }
};

/// Bodies that fall and rotate together are checked once.
TEST(ContactFront, BodiesThatMoveTogetherCostNothing) {
  BoxesAboveEachOther boxes;
  for (SoftBody* body : {&boxes.a, &boxes.b}) body->velocities.rowwise() = Vec3(3, -20, 1).transpose();
  for (int step = 0; step < 100; ++step) EXPECT_EQ(boxes.step(1e-3), step == 0) << step;
}

/// A light node that rattles does not keep the bricks about it busy.
TEST(ContactFront, BricksBesideAFastOneKeepTheirLists) {
  BoxesAboveEachOther boxes;
  Eigen::Index corner = 0;
  boxes.b.positions.rowwise().sum().minCoeff(&corner);
  for (int step = 0; step < 20; ++step) {
    boxes.lists.fills = 0;
    boxes.b.velocities.row(corner) = Vec3(step % 2 == 0 ? 20 : -20, 0, 0);
    static_cast<void>(boxes.step(1e-3));
    const long listed = std::ssize(boxes.lists.listed());
    EXPECT_GE(listed, 9);
    EXPECT_LE(boxes.lists.fills, step == 0 ? listed : listed / 3) << step;
  }
}

}  // namespace
}  // namespace sprung
