#include "core/motion/point_hardness.h"

#include <algorithm>

namespace sprung {
namespace {

constexpr double kHardness = 20;        // times E h of the brick
constexpr double kPointsInContact = 4;  // of a brick, that share its hardness: more are softer each

/// Pa, of a brick in its region; what is cut by the surface is as hard as a full one.
double young_at(const Body& body, int brick) {
  return body.material.young * std::max(1.0, body.stiffness_scale[static_cast<std::size_t>(brick)]);
}

}  // namespace

std::vector<double> point_hardness(const Actor& actor, const ContactSkin& skin) {
  const Body& body = actor.body;
  std::vector<double> hardness(skin.points.size());
  for (std::size_t i = 0; i < skin.bricks.size(); ++i) {
    const double count = skin.first_point[i + 1] - skin.first_point[i];
    const double whole = kHardness * young_at(body, skin.bricks[i]) * body.grid.brick_size;
    for (int p = skin.first_point[i]; p < skin.first_point[i + 1]; ++p) {
      hardness[static_cast<std::size_t>(p)] = whole / std::max(1.0, count / kPointsInContact);
    }
  }
  return hardness;
}

double pair_hardness(double hardness, const Body& body, int brick, const Body& other, int other_brick) {
  return hardness * std::min(1.0, young_at(other, other_brick) / young_at(body, brick));
}

double glue_hardness(const Body& body, int brick, const Body& other, int other_brick) {
  const double whole = kHardness * young_at(body, brick) * body.grid.brick_size;
  return pair_hardness(whole, body, brick, other, other_brick);
}

}  // namespace sprung
