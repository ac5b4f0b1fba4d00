#pragma once
#include <memory>
#include <vector>

#include "core/contact/pairs/feature_pairs.h"
#include "core/contact/search/group.h"

namespace sprung {

/// Lets no contact surface of a group's bodies pass through another one, itself, or an obstacle with edges (box,
/// cylinder, mesh): points through triangles or edges through edges. The normal between the nearest places of two such
/// features separates them, and stays between them while moving by dt as long as
///
///   dt (least speed of the first's corners along it - greatest of the second's) > -0.8 gap.
///
/// Where that is not so, an impulse acts between the nearest places, or, where that is not enough, the corners that
/// break it; the first keeps momentum and angular momentum, the other momentum. Where these do not come to an end,
/// nodes are slowed down one by one, and at last the nodes of the two move as one. Sliding stays free. Explicit steps
/// only; what has crossed at the start is left alone until it is apart. Where none of that helps, since what is held on
/// two sides meets, it lets go. Deterministic.
class CrossingGuard {
 public:
  /// The bodies have to outlive it.
  CrossingGuard(const Group& group, const World& world);

  /// Changes velocities so that nothing is crossed when all move by dt. `inverse_masses` by body of the group and node,
  /// 1/kg, 0 for nodes that are held; `elapsed`: since the obstacles were where the world has them, s.
  void apply(const World& world, const std::vector<Eigen::VectorXd>& inverse_masses, double elapsed, double dt);

 private:
  [[nodiscard]] SoftBody& body(std::size_t row) const;
  [[nodiscard]] const ContactPoint& point(const AwakePair& pair, int corner) const;
  /// 1/kg; 0 for what is held.
  [[nodiscard]] double inverse_mass(std::size_t row, int node) const {
    return row < group_.size() ? (*inverse_masses_)[row][node] : 0;
  }
  /// Whether nothing can push it.
  [[nodiscard]] bool is_held(const AwakePair& pair, int corner) const;
  /// Calls visit(body, node, weight) for all nodes that carry a corner.
  template <class Visit>
  void each_node(const AwakePair& pair, int corner, const Visit& visit) const;
  /// Whether the next step of dt takes no node further than the trees were told when they were last followed.
  [[nodiscard]] bool is_foreseen(double dt) const;
  /// `slack`: bricks that they may be away from there.
  void look_ahead(double dt, double slack);
  /// The speeds of a pair's corners along its normal, m/s; known: as they were when the pair was measured.
  [[nodiscard]] Eigen::Vector4d speeds(const AwakePair& pair, bool are_known) const;
  /// Whether velocities were changed and what they lead to has to be looked at; not where it lets go.
  bool keep_apart(double dt);
  /// By an impulse between places of the two features, given by the corners' weights, so that these get away from each
  /// other as they must.
  void push(const AwakePair& pair, const Eigen::Vector4d& speeds, const Eigen::Vector4d& weights, double dt);
  void slow_nodes(const AwakePair& pair, const Eigen::Vector4d& speeds, double dt);
  void unite(const AwakePair& pair);

  Group group_;
  std::vector<std::unique_ptr<SoftBody>> obstacles_;              // their surfaces
  std::vector<std::size_t> obstacle_rows_;                        // in the world
  double brick_;                                                  // m, the smallest
  const std::vector<Eigen::VectorXd>* inverse_masses_ = nullptr;  // in a step
  std::vector<std::unique_ptr<SurfaceTree>> trees_;               // of the bodies, then of the obstacles
  std::vector<std::unique_ptr<FeaturePairs>> pairs_;
  std::vector<AwakePair> awake_;
  /// When last looked ahead: how far, and the nodes then.
  struct Seen {
    Points positions;
    Points velocities;
  };
  std::vector<Seen> seen_;  // by tree
  double horizon_ = 0;      // s
  double slack_ = 0;        // bricks
  double since_look_ = 0;   // s
};

}  // namespace sprung
