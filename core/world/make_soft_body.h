#pragma once
#include "core/bricks/brick_grid.h"
#include "core/mesh/repair/solids.h"
#include "core/skin/skin.h"
#include "core/world/world.h"

namespace sprung {

/// `grid`: the bricks of one solid of the mesh (m). The body is at rest in the pose of its grid; its contact points
/// are those of its skin, as fine as its bricks can follow; none without `can_touch`. Deterministic.
[[nodiscard]] SoftBody make_soft_body(const SurfaceMesh& mesh, const Solid& solid, BrickGrid grid, Model model,
                                      const Material& material, bool can_touch = true);

/// A skin at rest, in the frame of the bricks, and where its vertices are in them.
struct EmbeddedSkin {
  Skin skin;
  Embedding embedding;
};

/// The body's skin for drawing: where its mesh is coarse, edges become curves, to within `tolerance` (m).
/// Deterministic.
[[nodiscard]] EmbeddedSkin smooth_skin(const SoftBody& body, double tolerance);

}  // namespace sprung
