#pragma once
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/contact/pairs/guard_counts.h"
#include "core/contact/pairs/near_features.h"

namespace sprung {

/// Prevents contact surfaces of a group's bodies from passing through each other, themselves, or an obstacle: points
/// through triangles, and edges through edges; and what is drawn of the bodies from entering obstacles without edges.
/// The normal between the nearest points of two such features separates them, and still does after a step of dt if
///
///   dt (least speed of the first's corners along it - greatest of the second's) > -0.8 gap,
///
/// or if the plane between them, turning as their nearest points do in the step, separates them throughout. If neither
/// holds, an impulse acts between the nearest points or, if that is not enough, on the corners that violate it; the
/// first conserves momentum and angular momentum, the other momentum. If these do not converge, nodes are slowed down
/// one by one, and finally all nodes of features that still meet move as one, with their momentum, or with the pinned
/// nodes among them. Sliding stays free. Explicit steps only; what has crossed at the start, and the features about it,
/// are ignored until they have separated. It fails only where parts meet that pins or obstacles move on both sides.
/// Deterministic.
class CrossingGuard {
 public:
  /// `near` must outlive it.
  explicit CrossingGuard(NearFeatures& near) : near_(near) {}

  /// Changes velocities so that nothing crosses in a step of dt; call after NearFeatures::begin_step() and all other
  /// changes of velocities. `inverse_masses` by body of the group and node, 1/kg, 0 for pinned nodes.
  void apply(const World& world, const std::vector<Eigen::VectorXd>& inverse_masses, double dt);
  /// How often it acted, in all calls of apply().
  [[nodiscard]] const GuardCounts& counts() const { return counts_; }

 private:
  /// 1/kg; 0 for pinned nodes.
  [[nodiscard]] double inverse_mass(std::size_t row, int node) const {
    return row < near_.group_size() ? (*inverse_masses_)[row][node] : 0;
  }
  /// Returns whether no impulse can move it.
  [[nodiscard]] bool is_pinned(const AwakePair& pair, int corner) const;
  [[nodiscard]] bool can_be_moved(const AwakePair& pair) const;
  enum class Outcome { kUnchanged, kChanged, kFailed };
  /// Returns whether velocities were changed and the pairs must be checked again. `rounds`: raised to the number it
  /// took.
  [[nodiscard]] Outcome keep_apart(double dt, int& rounds);
  void count(int rounds, bool has_failed);
  [[nodiscard]] bool may_meet(const AwakePair& pair, const Eigen::Vector4d& speeds, double dt) const;
  /// Returns whether a plane that turns with the nearest points separates the features throughout a step of dt.
  [[nodiscard]] bool stay_apart_turning(const AwakePair& pair, double dt) const;
  /// Lists the pairs that may meet, in addition to earlier ones; false: there are none now.
  bool find_met(double dt);
  /// Applies an impulse between points of the two features, given by the corners' weights, so that they separate as
  /// required.
  void push(const AwakePair& pair, const Eigen::Vector4d& speeds, const Eigen::Vector4d& weights, double dt);
  void slow_nodes(const AwakePair& pair, const Eigen::Vector4d& speeds, double dt);
  /// Nodes that move as one.
  struct Weld {
    std::vector<std::pair<std::size_t, int>> nodes{};  // body and node
    Vec3 momentum = Vec3::Zero();
    double mass = 0;
    std::optional<Vec3> pinned_velocity{};  // m/s, of the pinned nodes among them
  };
  [[nodiscard]] std::size_t weld_of(std::size_t row, int node);
  void weld(const AwakePair& pair);

  NearFeatures& near_;
  GuardCounts counts_;
  const std::vector<Eigen::VectorXd>* inverse_masses_ = nullptr;  // in a step
  bool do_pins_meet_ = false;                                     // in this step: none of their points can be moved
  std::vector<std::size_t> met_;                                  // rows of awake pairs that were to meet in this step
  std::vector<char> is_met_;                                      // by such a row
  std::vector<Weld> welds_;
  std::map<std::pair<std::size_t, int>, std::size_t> weld_of_;  // of the nodes that are in any
};

}  // namespace sprung
