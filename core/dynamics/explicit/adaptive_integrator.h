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

/// The contact groups within `time` (s), and for each the longest steps that are stable and in which nothing can pass
/// through an obstacle or body: at its speed plus what gravity can add in that time, no node moves further than a
/// quarter of the group's smallest brick in a step. Throws Diverged if that would take too many steps.
[[nodiscard]] std::vector<GroupSteps> choose_steps(const World& world, double time);

/// The steps of all groups, each times the bricks that take it.
[[nodiscard]] double brick_steps_of(const World& world, std::span<const GroupSteps> groups);

/// Advances a world frame by frame and checks each one: a number that is not finite, or a spurious gain of energy, is
/// detected in the frame it appears in. The frame is then undone and repeated in steps half as long, up to a few times.
class AdaptiveIntegrator {
 public:
  /// Called from time to time with the completed share of the frame; may throw.
  using Between = std::function<void(double share)>;
  /// Receives the reason why a frame is undone.
  using Tell = std::function<void(const std::string& message)>;

  AdaptiveIntegrator(World& world, Scheme scheme) : world_(world), scheme_(scheme) {}

  /// From `time` on by `duration` (s); obstacles move uniformly. Returns the steps each group took. Deterministic for
  /// any number of threads. Throws Diverged naming time, body, the brick's position and what to change if no step is
  /// short enough.
  std::vector<GroupSteps> advance_frame(double time, double duration, const Between& between, const Tell& tell);

  /// Covers the steps of the last frame.
  [[nodiscard]] StepReport report() const { return contacts_.report(); }

  /// The state besides positions and velocities that the next frame depends on.
  void serialize(IntegratorState& state) { state.serialize_as_double(halvings_); }

 private:
  void begin_contacts(std::span<const GroupSteps> groups);
  /// None if it finished with finite positions. Returns in `groups` the steps that were taken.
  std::optional<Diverged> run(std::span<GroupSteps> groups, double time, const Between& between);

  World& world_;
  Scheme scheme_;
  ContactStates contacts_;
  int halvings_ = 0;  // kept from frame to frame
};

}  // namespace sprung
