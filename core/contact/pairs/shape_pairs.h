#pragma once
#include <vector>

#include "core/contact/pairs/awake_pair.h"
#include "core/contact/search/surface_tree.h"

namespace sprung {

/// The points of a surface that may meet an obstacle without edges (a half-space, ball or capsule) in the steps to
/// come: the counterpart of FeaturePairs. The surface is followed by its tree, the obstacle by its motion.
class ShapePairs {
 public:
  /// For body `body`; its tree must outlive it.
  ShapePairs(SurfaceTree& tree, std::size_t body);

  /// Call after SurfaceTree::follow(): finds the points that may meet until the next call, within `time` (s). `pose`:
  /// of the obstacle now.
  void wake(const Obstacle& obstacle, const Pose& pose, double time);
  /// Appends these with their current geometry, in a fixed order. Call after SurfaceTree::refresh().
  void measure(const Obstacle& obstacle, const Pose& pose, std::vector<AwakePair>& awake);

 private:
  /// How far a subtree and the obstacle come closer, m, if the displacements of the one lie in a ball of vectors, and
  /// the other moves by `shift` (m) plus at most `turned` (m).
  [[nodiscard]] double closer(const Obstacle& obstacle, const Pose& pose, const VectorBall& moved, const Vec3& shift,
                              double turned) const;
  /// A lower bound of the distance between the points of a brick and the obstacle, m.
  [[nodiscard]] double distance_to_brick(int brick, const Obstacle& obstacle, const Pose& pose) const;
  void look_at(int leaf, const Obstacle& obstacle, const Pose& pose, double coming);
  /// How far (m) a point may approach an obstacle until woken again: obstacles without edges are convex, and the plane
  /// across the normal at the nearest point separates them. Infinite if the obstacle turns.
  [[nodiscard]] double coming_closer(int point, const Vec3& normal, const Obstacle& obstacle);
  struct Woken {
    int point;
    double gap;     // m
    double coming;  // m, that it may come closer until woken again
  };
  [[nodiscard]] int nearest_node(int point) const;
  /// Returns whether a woken point need not be checked until it is woken again, since another one supports its node.
  [[nodiscard]] bool may_skip(const Woken& woken);

  SurfaceTree& tree_;
  std::size_t body_;
  double brick_;                     // m
  std::vector<double> spreads_;      // by brick of the skin: its points' largest sum of absolute weights; 1: all inside
  Pose pose_before_;                 // when last woken
  std::vector<double> ways_;         // by node of the tree: how far its cluster and the obstacle have come closer, m
  std::vector<double> brick_wakes_;  // by brick of the skin: the approach at which it must be checked
  std::vector<double> point_wakes_;  // by point, likewise
  std::vector<Vec3> impulses_;       // by point, N s
  std::vector<Woken> woken_;
  std::vector<long> loaded_;  // by node of the body: when last a point there carried a load
  long look_ = 0;
  std::vector<int> awake_;  // points
  bool is_new_ = true;
};

}  // namespace sprung
