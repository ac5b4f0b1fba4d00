#pragma once
#include "core/contact/contact_sweep.h"
#include "core/contact/pairs/crossing_guard.h"
#include "core/contact/step_report.h"

namespace sprung {

/// The contacts of a group's bodies: nearby features are found (NearFeatures), kept apart by a few sweeps of impulses
/// (ContactSweep), and guaranteed not to cross (CrossingGuard).
class SweptContacts {
 public:
  /// The bodies must outlive it. `glue` by rows of the group.
  SweptContacts(const Group& group, const World& world, std::vector<GluedPoint> glue)
      : group_(group), near_(group, world, glue), sweep_(group, std::move(glue)), guard_(near_) {}
  /// For the same bodies, reusing the surfaces of `before`.
  SweptContacts(SweptContacts&& before, const World& world, std::vector<GluedPoint> glue)
      : group_(before.group_),
        near_(group_, world, glue, std::move(before.near_).take_surfaces()),
        sweep_(group_, std::move(glue)),
        guard_(near_) {}

  /// Returns whether it was made for these bodies and obstacles, as they are.
  [[nodiscard]] bool is_of(const Group& group, const World& world) const {
    return group == group_ && near_.is_of_surfaces(world);
  }

  /// Changes the bodies' velocities so that a step of dt satisfies every constraint. `inverse_masses` by body of the
  /// group and node, 1/kg, 0 for pinned nodes; `elapsed`: since the obstacles had the world's poses, s.
  void apply(const World& world, const std::vector<Eigen::VectorXd>& inverse_masses, double elapsed, double dt) {
    Stopwatch watch;
    near_.begin_step(world, elapsed, dt);
    report_.search += watch.lap();
    report_.contacts += sweep_.apply(near_, inverse_masses, world.gravity.norm(), dt);
    report_.sweeps += watch.lap();
    guard_.apply(world, inverse_masses, dt);
    report_.guarding += watch.lap();
    near_.end_step(dt);
  }

  /// See InversionGuard; of all bodies.
  [[nodiscard]] FlattestVolume flattest() const { return sweep_.flattest(); }

  void count_springs(double seconds) { report_.springs += seconds; }
  [[nodiscard]] StepReport report() const {
    StepReport report = report_;
    report.guard = guard_.counts();
    return report;
  }

 private:
  Group group_;
  NearFeatures near_;
  ContactSweep sweep_;
  CrossingGuard guard_;
  StepReport report_;
};

}  // namespace sprung
