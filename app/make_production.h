#pragma once
#include "app/build_world.h"
#include "core/bricks/thin_parts.h"

namespace sprung {

/// A scene ready to move, and what was found on the way.
struct Preparation {
  std::vector<LoadedBody> bodies;
  Production production;
  std::vector<std::vector<ThinPart>> thin_parts;  // by actor, in the frame of its grid
};

/// Reads the bodies of a scene and fills them with bricks; says what came out, and warns of what will not come out
/// well: what was repaired, what the bricks are too coarse for. Throws Error(kBadInput).
[[nodiscard]] Preparation prepare(const Scene& scene, const Console& console);

/// The production alone.
[[nodiscard]] Production make_production(const Scene& scene, const Console& console);

}  // namespace sprung
