#pragma once
#include "core/simulation/origin.h"
#include "core/simulation/selector.h"
#include "core/world/keyframes.h"
#include "core/world/world.h"

namespace sprung {

/// The skin that pins on the surface hold of one of a body's solids, which is still at the position of its grid; pins
/// that hold none of it are left out. Throws Error(kBadInput) if a part does not exist.
[[nodiscard]] std::vector<PinnedSkin> find_pinned_skins(const std::vector<Pin>& pins, const Selector& selector,
                                                        const SoftBody& body, std::size_t solid);

/// The springs that hold a pinned skin of a body at rest. A spring per area is kFoundation times as stiff as the
/// outermost layer of bricks under it, E / h: it adds the compliance of a hundredth of a brick to a support, and still
/// lets the solvers converge.
[[nodiscard]] std::vector<SpringSupport> springs_of(const PinnedSkin& skin, const Pin& pin, const Body& body);

/// Sets the foundations of a body whose pins have moved from rest to a `time` (s) of the film; with `small`, to first
/// order. Those of pins that do not hold from the start have no springs.
void set_foundations(const Scene& scene, const Origin& origin, double time, bool small, SoftBody& body);

inline constexpr double kFoundation = 100;

/// The reaction and displacement of a pinned skin.
struct SkinReaction {
  double area = 0;                   // m^2
  Vec3 position = Vec3::Zero();      // its first moment, m^3
  Vec3 displacement = Vec3::Zero();  // likewise, m^3
  Vec3 force = Vec3::Zero();         // N, of the support on the body
  Vec3 torque = Vec3::Zero();        // N m, about the centre of the pin
};

/// For the body's current positions. `springs`: that hold it now; `centre`: of the pin, m. `small`: torques refer to
/// the rest shape.
[[nodiscard]] SkinReaction reaction_of(const PinnedSkin& skin, const std::vector<SpringSupport>& springs,
                                       const Vec3& centre, const Body& body, bool small);

}  // namespace sprung
