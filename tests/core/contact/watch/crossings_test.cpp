#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/contact/watch/crossing_depth.h"
#include "core/contact/watch/crossing_pairs.h"
#include "core/simulation/shapes.h"

namespace sprung {
namespace {

Skin skin_of(const SurfaceMesh& mesh, double longest_edge = 0) { return make_skin(mesh, {.max_edge = longest_edge}); }

Skin turned(Skin skin, const Vec3& degrees, const Vec3& shift) {
  skin.positions = (skin.positions * rotation_matrix(degrees).transpose()).rowwise() + shift.transpose();
  return skin;
}

Skin joined(const Skin& a, const Skin& b) {
  Skin both = a;
  both.positions.conservativeResize(a.positions.rows() + b.positions.rows(), 3);
  both.positions.bottomRows(b.positions.rows()) = b.positions;
  both.triangles.conservativeResize(a.triangles.rows() + b.triangles.rows(), 3);
  both.triangles.bottomRows(b.triangles.rows()) = b.triangles.array() + int(a.positions.rows());
  return both;
}

RowPairs pairs_of(const DrawnSurface& a, const DrawnSurface& b) {
  return crossing_pairs(a, b, cells_that_may_cross(a, b));
}

CrossingDepth depth_between(const Skin& a, const Skin& b) {
  DrawnSurface one(a);
  DrawnSurface other(b);
  one.complete();
  other.complete();
  const RowPairs pairs = pairs_of(one, other);
  return pairs.empty() ? CrossingDepth{} : crossing_depth(one, other, pairs);
}

CrossingDepth depth_within(const Skin& skin) {
  DrawnSurface surface(skin);
  surface.complete();
  const RowPairs pairs = pairs_of(surface, surface);
  return pairs.empty() ? CrossingDepth{} : crossing_depth(surface, surface, pairs);
}

using Corners = std::array<Vec3, 3>;
const Corners kFloor{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)};

TEST(Crossings, TrianglesCrossWhereTheyHaveAPointInCommon) {
  EXPECT_TRUE(do_intersect(kFloor, {Vec3(0.2, -1, 0.2), Vec3(0.2, 1, 0.2), Vec3(0.3, 1, 0.2)}));
  EXPECT_FALSE(do_intersect(kFloor, {Vec3(2, -1, 0.2), Vec3(2, 1, 0.2), Vec3(2.1, 1, 0.2)}));
  EXPECT_TRUE(do_intersect(kFloor, {Vec3(0.2, 0, 0.2), Vec3(0.2, 1, 0.2), Vec3(0.3, 1, 0.2)})) << "touches";
  EXPECT_FALSE(do_intersect(kFloor, {Vec3(0.2, 1e-17, 0.2), Vec3(0.2, 1, 0.2), Vec3(0.3, 1, 0.2)})) << "does not quite";
  EXPECT_TRUE(do_intersect(kFloor, {Vec3(0.1, 0, 0.1), Vec3(3, 0, 0.1), Vec3(3, 0, 3)})) << "in one plane";
  EXPECT_FALSE(do_intersect(kFloor, {Vec3(0.6, 0, 0.6), Vec3(3, 0, 0.6), Vec3(3, 0, 3)})) << "beside, in one plane";
}

TEST(Crossings, TrianglesWithoutAreaAreSegments) {
  const Corners needle{Vec3(0.2, -1, 0.2), Vec3(0.2, 1, 0.2), Vec3(0.2, 0.5, 0.2)};
  EXPECT_TRUE(do_intersect(kFloor, needle));
  EXPECT_TRUE(do_intersect(needle, kFloor));
  EXPECT_TRUE(do_intersect(needle, {Vec3(0, 0, 0.2), Vec3(1, 0, 0.2), Vec3(0.5, 0, 0.2)}));
  EXPECT_FALSE(do_intersect(kFloor, {Vec3(2, -1, 0.2), Vec3(2, 1, 0.2), Vec3(2, 0, 0.2)}));
}

TEST(Crossings, BoxesInEachOtherAreAsDeepAsTheyOverlap) {
  const Skin box = skin_of(box_mesh({0.1, 0.1, 0.1}), 0.02);
  const Vec3 tilt(10, 20, 30);
  const Vec3 up = rotation_matrix(tilt).col(1);
  const Skin lower = turned(box, tilt, Vec3::Zero());
  EXPECT_EQ(depth_between(lower, turned(box, tilt, 0.1001 * up)).depth, 0);
  for (const double depth : {0.0001, 0.004}) {
    const Skin upper = turned(skin_of(box_mesh({0.05, 0.1, 0.05}), 0.02), tilt, (0.1 - depth) * up);
    EXPECT_NEAR(depth_between(lower, upper).depth, depth, 1e-9);
    EXPECT_NEAR(depth_within(joined(lower, upper)).depth, depth, 1e-9) << "one skin";
  }
}

/// The overlap of the spheres is a lens; the deepest points are on the line between their centres.
TEST(Crossings, BallsInEachOtherAreAsDeepAsTheirLens) {
  const Skin ball = skin_of(mesh_of(SphereShape{0.05}));
  const Skin other = turned(ball, {0, 40, 0}, {0, 0.092, 0});
  const CrossingDepth found = depth_between(ball, other);
  EXPECT_NEAR(found.depth, 0.008, 0.0002);
  EXPECT_LT(std::hypot(found.position.x(), found.position.z()), 0.005);
  EXPECT_GT(found.position.y(), 0.04);
  EXPECT_NEAR(depth_within(joined(ball, other)).depth, found.depth, 0.0005);
}

/// No vertex of either is in the other: the edges of the needle are deepest in the middle of the plate.
TEST(Crossings, NeedleThroughAPlateIsHalfAsDeepAsThePlate) {
  const Skin plate = skin_of(box_mesh({0.1, 0.004, 0.1}));
  const Skin needle = turned(skin_of(box_mesh({0.003, 0.1, 0.003})), {0, 15, 0}, {0.003, 0, 0.001});
  EXPECT_NEAR(depth_between(plate, needle).depth, 0.002, 1e-9);
}

/// The middle of a box's top is pressed out through its bottom: what is beyond that is inside out, not in the box
/// twice.
TEST(Crossings, SkinPressedThroughItselfIsAsDeepAsItComesOut) {
  Skin box = skin_of(box_mesh({0.1, 0.1, 0.1}), 0.02);
  const double top = box.positions.col(1).maxCoeff();
  int pressed = 0;
  for (auto point : box.positions.rowwise()) {
    if (point.y() < top - 1e-6 || std::abs(point.x()) > 0.03 || std::abs(point.z()) > 0.03) continue;
    point.y() -= 0.104;
    ++pressed;
  }
  ASSERT_GT(pressed, 0);
  EXPECT_NEAR(depth_within(box).depth, 0.004, 1e-9);
}

/// Of three boxes in one skin two overlap from the start, and the third enters one of these.
TEST(Crossings, WhatIsTangledAtTheStartCanBeLeftAlone) {
  const Skin box = skin_of(box_mesh({0.1, 0.1, 0.1}), 0.02);
  const Skin bar = skin_of(box_mesh({0.1, 0.05, 0.05}), 0.02);
  const Skin two = joined(box, turned(bar, Vec3::Zero(), {0.07, 0, 0}));
  DrawnSurface start(joined(two, turned(bar, Vec3::Zero(), {-0.2, 0, 0})));
  DrawnSurface later(joined(two, turned(bar, Vec3::Zero(), {-0.09, 0, 0})));
  start.complete();
  later.complete();
  const std::vector<int> tangles = tangles_of(start, pairs_of(start, start));
  int tangle = 0;
  for (Eigen::Index point = 0; point < start.points().rows(); ++point) {
    const double x = start.points()(point, 0);
    EXPECT_TRUE(tangles[point] == 0 || (x > 0 && x < 0.07)) << x;
    EXPECT_TRUE(tangles[point] != 0 || x < 0.019 || x > 0.021) << "the end of a bar that is in the box";
    if (tangles[point] == 0) continue;
    if (tangle == 0) tangle = tangles[point];
    EXPECT_EQ(tangles[point], tangle) << "box and bar are one";
  }
  const RowPairs pairs = pairs_of(later, later);
  EXPECT_GE(crossing_depth(later, later, pairs).depth, 0.03);
  EXPECT_NEAR(crossing_depth(later, later, pairs, tangles).depth, 0.01, 1e-6);
}

TEST(Crossings, TanglesApartAreTold) {
  const Skin bar = skin_of(box_mesh({0.1, 0.05, 0.05}), 0.02);
  const Skin two = joined(bar, turned(skin_of(box_mesh({0.1, 0.1, 0.1}), 0.02), Vec3::Zero(), {0.07, 0, 0}));
  DrawnSurface surface(joined(two, turned(two, Vec3::Zero(), {0, 0.3, 0})));
  surface.complete();
  const std::vector<int> tangles = tangles_of(surface, pairs_of(surface, surface));
  std::set<int> low;
  std::set<int> high;
  for (Eigen::Index point = 0; point < surface.points().rows(); ++point) {
    if (tangles[point] != 0) (surface.points()(point, 1) < 0.15 ? low : high).insert(tangles[point]);
  }
  EXPECT_EQ(low.size(), 1U);
  EXPECT_EQ(high.size(), 1U);
  EXPECT_NE(low, high);
}

TEST(Crossings, SkinThatTouchesNothingHasNone) {
  const DrawnSurface torus(skin_of(mesh_of(TorusShape{0.03, 0.01})));
  EXPECT_TRUE(pairs_of(torus, torus).empty());
  const DrawnSurface other(turned(skin_of(mesh_of(TorusShape{0.03, 0.01})), {90, 0, 0}, {0.03, 0, 0}));
  EXPECT_TRUE(pairs_of(torus, other).empty()) << "links of a chain";
}

}  // namespace
}  // namespace sprung
