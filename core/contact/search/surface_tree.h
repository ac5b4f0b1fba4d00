#pragma once
#include <vector>

#include "core/contact/search/contact_surface.h"
#include "core/world/world.h"

namespace sprung {

/// A ball that encloses vectors.
struct VectorBall {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};

/// How far apart a vector of one ball and one of the other are at most.
[[nodiscard]] inline double reach_between(const VectorBall& a, const VectorBall& b) {
  return a.radius + b.radius + (a.centre - b.centre).norm();
}

/// A binary tree over the bricks of a contact surface, built once from where they are at rest. It knows how the points
/// of each subtree move in a step, and, where asked, the boxes about them and their normals now.
class SurfaceTree {
 public:
  /// Bricks order()[first] ... order()[last - 1]; parents stand before their children. The first child is the next one.
  struct Node {
    int first;
    int last;
    int second_child;  // 0: none, a leaf of one brick
    int cluster;       // whose motions it has; -1: those of its children
    [[nodiscard]] bool is_leaf() const { return second_child == 0; }
  };

  /// Both must outlive it.
  SurfaceTree(const ContactSurface& skin, const SoftBody& body);

  /// As if it were new.
  void begin() {
    before_ = body_.positions;
    refresh();
  }
  /// To be called every few steps, when velocities are those of the step to come; until the next time anything moves by
  /// no more than `time` (s) at them, and `more` (m).
  void follow(double time, double more);
  /// To be called where the body has moved on since: for places, normals and velocities that are asked for.
  void refresh() {
    ++step_;
    refresh_velocities();
  }
  /// To be called where only velocities have changed since.
  void refresh_velocities() { ++velocity_step_; }
  /// Of the body's nodes, m/s, beside their mean velocity.
  [[nodiscard]] double fastest() const;
  /// How many times as far as the body's nodes any of its points may move.
  [[nodiscard]] double spread() const;

  [[nodiscard]] const ContactSurface& skin() const { return skin_; }
  [[nodiscard]] const SoftBody& body() const { return body_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// By place in the tree: the row of a brick in the skin's list.
  [[nodiscard]] int brick_of(const Node& leaf) const { return order_[leaf.first]; }

  /// Of the points and triangles of a subtree: how they have moved since they were last followed, m, and how they will
  /// until the next time, m.
  struct Motion {
    VectorBall moved;
    VectorBall moving;
  };
  [[nodiscard]] const Motion& motion(int node) const { return motions_[node]; }
  /// The same beside the rigid motion of the body, which brings no two of its points closer; of bodies that collide
  /// with themselves.
  [[nodiscard]] const Motion& own_motion(int node) const { return own_motions_[node]; }
  /// The topmost node that always has the same motions: that of its cluster, or itself.
  [[nodiscard]] int cluster_node(int node) const {
    return nodes_[node].cluster < 0 ? node : cluster_nodes_[nodes_[node].cluster];
  }

  /// Of its points and triangles, m, where they are now.
  [[nodiscard]] const AlignedBox& box(int node);
  /// Of its points' and triangles' normals now.
  [[nodiscard]] const NormalCone& cone(int node);
  /// Where a contact point is now, m, and the normal of the skin there, unit.
  [[nodiscard]] const Vec3& place_of(int point);
  [[nodiscard]] const Vec3& normal_of(int point);
  [[nodiscard]] const Vec3& velocity_of(int point);

 private:
  /// By brick of the skin: its middle, and its normal times kNormalWeight, in bricks.
  using Features = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
  void add_node(int first, int last, int cluster, const Features& features);
  void list_nodes_of_clusters();
  /// Of every node, from how the body's nodes have moved and will.
  void measure(const Points& moved, const Points& moving, double more, std::vector<Motion>& motions) const;
  /// Of every node beside the body's rigid motion.
  void measure_own(const Points& moved, const Points& moving);
  template <class Value>
  struct Cached {
    Value value;
    long step = -1;
  };

  const ContactSurface& skin_;
  const SoftBody& body_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  std::vector<int> cluster_nodes_;                  // by cluster: the topmost
  std::vector<std::vector<int>> nodes_of_cluster_;  // of the body, that carry its points and triangles
  std::vector<double> spread_of_cluster_;  // the sum of the weights' sizes of its points, at most; 1: all inside
  std::vector<Motion> motions_;            // by node
  std::vector<Motion> own_motions_;
  Points before_;  // where the body's nodes were when last followed
  long step_ = 0;
  long velocity_step_ = 0;
  std::vector<Cached<AlignedBox>> boxes_;  // by node
  std::vector<Cached<NormalCone>> cones_;
  std::vector<Cached<Vec3>> places_;  // by point
  std::vector<Cached<Vec3>> normals_;
  std::vector<Cached<Vec3>> velocities_;
};

}  // namespace sprung
