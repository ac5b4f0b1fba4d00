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
      impulses_(tree.skin().points.size(), Vec3::Zero()),
      loaded_(std::size_t(tree.body().node_count()), -1) {
  const ContactSurface& skin = tree.skin();
  for (std::size_t brick = 0; brick < skin.bricks.size(); ++brick) {
    double& spread = spreads_.emplace_back(1);
    for (int point = skin.first_point[brick]; point < skin.first_point[brick + 1]; ++point) {
      spread = std::max(spread, skin.points[point].weights.cwiseAbs().sum());
    }
  }
}

double ShapePairs::distance_to_brick(int brick, const Obstacle& obstacle, const Pose& pose) const {
  AlignedBox box;
  for (const int node : tree_.body().grid.nodes[tree_.skin().bricks[brick]]) {
    box.extend(Vec3(tree_.body().positions.row(node)));
  }
  return signed_distance(obstacle.shape, pose, box.center()).distance - spreads_[brick] * box.diagonal().norm() / 2;
}

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
  woken_.clear();
  ++look_;
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
  for (const Woken& woken : woken_) {
    if (!impulses_[woken.point].isZero(0)) loaded_[nearest_node(woken.point)] = look_;
  }
  awake_.clear();
  for (const Woken& woken : woken_) {
    if (!may_skip(woken)) awake_.push_back(woken.point);
  }
}

double ShapePairs::coming_closer(int point, const Vec3& normal, const Obstacle& obstacle) {
  if (!obstacle.spin.isZero(0)) return std::numeric_limits<double>::infinity();
  const double speed = normal.dot(obstacle.velocity - tree_.velocity_of(point));
  return tree_.time_ahead() * std::max(0.0, speed) + tree_.distance_ahead();
}

int ShapePairs::nearest_node(int point) const {
  const ContactPoint& at = tree_.skin().points[point];
  return tree_.body().grid.nodes[at.brick][at.corner];
}

bool ShapePairs::may_skip(const Woken& woken) {
  if (!impulses_[woken.point].isZero(0) || woken.gap < kBorne * kGuardedGap * brick_) return false;
  if (loaded_[nearest_node(woken.point)] != look_) return false;
  if (!(woken.coming < kSkipped * woken.gap)) return false;
  point_wakes_[woken.point] += kSkipped * woken.gap;
  return true;
}

void ShapePairs::look_at(int leaf, const Obstacle& obstacle, const Pose& pose, double coming) {
  const int brick = tree_.brick_of(tree_.nodes()[leaf]);
  const double way = ways_[tree_.cluster_node(leaf)];
  const double reach = kGuardedGap * brick_;
  const double far = distance_to_brick(brick, obstacle, pose);
  if (far > brick_ && distance_until_due(far, reach, brick_) > coming) {
    brick_wakes_[brick] = way + distance_until_due(far, reach, brick_);
    return;
  }
  const ContactSurface& skin = tree_.skin();
  double first = std::numeric_limits<double>::infinity();
  for (int point = skin.first_point[brick]; point < skin.first_point[brick + 1]; ++point) {
    if (point_wakes_[point] <= way + coming) {
      const Gap gap = signed_distance(obstacle.shape, pose, tree_.position_of(point));
      const double due = distance_until_due(gap.distance, reach, brick_);
      const bool may_sleep = gap.distance > 0 && impulses_[point].isZero(0);
      const bool is_asleep = may_sleep && due > coming;
      point_wakes_[point] = is_asleep ? way + due : way;
      if (!is_asleep && !(may_sleep && due > coming_closer(point, gap.normal, obstacle))) {
        woken_.push_back({point, gap.distance, coming});
      }
    }
    first = std::min(first, point_wakes_[point]);
  }
  brick_wakes_[brick] = first;
}

void ShapePairs::measure(const Obstacle& obstacle, const Pose& pose, std::vector<AwakePair>& awake) {
  for (const int point : awake_) {
    const Vec3& position = tree_.position_of(point);
    const Gap gap = signed_distance(obstacle.shape, pose, position);
    awake.push_back({.pair = {.count = 1, .corners = {point, -1, -1, -1}, .first = 0},
                     .bodies = {body_, AwakePair::kNoBody},
                     .normal = gap.normal,
                     .gap = gap.distance,
                     .weights = {1, -1, 0, 0},
                     .obstacle_velocity = velocity_at(obstacle, pose, position),
                     .reach = kGuardedGap * brick_,
                     .friction = obstacle.friction,
                     .restitution = obstacle.restitution,
                     .impulse = &impulses_[point],
                     .is_loaded = !impulses_[point].isZero(0)});
  }
}

}  // namespace sprung
