#pragma once
#include <vector>

#include "core/contact/inversion_guard.h"
#include "core/contact/pairs/near_features.h"

namespace sprung {

/// Keeps what may meet at a distance, what is glued together, and bricks from being pressed flat or inside out, by
/// impulses on the nodes: one Gauss-Seidel sweep a step over all contacts, from the impulses of the step before. Each
/// contact asks for a speed along its normal at which its two features may approach each other, or with which they
/// leave each other; an impulse that brings them to that speed, or to rest sideways within Coulomb's cone, is a
/// projection that gives no energy where that speed is not above zero, in any order and after any number of sweeps.
/// What a sweep leaves over the next step finds. Deterministic.
class ContactSweep {
 public:
  /// `glue` by rows of the group, of which `near` finds what may meet.
  ContactSweep(Group group, std::vector<GluedPoint> glue);

  /// Changes the bodies' velocities, after NearFeatures::begin_step(). `inverse_masses` by body of the group and node,
  /// 1/kg, 0 for nodes that are held; `gravity` in m/s^2, its size.
  void apply(NearFeatures& near, const std::vector<Eigen::VectorXd>& inverse_masses, double gravity, double dt);

 private:
  /// A node's part in a contact.
  struct Part {
    double* velocity;     // of three, m/s
    double weight;        // in the velocity of one feature's place relative to the other's
    double inverse_mass;  // 1/kg
  };
  struct Row {
    std::size_t first;    // of its parts
    std::size_t last;     // one past them
    Vec3 normal;          // unit
    Vec3 carried;         // m/s, in that relative velocity, by what nothing pushes
    double least_speed;   // m/s, along the normal
    double friction;      // Coulomb's coefficient
    double inverse_mass;  // 1/kg, of the place
    Vec3* impulse;        // N s
    bool is_glue = false;
  };

  void stop_inversions(const std::vector<Eigen::VectorXd>& inverse_masses, double dt);
  /// Those that bear a load since the step before, or those that have to begin to.
  void add_contacts(NearFeatures& near, const std::vector<Eigen::VectorXd>& inverse_masses, double gravity, double dt,
                    bool are_loaded);
  /// Whether a contact with the same other body bears a load at the node nearest to this one's point; where that is not
  /// asked, this one does from now on.
  [[nodiscard]] bool is_held_at_node(NearFeatures& near, const AwakePair& pair, bool is_asked);
  void add_glue_rows(const std::vector<Eigen::VectorXd>& inverse_masses, double dt);
  /// Adds a node's part to the row that is being made.
  void add_part(std::size_t body, int node, double weight, double inverse_mass, Row& row);
  /// Keeps it where it can be moved.
  void finish_row(Row row);
  [[nodiscard]] Vec3 velocity_of(const Row& row) const;
  void push(const Row& row, const Vec3& impulse);
  /// Takes over a share of the step before's impulses that gives no energy.
  void warm_start(double scale);
  void sweep();

  Group group_;
  std::vector<GluedPoint> glue_;
  std::vector<Vec3> glue_impulses_;  // N s
  std::vector<InversionGuard> inversions_;
  std::vector<std::vector<int>> parts_of_nodes_;   // by body and node: its part in the row that is being made, or -1
  std::vector<std::pair<std::size_t, int>> seen_;  // body and node of those parts
  std::vector<Part> parts_;
  std::vector<Row> rows_;
  struct Holder {
    long step = -1;
    std::size_t other = 0;  // body
  };
  std::vector<std::vector<Holder>> holders_;  // by body and node: what it was held from last
  long step_ = 0;
  double dt_before_ = 0;  // s
};

}  // namespace sprung
