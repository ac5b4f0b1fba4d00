#pragma once
#include <vector>

#include "core/contact/inversion_guard.h"
#include "core/contact/pairs/near_features.h"

namespace sprung {

/// Keeps nearby features at a distance, glued points together, and bricks from being flattened or inverted, by impulses
/// on the nodes: a few Gauss-Seidel sweeps per step over all contacts, warm-started with the impulses of the previous
/// step. Each contact prescribes the speed along its normal at which its two features may approach or must separate; an
/// impulse that brings them to that speed, or to rest tangentially within Coulomb's cone, is a projection that adds no
/// energy unless that speed is above zero, in any order and after any number of sweeps. Errors left by a sweep are
/// corrected in the next step. Deterministic.
class ContactSweep {
 public:
  /// `glue` by rows of the group, which is also that of `near`.
  ContactSweep(Group group, std::vector<GluedPoint> glue);

  /// Changes the bodies' velocities, after NearFeatures::begin_step(). `inverse_masses` by body of the group and node,
  /// 1/kg, 0 for pinned nodes; `gravity` in m/s^2, its magnitude. Returns the number of contacts that carry a load.
  int apply(NearFeatures& near, const std::vector<Eigen::VectorXd>& inverse_masses, double gravity, double dt);

  /// See InversionGuard; of all bodies.
  [[nodiscard]] FlattestVolume flattest() const;

 private:
  /// A node's contribution to a contact.
  struct Part {
    double* velocity;     // of three, m/s
    double weight;        // in the relative velocity of the two features' points
    double inverse_mass;  // 1/kg
  };
  struct Row {
    std::size_t first;    // of its parts
    std::size_t last;     // one past them
    Vec3 normal;          // unit
    Vec3 carried;         // m/s, in that relative velocity, of what no impulse can move
    double min_speed;     // m/s, along the normal
    double friction;      // Coulomb's coefficient
    double inverse_mass;  // 1/kg, at the contact point
    Vec3* impulse;        // N s
    bool is_glue = false;
  };

  void stop_inversions(const std::vector<Eigen::VectorXd>& inverse_masses, double dt);
  /// Adds the contacts that carried a load in the previous step, or those that must start to.
  void add_contacts(NearFeatures& near, const std::vector<Eigen::VectorXd>& inverse_masses, double gravity, double dt,
                    bool are_loaded);
  /// Lets the row act at one point of space, the second feature's: friction across the gap would turn the two bodies.
  void move_together(NearFeatures& near, const AwakePair& pair, const std::vector<Eigen::VectorXd>& inverse_masses,
                     Row& row);
  /// Returns whether a contact with the same other body carries a load at the node nearest to this one's point; if not
  /// `is_asked`, this one does from now on.
  [[nodiscard]] bool is_supported_at_node(NearFeatures& near, const AwakePair& pair, bool is_asked);
  void add_glue_rows(const std::vector<Eigen::VectorXd>& inverse_masses, double dt);
  /// Adds a node's contribution to the row under construction.
  void add_part(std::size_t body, int node, double weight, double inverse_mass, Row& row);
  /// Keeps the row if it can be moved.
  void finish_row(Row row);
  [[nodiscard]] Vec3 velocity_of(const Row& row) const;
  void push(const Row& row, const Vec3& impulse);
  /// Reuses a fraction of the previous step's impulses that adds no energy.
  void warm_start(double scale);
  void sweep();

  Group group_;
  std::vector<GluedPoint> glue_;
  std::vector<Vec3> glue_impulses_;  // N s
  std::vector<InversionGuard> inversions_;
  std::vector<std::vector<int>> parts_of_nodes_;   // by body and node: its part in the row under construction, or -1
  std::vector<std::pair<std::size_t, int>> seen_;  // body and node of those parts
  std::vector<Part> parts_;
  std::vector<Row> rows_;
  struct NodeSupport {
    long step = -1;
    std::size_t other = 0;  // body
  };
  std::vector<std::vector<NodeSupport>> supports_;  // by body and node: its last contact
  long step_ = 0;
  double dt_before_ = 0;  // s
};

}  // namespace sprung
