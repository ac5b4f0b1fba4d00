#include "core/contact/search/surface_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/contact/search/segment_crossing.h"
#include "tests/support/touching.h"

namespace sprung {
namespace {

TEST(SegmentCrossing, TellsTheDirection) {
  const Vec3 a(0, 0, 0);
  const Vec3 b(1, 0, 0);
  const Vec3 c(0, 1, 0);
  const Vec3 behind(0.2, 0.2, -1);
  const Vec3 in_front(0.3, 0.2, 1);
  EXPECT_EQ(segment_crossing(behind, in_front, a, b, c), 1);
  EXPECT_EQ(segment_crossing(in_front, behind, a, b, c), -1);
  EXPECT_EQ(segment_crossing(in_front, Vec3(0.2, 0.2, 0.1), a, b, c), 0) << "too short";
  EXPECT_EQ(segment_crossing(Vec3(0.6, 0.6, -1), Vec3(0.6, 0.6, 1), a, b, c), 0) << "beside it";
}

/// The winding number of a box about two points, and how many of its own points count as inside.
struct Windings {
  int about_middle;
  int about_outside;
  int of_points_inside;
};

Windings windings_of(SoftBody& body) {
  SurfaceTree tree(contact_surface_of(body), body);
  tree.refresh();
  const Vec3 skew(0.3713, 0.4832, 0.7931);
  int inside = 0;
  for (int point = 0; point < isize(tree.skin().points); ++point) {
    inside += tree.winding_number(tree.position_of(point), tree.normal_of(point), point) > 0 ? 1 : 0;
  }
  return {tree.winding_number(Vec3(0.031, 0.042, 0.029), skew), tree.winding_number(Vec3(0.031, 0.09, 0.029), skew),
          inside};
}

TEST(SurfaceTree, WindsOnceAboutWhatIsInside) {
  SoftBody box = test::touching_box({3, 4, 3}, 0.02, test::test_material(0.3), Vec3::Zero());
  const Windings found = windings_of(box);
  EXPECT_EQ(found.about_middle, 1);
  EXPECT_EQ(found.about_outside, 0);
  EXPECT_EQ(found.of_points_inside, 0);
}

TEST(SurfaceTree, WindsBackwardsAboutWhatIsInsideOut) {
  SoftBody box = test::touching_box({3, 4, 3}, 0.02, test::test_material(0.3), Vec3::Zero());
  box.positions.col(1) = 0.08 - box.positions.col(1).array();
  const Windings found = windings_of(box);
  EXPECT_EQ(found.about_middle, -1);
  EXPECT_EQ(found.about_outside, 0);
}

/// A tent of two triangles over a brick's top, and vertices of what is drawn above and below them.
struct Tent {
  SoftBody body = test::touching_box({1, 1, 1}, 0.1, test::test_material(0.3), Vec3::Zero());
  Tent() {
    Points at(4, 3);
    at << 0, 0.5, 0, /**/ 1, 0.5, 0, /**/ 1, 0.5, 1, /**/ 0, 0.5, 1;
    body.contact.points = {.brick = {0, 0, 0, 0}, .local = at};
    body.contact.triangles.resize(2, 3);
    body.contact.triangles << 0, 2, 1, /**/ 0, 3, 2;
    Points drawn(3, 3);
    drawn << 0.8, 0.6, 0.2, /**/ 0.7, 0.55, 0.3, /**/ 0.2, 0.3, 0.8;
    body.drawn.embedding = {.brick = {0, 0, 0}, .local = drawn};
    body.contact.beneath = {0, 0, 1};
    body.contact.surface.reset();
  }
};

TEST(SurfaceTree, KnowsHowHighTheDrawnSkinIsAboveItsTriangles) {
  Tent tent;
  SurfaceTree tree(contact_surface_of(tent.body), tent.body);
  tree.begin();
  const auto corner = [&](int row) {
    const CornerWeights weights = trilinear_weights(tent.body.contact.points.local.row(row));
    const auto& points = tree.skin().points;
    return int(std::find_if(points.begin(), points.end(),
                            [&](const ContactPoint& point) { return point.weights.isApprox(weights); }) -
               points.begin());
  };
  EXPECT_NEAR(tree.height_about(corner(1)), 0.1 * 0.1, 1e-12) << "of the highest of its triangle";
  EXPECT_NEAR(tree.height_about(corner(0)), 0.1 * 0.1, 1e-12) << "of both of its triangles";
  EXPECT_EQ(tree.height_about(corner(3)), 0) << "below";
  tent.body.positions.col(1) *= 1.2;
  tree.refresh();
  for (int look = 0; look < 10; ++look) tree.follow(1e-3, 0);
  EXPECT_NEAR(tree.height_about(corner(1)), 0.12 * 0.1, 1e-12) << "it follows the brick";
}

}  // namespace
}  // namespace sprung
