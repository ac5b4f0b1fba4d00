#pragma once
#include <span>
#include <vector>

#include "core/contact/contacts.h"
#include "core/world/world.h"

namespace sprung {

/// Places where the skin of one body lies within `distance` (m) of another's, one at each corner of the bricks of the
/// one with the smaller bricks; both as their bodies start, not yet bent. Deterministic.
[[nodiscard]] std::vector<GluedPoint> glue_between(const World& world, std::size_t a, std::size_t b, double distance);

/// What is glued and has come apart by rounding is together again after about that many steps.
inline constexpr double kRejoinSteps = 4;

/// What is glued among these bodies, by their rows in the list.
[[nodiscard]] std::vector<GluedPoint> glue_within(const World& world, std::span<const std::size_t> bodies);

/// Appends what each glued point of a group needs to stay together in the step to come, ordered by key.
void add_glue(const std::vector<GluedPoint>& glue, const Group& group, double dt, ContactList& contacts);

}  // namespace sprung
