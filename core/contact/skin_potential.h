#pragma once
#include <list>
#include <vector>

#include "core/contact/narrow_phase.h"
#include "core/contact/obstacle_potential.h"
#include "core/world/point_stiffness.h"
#include "core/world/world.h"

namespace sprung {

/// Contact of the bodies of a group with each other and themselves, and their glue, as an energy, for steps that
/// minimise a potential. The law is ObstaclePotential's: a point of a skin that is inside another is pushed back by k
/// times its depth below the nearest triangle, k that of the softer one; friction is Coulomb's with the normal force of
/// the previous iteration. Glued points attract each other by k times their distance. The triangle of each point and
/// its normal are updated before each of Newton's directions; in between the surfaces are flat. A point found inside
/// without having been pushed in, such as where edges have crossed between their points, feels no force from that depth
/// but is lifted by min_speed(): contact adds no energy. Forces sum to zero: momentum is conserved.
class SkinPotential {
 public:
  /// The parameters of a step.
  struct Step {
    double dt;    // s
    double slip;  // m, that a point may creep before it slides
  };
  /// For a step from the bodies' current positions, in which nothing near another surface moves by more than half a
  /// brick. `glue` by rows of the group; `penetrations` by body and point of its skin, from remember(). All must
  /// outlive it.
  SkinPotential(const World& world, const Group& group, const std::vector<GluedPoint>& glue, const Step& step,
                const std::vector<Eigen::VectorXd*>& penetrations);
  SkinPotential(const SkinPotential&) = delete;
  SkinPotential& operator=(const SkinPotential&) = delete;

  /// Returns whether there are any possible contacts or glue.
  [[nodiscard]] bool any() const { return !glue_.empty() || !watches_.empty(); }

  /// Updates triangles and normals to the bodies' current positions.
  void refresh();
  /// Updates normal forces, for friction, likewise. Returns the largest change of one, N, if there is friction.
  double update_friction();
  [[nodiscard]] double largest_normal_force() const;

  /// J; adds forces (m x 3, N), by body of the group.
  double add_forces(const std::vector<Points*>& forces) const;
  [[nodiscard]] std::vector<Coupling> couplings() const;

  /// Stores how far points have been pushed into what they touch, m, for the coming step.
  void remember(const std::vector<Eigen::VectorXd*>& penetrations) const;

 private:
  /// A point that may touch triangles of a body.
  struct Watch {
    const ContactCandidates* pairs;
    SkinRun run;
    double depth;                         // m, below which what is inside came from the other side
    double stiffness;                     // N/m, of the point by itself
    double friction;                      // Coulomb's coefficient
    double penetrations;                  // m, at the last update
    double initial_penetration = 0;       // m, of the depth
    const CandidatePair* pair = nullptr;  // the nearest one then
    double normal_force = 0;              // N, for friction
  };
  /// An active coupling.
  struct ActiveContact {
    std::size_t watch;  // in watches_; unused for glue
    bool is_glue;
    Coupling coupling;  // without its stiffness
    double stiffness;
    Vec3 normal;
    Vec3 start;  // m, when the step began
  };

  void watch(const World& world, const std::vector<Eigen::VectorXd*>& penetrations);
  void lift(double gravity, double dt);
  [[nodiscard]] double depth(const ActiveContact& active, const Vec3& now) const;
  void add_glue();
  void add_contact(std::size_t watch, const PointTriangleContact& stance);
  [[nodiscard]] Vec3 sum(const Coupling& coupling, bool at_start) const;
  [[nodiscard]] FrictionPotential friction_at(const ActiveContact& active, const Vec3& now) const;

  const Group& group_;
  const std::vector<GluedPoint>& glue_;
  double slip_;
  std::vector<const ContactSurface*> skins_;  // by body
  std::vector<Points> starts_;                // by body, m x 3, m
  std::list<ContactCandidates> pairs_;
  std::vector<Watch> watches_;
  std::vector<ActiveContact> contacts_;
};

}  // namespace sprung
