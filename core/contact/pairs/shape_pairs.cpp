#include "core/contact/pairs/shape_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace sprung {

ShapePairs::ShapePairs(SurfaceTree& tree, std::size_t body)
    : tree_(tree),
      body_(body),
      brick_(tree.body().grid.brick_size),
      ways_(tree.nodes().size(), 0),
      brick_wakes_(tree.skin().bricks.size(), 0),
      point_wakes_(tree.skin().points.size(), 0),
      impulses_(tree.skin().points.size(), Vec3::Zero()) {}

double ShapePairs::closer(const Obstacle& obstacle, const Pose& pose, const VectorBall& moved, const Vec3& shift,
                          double turned) const {
  const Vec3 apart = moved.centre - shift;
  const bool is_flat = std::holds_alternative<SolidHalfSpace>(obstacle.shape) && obstacle.spin.isZero(0);
  return moved.radius + turned + (is_flat ? std::max(0.0, -pose.rotation.col(1).dot(apart)) : apart.norm());
}

void ShapePairs::wake(const Obstacle& obstacle, const Pose& pose, double time) {
  const Vec3 shifted = is_new_ ? Vec3(Vec3::Zero()) : Vec3(pose.translation - pose_before_.translation);
  double reach = 0;  // m, of the body about the obstacle's centre of rotation
  if (!obstacle.spin.isZero(0)) {
    const Points& positions = tree_.body().positions;
    reach = std::sqrt((positions.rowwise() - pose.translation.transpose()).rowwise().squaredNorm().maxCoeff()) + brick_;
  }
  const double turned = is_new_ ? 0 : Eigen::AngleAxisd(pose_before_.rotation.transpose() * pose.rotation).angle();
  pose_before_ = pose;
  is_new_ = false;
  awake_.clear();
  double coming = 0;
  int cluster = -1;
  const std::vector<SurfaceTree::Node>& nodes = tree_.nodes();
  for (int leaf = 0; leaf < isize(nodes); ++leaf) {
    if (!nodes[leaf].is_leaf()) continue;
    if (tree_.cluster_node(leaf) != cluster) {
      cluster = tree_.cluster_node(leaf);
      const SurfaceTree::Motion& motion = tree_.motion(cluster);
      ways_[cluster] += closer(obstacle, pose, motion.moved, shifted, turned * reach);
      coming = closer(obstacle, pose, motion.moving, obstacle.velocity * time, obstacle.spin.norm() * time * reach);
    }
    if (brick_wakes_[tree_.brick_of(nodes[leaf])] <= ways_[cluster] + coming) look_at(leaf, obstacle, pose, coming);
  }
}

void ShapePairs::look_at(int leaf, const Obstacle& obstacle, const Pose& pose, double coming) {
  const int brick = tree_.brick_of(tree_.nodes()[leaf]);
  const double way = ways_[tree_.cluster_node(leaf)];
  const double reach = kGuardedGap * brick_;
  const AlignedBox& box = tree_.box(leaf);
  const double far = signed_distance(obstacle.shape, pose, box.center()).distance - box.diagonal().norm() / 2;
  if (far > brick_ && distance_until_due(far, reach, brick_) > coming) {
    brick_wakes_[brick] = way + distance_until_due(far, reach, brick_);
    return;
  }
  const ContactSurface& skin = tree_.skin();
  double first = std::numeric_limits<double>::infinity();
  for (int point = skin.first_point[brick]; point < skin.first_point[brick + 1]; ++point) {
    if (point_wakes_[point] <= way + coming) {
      const double gap = signed_distance(obstacle.shape, pose, tree_.place_of(point)).distance;
      const double due = distance_until_due(gap, reach, brick_);
      const bool is_asleep = gap > 0 && due > coming && impulses_[point].isZero(0);
      point_wakes_[point] = is_asleep ? way + due : way;
      if (!is_asleep) awake_.push_back(point);
    }
    first = std::min(first, point_wakes_[point]);
  }
  brick_wakes_[brick] = first;
}

void ShapePairs::measure(const Obstacle& obstacle, const Pose& pose, std::vector<AwakePair>& awake) {
  for (const int point : awake_) {
    const Vec3& position = tree_.place_of(point);
    const Gap gap = signed_distance(obstacle.shape, pose, position);
    awake.push_back({.pair = {.count = 1, .corners = {point, -1, -1, -1}, .first = 0},
                     .bodies = {body_, AwakePair::kNoBody},
                     .normal = gap.normal,
                     .gap = gap.distance,
                     .weights = {1, -1, 0, 0},
                     .obstacle_velocity = velocity_at(obstacle, pose, position),
                     .friction = obstacle.friction,
                     .restitution = obstacle.restitution,
                     .impulse = &impulses_[point],
                     .is_loaded = !impulses_[point].isZero(0)});
  }
}

}  // namespace sprung
