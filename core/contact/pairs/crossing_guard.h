#pragma once
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/contact/pairs/near_features.h"

namespace sprung {

/// Lets no contact surface of a group's bodies pass through another one, itself, or an obstacle: points through
/// triangles or into obstacles without edges, and edges through edges. The normal between the nearest places of two
/// such features separates them, and stays between them while moving by dt as long as
///
///   dt (least speed of the first's corners along it - greatest of the second's) > -0.8 gap.
///
/// Where that is not so, an impulse acts between the nearest places, or, where that is not enough, the corners that
/// break it; the first keeps momentum and angular momentum, the other momentum. Where these do not come to an end,
/// nodes are slowed down one by one, and at last all nodes of what still meets move as one, with their momentum, or
/// with what is held among them. Sliding stays free. Explicit steps only; what has crossed at the start is left alone
/// until it is apart. It lets go only where what is held on two sides meets. Deterministic.
class CrossingGuard {
 public:
  /// What may meet must outlive it.
  explicit CrossingGuard(NearFeatures& near) : near_(near) {}

  /// Changes velocities so that nothing is crossed when all move by dt, after NearFeatures::begin_step()
  /// and whatever has changed them since. `inverse_masses` by body of the group and node, 1/kg, 0 for nodes that are
  /// held.
  void apply(const World& world, const std::vector<Eigen::VectorXd>& inverse_masses, double dt);

 private:
  /// 1/kg; 0 for what is held.
  [[nodiscard]] double inverse_mass(std::size_t row, int node) const {
    return row < near_.group_size() ? (*inverse_masses_)[row][node] : 0;
  }
  /// Whether nothing can push it.
  [[nodiscard]] bool is_pinned(const AwakePair& pair, int corner) const;
  /// Whether velocities were changed and what they lead to has to be looked at; not where it lets go.
  bool keep_apart(double dt);
  [[nodiscard]] bool may_meet(const AwakePair& pair, const Eigen::Vector4d& speeds, double dt) const;
  /// Lists the pairs that may meet, beside those that did before; false: there are none now.
  bool find_met(double dt);
  /// By an impulse between places of the two features, given by the corners' weights, so that these get away from each
  /// other as they must.
  void push(const AwakePair& pair, const Eigen::Vector4d& speeds, const Eigen::Vector4d& weights, double dt);
  void slow_nodes(const AwakePair& pair, const Eigen::Vector4d& speeds, double dt);
  /// Nodes that move as one.
  struct Weld {
    std::vector<std::pair<std::size_t, int>> nodes{};  // body and node
    Vec3 momentum = Vec3::Zero();
    double mass = 0;
    std::optional<Vec3> pinned_velocity{};  // m/s, of what is held among them
  };
  [[nodiscard]] std::size_t weld_of(std::size_t row, int node);
  void weld(const AwakePair& pair);

  NearFeatures& near_;
  const std::vector<Eigen::VectorXd>* inverse_masses_ = nullptr;  // in a step
  std::vector<std::size_t> met_;                                  // rows of awake pairs that were to meet in this step
  std::vector<char> is_met_;                                      // by such a row
  std::vector<Weld> welds_;
  std::map<std::pair<std::size_t, int>, std::size_t> weld_of_;  // of the nodes that are in any
};

}  // namespace sprung
