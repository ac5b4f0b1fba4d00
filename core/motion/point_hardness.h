#pragma once
#include <vector>

#include "core/world/contact_skin.h"

namespace sprung {

/// What pushes back a contact point of a body that is inside something, in steps that have contact as an energy, N/m
/// by point: twenty times the stiffness E h of its brick, shared among the points of the brick.
[[nodiscard]] std::vector<double> point_hardness(const Actor& actor, const ContactSkin& skin);

/// The same of two bodies that touch: by the softer of the bricks.
[[nodiscard]] double pair_hardness(double hardness, const Body& body, int brick, const Body& other, int other_brick);

/// N/m, of a point that is glued to another body at those bricks.
[[nodiscard]] double glue_hardness(const Body& body, int brick, const Body& other, int other_brick);

}  // namespace sprung
