#pragma once
#include <array>
#include <vector>

#include "core/contact/search/contact_surface.h"
#include "core/contact/search/rigid_motion.h"
#include "core/world/world.h"

namespace sprung {

/// A ball that encloses vectors.
struct VectorBall {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};

/// The largest distance between a vector of one ball and one of the other.
[[nodiscard]] inline double reach_between(const VectorBall& a, const VectorBall& b) {
  return a.radius + b.radius + (a.centre - b.centre).norm();
}

/// A binary tree over the bricks of a contact surface, built once from their rest positions. It bounds the motion of
/// the points of each subtree in a step and, on demand, their current boxes and normals.
class SurfaceTree {
 public:
  /// Bricks order()[first] ... order()[last - 1]; parents precede their children. The first child is the next node.
  struct Node {
    int first;
    int last;
    int second_child;  // 0: none, a leaf of one brick
    int cluster;       // whose motions it has; -1: those of its children
    [[nodiscard]] bool is_leaf() const { return second_child == 0; }
  };

  /// Both must outlive it.
  SurfaceTree(const ContactSurface& skin, const SoftBody& body);

  /// Resets it to its initial state.
  void begin() {
    followed_ = body_.positions;
    look_ = 0;
    for (auto& motions : brick_motions_) std::fill(motions.begin(), motions.end(), Cached<Motion>{});
    std::fill(heights_.begin(), heights_.end(), Cached<double>{});
    std::fill(heights_about_.begin(), heights_about_.end(), Cached<double>{});
    refresh();
  }
  /// Call every few steps, after refresh(), when velocities are those of the coming step; until the next call nothing
  /// may move further than `time` (s) at them plus `more` (m).
  void follow(double time, double more);
  /// The time and the distance given to follow(), s and m.
  [[nodiscard]] double time_ahead() const { return time_ahead_; }
  [[nodiscard]] double distance_ahead() const { return distance_ahead_; }
  /// Call after the body has moved: for current positions, normals and velocities.
  void refresh() {
    ++step_;
    refresh_velocities();
  }
  /// Call if only velocities have changed since.
  void refresh_velocities() { ++velocity_step_; }
  /// The largest speed of the body's nodes relative to their mean velocity, m/s.
  [[nodiscard]] double fastest() const;
  /// The factor by which its points may move further than the body's nodes.
  [[nodiscard]] double spread() const;

  [[nodiscard]] const ContactSurface& skin() const { return skin_; }
  [[nodiscard]] const SoftBody& body() const { return body_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// The row of a leaf's brick in the skin's list.
  [[nodiscard]] int brick_of(const Node& leaf) const { return order_[leaf.first]; }

  /// How the points and triangles of a subtree have moved since they were last followed, m, and how they will until the
  /// next time, m.
  struct Motion {
    VectorBall moved;
    VectorBall moving;
  };
  [[nodiscard]] const Motion& motion(int node) const { return motions_[node]; }
  /// The same relative to the rigid motion of the body, which brings no two of its points closer; for bodies that
  /// collide with themselves, and surfaces with triangles.
  [[nodiscard]] const Motion& own_motion(int node) const { return own_motions_[node]; }
  /// That of one brick of the skin, or its own, which is tighter than a subtree's.
  [[nodiscard]] const Motion& brick_motion(int brick, bool is_own);
  /// The topmost node that always has the same motions: that of its cluster, or itself.
  [[nodiscard]] int cluster_node(int node) const {
    return nodes_[node].cluster < 0 ? node : cluster_nodes_[nodes_[node].cluster];
  }

  /// The current box of its points and triangles, m.
  [[nodiscard]] const AlignedBox& box(int node);
  /// The current cone of its points' and triangles' normals.
  [[nodiscard]] const NormalCone& cone(int node);
  /// The current position of a contact point, m, and the normal of the skin there, unit.
  [[nodiscard]] const Vec3& position_of(int point) {
    if (positions_[point].step != step_) find_position(point);
    return positions_[point].value;
  }
  [[nodiscard]] const Vec3& normal_of(int point);
  [[nodiscard]] const Vec3& velocity_of(int point) {
    if (velocities_[point].step != velocity_step_) find_velocity(point);
    return velocities_[point].value;
  }
  static constexpr long kHeightLooks = 8;  // calls of follow()
  /// How far (m), at most, the drawn skin has been above the triangles about a point since begin(), or since asked: it
  /// leaves them as bricks bend. Measured again every kHeightLooks calls of follow(); never less than before, since
  /// contact that yields and presses in turn does not come to rest.
  [[nodiscard]] double height_about(int point);
  /// How often more a ray from `start` leaves the surface than it enters it: for a closed surface its winding number,
  /// at least 1 inside, 0 outside, and less where the body is inside out. `direction` of any length; triangles that
  /// have the point `except` as a corner are left out.
  [[nodiscard]] int winding_number(const Vec3& start, const Vec3& direction, int except = -1);
  /// Returns whether a point (m) is inside.
  [[nodiscard]] bool encloses(const Vec3& position) { return winding_number(position, kSkew) > 0; }

 private:
  static inline const Vec3 kSkew{0.3713, 0.4832, 0.7931};  // of rays, which seldom meet an edge then

  /// By brick of the skin: its middle, and its normal times kNormalWeight, in bricks.
  using Features = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
  void add_node(int first, int last, int cluster, const Features& features);
  void list_points_of_bricks();
  void list_nodes_of_clusters();
  void find_position(int point);
  void find_velocity(int point);
  [[nodiscard]] double height_above(int triangle);
  /// Sums the signed crossings of the segment from `start` to `end` with the triangles of a subtree.
  [[nodiscard]] int crossings(int node, const Vec3& start, const Vec3& end, int except);
  [[nodiscard]] Motion find_brick_motion(int brick, bool is_own);
  /// Computes the motion of every node of the tree from the past and coming displacements of the body's nodes.
  void measure(const Points& moved, const Points& moving, double more, std::vector<Motion>& motions) const;
  /// The same relative to the body's rigid motion.
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
  std::vector<std::vector<int>> points_of_brick_;   // of the skin: its own, and its triangles' and edges'
  std::vector<double> spread_of_cluster_;           // its points' largest sum of absolute weights; 1: all inside
  std::vector<Motion> motions_;                     // by node
  std::vector<Motion> own_motions_;
  Points followed_;            // the body's nodes, when last followed
  Points before_;              // and the time before
  Mat3 turned_;                // the body's rotation since then
  RigidMotion turning_;        // and its coming rigid motion, until the next time
  double own_ahead_ = 0;       // m, that points may move besides that
  double time_ahead_ = 0;      // s
  double distance_ahead_ = 0;  // m
  long step_ = 0;
  long velocity_step_ = 0;
  std::vector<Cached<AlignedBox>> boxes_;  // by node
  std::vector<Cached<NormalCone>> cones_;
  std::vector<Cached<Vec3>> positions_;  // by point
  std::vector<Cached<Vec3>> normals_;
  std::vector<Cached<Vec3>> velocities_;
  /// By whether they are own, and brick of the skin; of that many calls of follow().
  std::array<std::vector<Cached<Motion>>, 2> brick_motions_;
  long look_ = 0;                              // calls of follow()
  std::vector<Cached<double>> heights_;        // by triangle, of that many calls
  std::vector<Cached<double>> heights_about_;  // by point, likewise
};

}  // namespace sprung
