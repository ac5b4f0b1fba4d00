#include "core/contact/search/surface_tree.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace sprung
