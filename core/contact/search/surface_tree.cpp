#include "core/contact/search/surface_tree.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/body/body.h"
#include "core/contact/search/segment_crossing.h"

namespace sprung {
namespace {

constexpr int kBricksOfCluster = 8;
constexpr double kMaxHeight = 0.15;  // bricks, of which contact takes account
constexpr double kNormalWeight = 4;  // bricks that opposite normals are worth, halved, in grouping bricks

VectorBall enclosing(const VectorBall& a, const VectorBall& b) {
  const double apart = (a.centre - b.centre).norm();
  if (apart + b.radius <= a.radius) return a;
  if (apart + a.radius <= b.radius) return b;
  const double radius = (apart + a.radius + b.radius) / 2;
  return {a.centre + (radius - a.radius) / apart * (b.centre - a.centre), radius};
}

NormalCone enclosing(const NormalCone& a, const NormalCone& b) {
  const Vec3 sum = a.axis + b.axis;
  if (!(sum.norm() > 1e-6)) return {a.axis, std::numbers::pi};
  const Vec3 axis = sum.normalized();
  const auto spread = [&](const NormalCone& cone) {
    return cone.spread + std::acos(std::clamp(cone.axis.dot(axis), -1.0, 1.0));
  };
  return {axis, std::min(std::max(spread(a), spread(b)), std::numbers::pi)};
}

/// Whether a segment passes through a box.
bool meets(const AlignedBox& box, const Vec3& start, const Vec3& end) {
  double first = 0;
  double last = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = end[axis] - start[axis];
    if (along == 0) {
      if (start[axis] < box.min()[axis] || start[axis] > box.max()[axis]) return false;
      continue;
    }
    const double at_min = (box.min()[axis] - start[axis]) / along;
    const double at_max = (box.max()[axis] - start[axis]) / along;
    first = std::max(first, std::min(at_min, at_max));
    last = std::min(last, std::max(at_min, at_max));
  }
  return first <= last;
}

constexpr Eigen::Index kFitted = 64;  // about this many points suffice

/// The least-squares rigid motion of vectors at some of these positions.
RigidMotion rigid_fit(const Points& positions, const Points& vectors) {
  const Eigen::Index stride = std::max(Eigen::Index{1}, positions.rows() / kFitted);
  std::vector<MovingMass> some;
  for (Eigen::Index row = 0; row < positions.rows(); row += stride) {
    some.push_back({1, positions.row(row), vectors.row(row)});
  }
  return rigid_motion_of(some);
}

}  // namespace

SurfaceTree::SurfaceTree(const ContactSurface& skin, const SoftBody& body)
    : skin_(skin), body_(body), followed_(body.positions) {
  const int count = isize(skin.bricks);
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0);
  Features features(count, 6);
  for (int row = 0; row < count; ++row) {
    features.row(row) << body.grid.cells[skin.bricks[row]].cast<double>().transpose(),
        kNormalWeight * skin.cones[row].axis.transpose();
  }
  if (count > 0) add_node(0, count, -1, features);
  list_points_of_bricks();
  list_nodes_of_clusters();
  for (auto& motions : brick_motions_) motions.resize(skin.bricks.size());
  motions_.resize(nodes_.size());
  own_motions_.resize(nodes_.size());
  boxes_.resize(nodes_.size());
  cones_.resize(nodes_.size());
  positions_.resize(skin.points.size());
  normals_.resize(skin.points.size());
  velocities_.resize(skin.points.size());
  if (!skin.drawn.empty()) {
    heights_.resize(skin.triangles.size());
    heights_about_.resize(skin.points.size());
  }
}

void SurfaceTree::add_node(int first, int last, int cluster, const Features& features) {
  const std::size_t node = nodes_.size();
  if (cluster < 0 && last - first <= kBricksOfCluster) {
    cluster = isize(cluster_nodes_);
    cluster_nodes_.push_back(int(node));
  }
  nodes_.push_back({first, last, 0, cluster});
  if (last - first == 1) return;
  const Features these = features(std::vector<int>(order_.begin() + first, order_.begin() + last), Eigen::all);
  Eigen::Index axis = 0;
  (these.colwise().maxCoeff() - these.colwise().minCoeff()).maxCoeff(&axis);
  const int half = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                   [&](int a, int b) { return std::pair(features(a, axis), a) < std::pair(features(b, axis), b); });
  add_node(first, half, cluster, features);
  nodes_[node].second_child = isize(nodes_);
  add_node(half, last, cluster, features);
}

void SurfaceTree::list_points_of_bricks() {
  for (int row = 0; row < isize(skin_.bricks); ++row) {
    std::vector<int>& points = points_of_brick_.emplace_back();
    for (int point = skin_.first_point[row]; point < skin_.first_point[row + 1]; ++point) points.push_back(point);
    for (int triangle = skin_.first_triangle[row]; triangle < skin_.first_triangle[row + 1]; ++triangle) {
      points.insert(points.end(), skin_.triangles[triangle].begin(), skin_.triangles[triangle].end());
    }
    for (int edge = skin_.first_edge[row]; edge < skin_.first_edge[row + 1]; ++edge) {
      points.push_back(skin_.edges[edge][1]);
    }
    sort_unique(points);
  }
}

void SurfaceTree::list_nodes_of_clusters() {
  for (const int node : cluster_nodes_) {
    std::vector<int>& nodes = nodes_of_cluster_.emplace_back();
    double& spread = spread_of_cluster_.emplace_back(1);
    for (int i = nodes_[node].first; i < nodes_[node].last; ++i) {
      for (const int point : points_of_brick_[order_[i]]) {
        const ContactPoint& at = skin_.points[point];
        nodes.insert(nodes.end(), body_.grid.nodes[at.brick].begin(), body_.grid.nodes[at.brick].end());
        spread = std::max(spread, at.weights.cwiseAbs().sum());
      }
    }
    sort_unique(nodes);
  }
}

double SurfaceTree::spread() const {
  return spread_of_cluster_.empty() ? 1 : *std::max_element(spread_of_cluster_.begin(), spread_of_cluster_.end());
}

double SurfaceTree::fastest() const {
  const Vec3 mean = body_.velocities.colwise().mean();
  return std::sqrt((body_.velocities.rowwise() - mean.transpose()).rowwise().squaredNorm().maxCoeff());
}

void SurfaceTree::measure(const Points& moved, const Points& moving, double more, std::vector<Motion>& motions) const {
  using Row = Eigen::Array3d;
  std::vector<Motion> of_clusters(cluster_nodes_.size());
  for (std::size_t cluster = 0; cluster < of_clusters.size(); ++cluster) {
    const auto ball_of = [&](const Points& vectors) -> VectorBall {
      Row low = Row::Constant(std::numeric_limits<double>::infinity());
      Row high = -low;
      for (const int row : nodes_of_cluster_[cluster]) {
        low = low.min(vectors.row(row).transpose().array());
        high = high.max(vectors.row(row).transpose().array());
      }
      return {(low + high) / 2, spread_of_cluster_[cluster] * (high - low).matrix().norm() / 2};
    };
    of_clusters[cluster] = {ball_of(moved), ball_of(moving)};
    of_clusters[cluster].moving.radius += more;
  }
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    if (node.cluster >= 0) {
      motions[i] = of_clusters[node.cluster];
    } else {
      motions[i].moved = enclosing(motions[i + 1].moved, motions[node.second_child].moved);
      motions[i].moving = enclosing(motions[i + 1].moving, motions[node.second_child].moving);
    }
  }
}

void SurfaceTree::follow(double time, double more) {
  refresh_velocities();
  ++look_;
  time_ahead_ = time;
  distance_ahead_ = more;
  before_ = followed_;
  followed_ = body_.positions;
  const Points moved = followed_ - before_;
  const Points moving = time * body_.velocities;
  measure(moved, moving, more, motions_);
  if (body_.contact.with_itself && !skin_.triangles.empty()) measure_own(moved, moving);
}

void SurfaceTree::measure_own(const Points& moved, const Points& moving) {
  // The body's past rigid motion is removed as a rotation, which is exact; the coming one as a velocity.
  const RigidMotion turned = rigid_fit(before_, moved);
  const double angle = turned.spin.norm();
  turned_ = angle > 0 ? Eigen::AngleAxisd(angle, turned.spin / angle).toRotationMatrix() : Mat3(Mat3::Identity());
  turning_ = rigid_fit(followed_, moving);
  Points own_moved(moved.rows(), 3);
  Points own_moving(moved.rows(), 3);
  double furthest = 0;
  const Vec3 middle = body_.positions.colwise().mean();
  for (int row = 0; row < moved.rows(); ++row) {
    const Vec3 now = body_.positions.row(row);
    own_moved.row(row) = (now - turned_ * Vec3(before_.row(row))).transpose();
    own_moving.row(row) = (Vec3(moving.row(row)) - turning_.at(now)).transpose();
    furthest = std::max(furthest, (now - middle).squaredNorm());
  }
  own_ahead_ = turning_.spin.squaredNorm() * std::sqrt(furthest) / 2 + distance_ahead_;
  measure(own_moved, own_moving, own_ahead_, own_motions_);
}

SurfaceTree::Motion SurfaceTree::find_brick_motion(int brick, bool is_own) {
  Eigen::AlignedBox3d moved;
  Eigen::AlignedBox3d moving;
  for (const int point : points_of_brick_[brick]) {
    const Vec3& now = position_of(point);
    const Vec3 before = carried(body_, skin_.points[point], before_);
    moved.extend(now - (is_own ? Vec3(turned_ * before) : before));
    const Vec3 coming = time_ahead_ * velocity_of(point);
    moving.extend(is_own ? Vec3(coming - turning_.at(now)) : coming);
  }
  return {{moved.center(), moved.diagonal().norm() / 2},
          {moving.center(), moving.diagonal().norm() / 2 + (is_own ? own_ahead_ : distance_ahead_)}};
}

const SurfaceTree::Motion& SurfaceTree::brick_motion(int brick, bool is_own) {
  Cached<Motion>& motion = brick_motions_[is_own][brick];
  if (motion.step != look_) motion = {find_brick_motion(brick, is_own), look_};
  return motion.value;
}

void SurfaceTree::find_position(int point) {
  positions_[point] = {carried(body_, skin_.points[point], body_.positions), step_};
}

const Vec3& SurfaceTree::normal_of(int point) {
  Cached<Vec3>& normal = normals_[point];
  if (normal.step != step_) {
    normal = {carried_normal(body_, skin_.points[point].brick, skin_.normals.row(point)), step_};
  }
  return normal.value;
}

void SurfaceTree::find_velocity(int point) {
  velocities_[point] = {carried(body_, skin_.points[point], body_.velocities), velocity_step_};
}

double SurfaceTree::height_above(int triangle) {
  Cached<double>& height = heights_[triangle];
  if (height.step >= 0 && look_ - height.step < kHeightLooks) return height.value;
  const auto& [a, b, c] = skin_.triangles[triangle];
  const Vec3 area = (position_of(b) - position_of(a)).cross(position_of(c) - position_of(a));
  const Vec3 normal = area.normalized();
  double highest = height.step >= 0 ? height.value : 0;
  for (int i = skin_.first_drawn[triangle]; i < skin_.first_drawn[triangle + 1]; ++i) {
    highest = std::max(highest, normal.dot(carried(body_, skin_.drawn[i], body_.positions) - position_of(a)));
  }
  height = {std::min(highest, kMaxHeight * body_.grid.brick_size), look_};
  return height.value;
}

double SurfaceTree::height_about(int point) {
  if (heights_about_.empty()) return 0;
  Cached<double>& height = heights_about_[point];
  if (height.step >= 0 && look_ - height.step < kHeightLooks) return height.value;
  height = {0, look_};
  for (const int triangle : skin_.around[point]) height.value = std::max(height.value, height_above(triangle));
  return height.value;
}

const AlignedBox& SurfaceTree::box(int row) {
  Cached<AlignedBox>& box = boxes_[row];
  if (box.step == step_) return box.value;
  const Node& node = nodes_[row];
  AlignedBox now;
  if (node.is_leaf()) {
    const int brick = brick_of(node);
    for (int i = skin_.first_point[brick]; i < skin_.first_point[brick + 1]; ++i) now.extend(position_of(i));
    for (int i = skin_.first_triangle[brick]; i < skin_.first_triangle[brick + 1]; ++i) {
      for (const int corner : skin_.triangles[i]) now.extend(position_of(corner));
    }
    for (int i = skin_.first_edge[brick]; i < skin_.first_edge[brick + 1]; ++i)
      now.extend(position_of(skin_.edges[i][1]));
  } else {
    now = this->box(row + 1);
    now.extend(this->box(node.second_child));
  }
  box = {now, step_};
  return box.value;
}

int SurfaceTree::winding_number(const Vec3& start, const Vec3& direction, int except) {
  const AlignedBox& all = box(0);
  const double far = (all.center() - start).norm() + all.diagonal().norm();
  return crossings(0, start, start + far * direction.normalized(), except);
}

int SurfaceTree::crossings(int row, const Vec3& start, const Vec3& end, int except) {
  if (!meets(box(row), start, end)) return 0;
  const Node& node = nodes_[row];
  if (!node.is_leaf()) {
    return crossings(row + 1, start, end, except) + crossings(node.second_child, start, end, except);
  }
  const int brick = brick_of(node);
  int sum = 0;
  for (int i = skin_.first_triangle[brick]; i < skin_.first_triangle[brick + 1]; ++i) {
    const auto& [a, b, c] = skin_.triangles[i];
    if (a == except || b == except || c == except) continue;
    sum += segment_crossing(start, end, position_of(a), position_of(b), position_of(c));
  }
  return sum;
}

const NormalCone& SurfaceTree::cone(int row) {
  Cached<NormalCone>& cone = cones_[row];
  if (cone.step == step_) return cone.value;
  const Node& node = nodes_[row];
  if (node.is_leaf()) {
    const int brick = brick_of(node);
    cone.value = {carried_normal(body_, skin_.bricks[brick], skin_.cones[brick].axis), 0};
    double least = 1;
    for (int i = skin_.first_point[brick]; i < skin_.first_point[brick + 1]; ++i) {
      least = std::min(least, normal_of(i).dot(cone.value.axis));
    }
    for (int i = skin_.first_triangle[brick]; i < skin_.first_triangle[brick + 1]; ++i) {
      const auto& [a, b, c] = skin_.triangles[i];
      const Vec3 area = (position_of(b) - position_of(a)).cross(position_of(c) - position_of(a));
      least = std::min(least, area.norm() > 0 ? area.normalized().dot(cone.value.axis) : -1);
    }
    cone.value.spread = std::acos(std::clamp(least, -1.0, 1.0));
  } else {
    const NormalCone first = this->cone(row + 1);
    cone.value = enclosing(first, this->cone(node.second_child));
  }
  cone.step = step_;
  return cone.value;
}

}  // namespace sprung
