#pragma once
#include <string>
#include <vector>

#include "core/mesh/repair/solids.h"
#include "core/skin/skin.h"
#include "core/world/world.h"

namespace sprung {

/// A solid filled with bricks, ready to move, and what is drawn of it.
struct SoftBody {
  Actor actor;          // touches by its skin, as finely as its bricks can follow
  Skin skin;            // at rest, in the frame of the bricks
  Embedding embedding;  // of the skin's vertices in the bricks
};

/// `grid` are the bricks of one solid of the mesh (m). The body is at rest where its grid is. Deterministic.
[[nodiscard]] SoftBody make_soft_body(const SurfaceMesh& mesh, const Solid& solid, BrickGrid grid, Model model,
                                      const Material& material);

struct FillOptions {
  Material material;
  Model model = Model::kCalibrated;
  double size = 0.2;             // m, longest side of the bounding box
  int bricks = 24;               // along that
  Vec3 position = Vec3::Zero();  // m, where the middle of the bottom of the bounding box goes
  RepairMode repair = RepairMode::kAuto;
};

/// Every solid of a mesh (in units of its file) filled with bricks and put in its place; largest first. `name` of the
/// mesh for messages. Throws Error(kBadInput) where the mesh encloses nothing or the material or an option is out of
/// range. Deterministic.
[[nodiscard]] std::vector<SoftBody> fill_mesh(SurfaceMesh mesh, const std::string& name, const FillOptions& options);

/// The bounding box of a mesh, in its units. Vertices that no triangle uses count nothing.
struct MeshBox {
  Vec3 middle;
  Vec3 extent;
};

/// Moves a mesh so that the middle of its bounding box is at the origin, and says where that was. In double and before
/// anything else, so that a mesh far from its origin loses nothing later.
MeshBox recentre(SurfaceMesh& mesh);

}  // namespace sprung
