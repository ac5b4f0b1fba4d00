#include <gtest/gtest.h>

#include <cmath>

#include "core/bricks/embedding.h"

namespace sprung {
namespace {

BrickGrid bar() { return make_box_grid({6, 2, 2}, 0.05); }

/// Points on a line through the bar, each in one of the bricks at it.
Embedding line(const BrickGrid& grid, int count) {
  Points points(count, 3);
  for (int i = 0; i < count; ++i) points.row(i) << 0.3 * (i + 0.5) / count, 0.031, 0.067;
  return embed(grid, points);
}

Points bent(const Points& rest) {
  Points nodes = rest;
  for (auto node : nodes.rowwise()) node[1] += 0.4 * std::sin(8 * node[0]) * 0.1;
  return nodes;
}

TEST(SmoothEmbedding, FollowsAffineMotionsExactly) {
  const BrickGrid grid = bar();
  const Embedding embedding = embed(grid, (Points(4, 3) << 0.01, 0.02, 0.03, 0.05, 0.05, 0.05, 0.29, 0.09, 0.001,  //
                                           0.31, -0.02, 0.05)
                                              .finished());  // the last one outside
  Mat3 map;
  map << 1.2, 0.3, -0.1, 0.05, 0.8, 0.4, -0.2, 0.1, 1.1;
  const Points rest = grid.rest_positions();
  const Points nodes = (rest * map.transpose()).rowwise() + Eigen::RowVector3d(1, 2, 3);
  const Points there = deform_points(grid, embedding, nodes);
  const Points normals = Points::Constant(4, 3, 0.5);
  EXPECT_LT((SmoothEmbedding(grid, nodes).points(embedding) - there).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((SmoothEmbedding(grid, nodes).normals(embedding, normals) - deform_normals(grid, embedding, normals, nodes))
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
}

// Across a face the slope of a trilinear skin jumps; that of the smooth one changes as little as within a brick.
TEST(SmoothEmbedding, HasNoCreasesBetweenBricks) {
  const BrickGrid grid = bar();
  const Points nodes = bent(grid.rest_positions());
  const Embedding embedding = line(grid, 1200);
  const auto largest_kink = [](const Points& points) {
    double largest = 0;
    for (Eigen::Index i = 1; i + 1 < points.rows(); ++i) {
      largest = std::max(largest, (points.row(i + 1) - 2 * points.row(i) + points.row(i - 1)).norm());
    }
    return largest;
  };
  EXPECT_LT(largest_kink(SmoothEmbedding(grid, nodes).points(embedding)),
            0.1 * largest_kink(deform_points(grid, embedding, nodes)));
}

TEST(SmoothEmbedding, GoesThroughTheNodesAndNearTheRest) {
  const BrickGrid grid = bar();
  const Points nodes = bent(grid.rest_positions());
  const Points corners = grid.rest_positions();
  EXPECT_LT((SmoothEmbedding(grid, nodes).points(embed(grid, corners)) - nodes).cwiseAbs().maxCoeff(), 1e-12);
  const Embedding embedding = line(grid, 100);
  const Points smooth = SmoothEmbedding(grid, nodes).points(embedding);
  EXPECT_LT((smooth - deform_points(grid, embedding, nodes)).cwiseAbs().maxCoeff(), 0.1 * grid.brick_size);
}

// Checked by differences of the points around a normal.
TEST(SmoothEmbedding, NormalsStandOnTheSurface) {
  const BrickGrid grid = bar();
  const Points nodes = bent(grid.rest_positions());
  const SmoothEmbedding embedding(grid, nodes);
  const double step = 1e-6;
  Points patch(3, 3);
  patch << 0.13, 0.1, 0.04, 0.13 + step, 0.1, 0.04, 0.13, 0.1, 0.04 + step;
  const Points there = embedding.points(embed(grid, patch));
  const Vec3 across = (there.row(2) - there.row(0)).cross(there.row(1) - there.row(0)).transpose().normalized();
  const Points up = Eigen::RowVector3d(0, 1, 0);
  const Vec3 normal = embedding.normals(embed(grid, patch.topRows(1)), up).row(0).transpose().normalized();
  EXPECT_LT((normal - across).norm(), 1e-5);
}

}  // namespace
}  // namespace sprung
