#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/contact/contact_states.h"
#include "core/dynamics/explicit/integrator.h"
#include "core/dynamics/integrator_state.h"
#include "core/error.h"

namespace sprung {

/// The groups of bodies that may come into contact within `time` (s), and for each the longest steps that are stable
/// and in which nothing can run through what it meets: at the speed it has, with what gravity can add in that time, no
/// node moves further than a quarter of the group's smallest brick in a step. Throws Diverged if that would be more
/// steps than can be done.
[[nodiscard]] std::vector<GroupSteps> choose_steps(const World& world, double time);

/// Moves a world frame by frame. A number that is not finite, or a spurious gain of energy, is found in the frame in
/// which it appears; that frame is then undone and retried with half the step, up to a few times.
class AdaptiveIntegrator {
 public:
  /// Called every now and then with the share of the frame that is done; may throw.
  using Between = std::function<void(double share)>;
  /// Hears why a frame is taken back.
  using Tell = std::function<void(const std::string& message)>;

  AdaptiveIntegrator(World& world, Scheme scheme, ContactSearch search = ContactSearch::kInTime)
      : world_(world), scheme_(scheme), search_(search) {}

  /// From `time` on by `duration` (s); obstacles move evenly. Returns the steps each group took. Deterministic for any
  /// number of threads. Throws Diverged naming time, body, the brick's place and what to change where no step is short
  /// enough.
  std::vector<GroupSteps> advance_frame(double time, double duration, const Between& between, const Tell& tell);

  /// What the next frame depends on beside positions and velocities.
  void serialize(IntegratorState& state) { state.serialize_as_double(halvings_); }

 private:
  void begin_contacts(std::span<const GroupSteps> groups);
  /// None where it came through with finite positions.
  std::optional<Diverged> run(std::span<const GroupSteps> groups, double time, const Between& between);

  World& world_;
  Scheme scheme_;
  ContactSearch search_;
  ContactStates contacts_;
  int halvings_ = 0;  // kept from frame to frame
};

}  // namespace sprung
