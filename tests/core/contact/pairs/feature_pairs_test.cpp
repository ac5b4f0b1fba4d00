#include "core/contact/pairs/feature_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <set>

#include "core/contact/pairs/closest_features.h"
#include "tests/support/horseshoe.h"
#include "tests/support/passes_through.h"
#include "tests/support/touching.h"
#include "tests/support/waves.h"

namespace sprung {
namespace {

using test::test_material;
using test::touching_box;
using test::Waves;

constexpr double kPi = std::numbers::pi;
using Key = std::array<int, 6>;  // count, side of the first feature, corners

/// Two surfaces, or one, on random trajectories, and all pairs of their features.
class FeatureRace {
 public:
  FeatureRace(SoftBody& a, SoftBody& b, double dt)
      : bodies_{&a, &b},
        trees_{SurfaceTree(contact_surface_of(a), a), SurfaceTree(contact_surface_of(b), b)},
        pairs_(trees_[0], trees_[is_self() ? 0 : 1], {0, 1}, 0.5),
        dt_(dt) {}

  /// Looks ahead for some steps of constant velocities. Returns how many pairs might cross in one of them and sleep;
  /// adds those that might to `near`.
  long look(int steps, long& near) {
    for (int i = 0; i < (is_self() ? 1 : 2); ++i) {
      trees_[i].refresh();
      trees_[i].follow(steps * dt_, 0);
    }
    pairs_.wake();
    find_crossed();
    long missed = 0;
    for (int step = 0; step < steps; ++step) {
      for (SurfaceTree& tree : trees_) tree.refresh();
      std::vector<AwakePair> awake;
      pairs_.measure(awake);
      awake_.clear();
      for (const AwakePair& pair : awake) awake_.insert(key_of(pair.pair));
      each_pair([&](const FeaturePair& pair) {
        if (crossed_.contains(key_of(pair)) || !may_cross(pair)) return;
        ++near;
        if (!awake_.contains(key_of(pair))) ++missed;
      });
      for (int i = 0; i < (is_self() ? 1 : 2); ++i) bodies_[i]->positions += dt_ * bodies_[i]->velocities;
    }
    return missed;
  }

 private:
  [[nodiscard]] bool is_self() const { return bodies_[0] == bodies_[1]; }
  /// Two edges of one surface may be listed in either order.
  [[nodiscard]] Key key_of(const FeaturePair& pair) const {
    const auto& [a, b, c, d] = pair.corners;
    if (is_self() && pair.count == 2 && std::pair(c, d) < std::pair(a, b)) return {2, 0, c, d, a, b};
    return {pair.count, int(pair.first), a, b, c, d};
  }
  [[nodiscard]] Vec3 at(const FeaturePair& pair, int corner, bool is_velocity) const {
    const SoftBody& body = *bodies_[pair.side(corner)];
    return carried(body, trees_[pair.side(corner)].skin().points[pair.corners[corner]],
                   is_velocity ? body.velocities : body.positions);
  }
  [[nodiscard]] FeatureDistance distance(const FeaturePair& pair) const {
    const auto x = [&](int corner) { return at(pair, corner, false); };
    return pair.count == 1 ? point_to_triangle(x(0), x(1), x(2), x(3)) : edge_to_edge(x(0), x(1), x(2), x(3));
  }
  [[nodiscard]] bool may_cross(const FeaturePair& pair) const {
    const Vec3 apart = distance(pair).apart;
    const double gap = apart.norm();
    if (gap > 0.5 * bodies_[0]->grid.brick_size) return false;
    double least = 1e300;
    double most = -1e300;
    for (int corner = 0; corner < 4; ++corner) {
      const double speed = apart.dot(at(pair, corner, true)) / gap;
      if (corner < pair.count) least = std::min(least, speed);
      if (corner >= pair.count) most = std::max(most, speed);
    }
    return (most - least) * dt_ > kFreeShare * (gap - kMinGap * bodies_[0]->grid.brick_size);
  }
  /// Pairs that have already crossed when they are checked are ignored: an edge that passes through a triangle at the
  /// other, and a point behind the triangle and inside its surface.
  void find_crossed() {
    crossed_.clear();
    each_pair([&](const FeaturePair& pair) {
      const FeatureDistance found = distance(pair);
      if (found.apart.norm() > bodies_[0]->grid.brick_size) return;
      const bool has_crossed = pair.count == 1 ? is_inside(pair, found) : pierces(pair, 0) || pierces(pair, 2);
      if (has_crossed) crossed_.insert(key_of(pair));
    });
  }
  [[nodiscard]] bool is_inside(const FeaturePair& pair, const FeatureDistance& found) const {
    const auto x = [&](int corner) { return at(pair, corner, false); };
    if ((x(2) - x(1)).cross(x(3) - x(1)).dot(found.apart) >= 0) return false;
    return is_self() || (found.weights.tail<3>().maxCoeff() < -1e-6 && solid_angle(x(0), pair.side(1)) > 2 * kPi);
  }
  /// Of a surface about a point, after van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983): 4 pi inside.
  [[nodiscard]] double solid_angle(const Vec3& point, std::size_t side) const {
    double sum = 0;
    const ContactSurface& skin = trees_[side].skin();
    for (const auto& corners : skin.triangles) {
      std::array<Vec3, 3> x;
      for (std::size_t i = 0; i < 3; ++i) {
        x[i] = (carried(*bodies_[side], skin.points[corners[i]], bodies_[side]->positions) - point).normalized();
      }
      sum += 2 * std::atan2(x[0].dot(x[1].cross(x[2])), 1 + x[0].dot(x[1]) + x[1].dot(x[2]) + x[2].dot(x[0]));
    }
    return sum;
  }
  /// Whether the edge that begins with corner `edge` passes through a triangle at the other one.
  [[nodiscard]] bool pierces(const FeaturePair& pair, int edge) const {
    const int other = 2 - edge;
    const std::size_t side = pair.side(other);
    const ContactSurface& skin = trees_[side].skin();
    for (const auto& corners : skin.triangles) {
      const auto has = [&](int point) { return std::find(corners.begin(), corners.end(), point) != corners.end(); };
      if (!has(pair.corners[other]) || !has(pair.corners[other + 1])) continue;
      std::array<Vec3, 3> x;
      for (std::size_t i = 0; i < 3; ++i) {
        x[i] = carried(*bodies_[side], skin.points[corners[i]], bodies_[side]->positions);
      }
      if (test::passes_through(at(pair, edge, false), at(pair, edge + 1, false), x[0], x[1], x[2])) return true;
    }
    return false;
  }
  /// Within one surface, those whose bricks share no node.
  template <class Visit>
  void each_pair(const Visit& visit) const {
    const ContactSurface& a = trees_[0].skin();
    const ContactSurface& b = trees_[1].skin();
    const auto is_left_out = [&](int row_a, int row_b) {
      return is_self() && std::binary_search(a.connected[row_a].begin(), a.connected[row_a].end(), row_b);
    };
    for (int i = 0; i < isize(a.bricks); ++i) {
      for (int j = 0; j < isize(b.bricks); ++j) {
        if (is_left_out(i, j)) continue;
        points_and_triangles(a, i, b, j, 0, visit);
        if (!is_self()) points_and_triangles(b, j, a, i, 1, visit);
        if (is_self() && j < i) continue;
        for (int e = a.first_edge[i]; e < a.first_edge[i + 1]; ++e) {
          for (int f = b.first_edge[j]; f < b.first_edge[j + 1]; ++f) {
            const FeaturePair pair{2, {a.edges[e][0], a.edges[e][1], b.edges[f][0], b.edges[f][1]}, 0};
            if (!hangs(pair)) visit(pair);
          }
        }
      }
    }
  }
  template <class Visit>
  void points_and_triangles(const ContactSurface& points, int i, const ContactSurface& triangles, int j,
                            std::size_t side, const Visit& visit) const {
    for (int point = points.first_point[i]; point < points.first_point[i + 1]; ++point) {
      for (int t = triangles.first_triangle[j]; t < triangles.first_triangle[j + 1]; ++t) {
        const auto& [x, y, z] = triangles.triangles[t];
        const FeaturePair pair{1, {point, x, y, z}, side};
        if (!hangs(pair)) visit(pair);
      }
    }
  }
  [[nodiscard]] bool hangs(const FeaturePair& pair) const {
    if (!is_self()) return false;
    const std::vector<ContactPoint>& points = trees_[0].skin().points;
    for (int i = 0; i < pair.count; ++i) {
      for (int j = pair.count; j < 4; ++j) {
        if (share_a_node(*bodies_[0], points[pair.corners[i]].brick, points[pair.corners[j]].brick)) return true;
      }
    }
    return false;
  }
  std::array<SoftBody*, 2> bodies_;
  std::array<SurfaceTree, 2> trees_;
  FeaturePairs pairs_;
  double dt_;
  std::set<Key> awake_;
  std::set<Key> crossed_;
};

/// SPRUNG_FRONT_STEPS=100000 for long.
long looks_of_a_race() {
  const char* steps = std::getenv("SPRUNG_FRONT_STEPS");
  return steps == nullptr ? 100 : std::stol(steps) / 4;
}

TEST(FeaturePairs, NoneThatMayCrossSleeps) {
  SoftBody a = touching_box({3, 2, 2}, 0.02, test_material(0.3), Vec3::Zero());
  SoftBody b = touching_box({3, 2, 2}, 0.02, test_material(0.3), Vec3(0.01, 0.042, 0.005));
  std::mt19937 random(3);
  long near = 0;
  long missed = 0;
  const long looks = looks_of_a_race();
  for (long look = 0; look < looks;) {
    a.positions = a.rest_positions;
    b.positions = b.rest_positions;
    FeatureRace race(a, b, 1e-3);
    const Waves of_a(random, 0.2);
    const Waves of_b(random, 0.2);
    for (int i = 0; i < 20 && look < looks; ++i, ++look) {
      of_a.set_velocities(a, 0.004 * i);
      of_b.set_velocities(b, 0.004 * i);
      missed += race.look(4, near);
    }
  }
  EXPECT_GT(near, looks);
  EXPECT_EQ(missed, 0);
}

TEST(FeaturePairs, NoneOfOneSurfaceThatMayCrossSleeps) {
  SoftBody body = test::closing_horseshoe(0.02);
  const Points closing = body.velocities;
  std::mt19937 random(5);
  long near = 0;
  long missed = 0;
  const long looks = looks_of_a_race() / 4;
  for (long look = 0; look < looks;) {
    body.positions = body.rest_positions;
    FeatureRace race(body, body, 1e-3);
    const Waves waves(random, 0.1);
    for (int i = 0; i < 20 && look < looks; ++i, ++look) {
      waves.set_velocities(body, 0.004 * i);
      body.velocities += closing;
      missed += race.look(4, near);
    }
  }
  EXPECT_GT(near, 0);
  EXPECT_EQ(missed, 0);
}

}  // namespace
}  // namespace sprung
