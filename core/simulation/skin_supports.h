#pragma once
#include "core/dynamics/linear/linear_solver.h"
#include "core/simulation/origin.h"
#include "core/simulation/selector.h"
#include "core/world/keyframes.h"
#include "core/world/world.h"

namespace sprung {

/// The skin that pins on the surface hold of one of a body's solids, which is still at the position of its grid; pins
/// that hold none of it are left out. Throws Error(kBadInput) if a part does not exist.
[[nodiscard]] std::vector<PinnedSkin> find_pinned_skins(const std::vector<Pin>& pins, const Selector& selector,
                                                        const SoftBody& body, std::size_t solid);

/// Adds the springs that hold pinned skins of a body, moved by their pins from rest to a `time` (s) of the film; with
/// `small`, to first order. A spring per area is kFoundation times as stiff as the outermost layer of bricks under it,
/// E / h: it adds the compliance of a hundredth of a brick to a support, and still lets the solvers converge.
void add_skin_supports(const Scene& scene, const Origin& origin, const Body& body, double time, bool small,
                       Supports& supports);

inline constexpr double kFoundation = 100;

/// The reaction and displacement of a pinned skin.
struct SkinReaction {
  double area = 0;                   // m^2
  Vec3 position = Vec3::Zero();      // its first moment, m^3
  Vec3 displacement = Vec3::Zero();  // likewise, m^3
  Vec3 force = Vec3::Zero();         // N, of the support on the body
  Vec3 torque = Vec3::Zero();        // N m, about the centre of the pin
};

/// For the body's current positions. `small`: torques refer to the rest shape.
[[nodiscard]] SkinReaction reaction_of(const PinnedSkin& skin, const Pin& pin, const Scene& scene, const Body& body,
                                       double time, bool small);

}  // namespace sprung
