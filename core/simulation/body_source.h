#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/mesh/query/thickness.h"
#include "core/mesh/repair/solids.h"
#include "core/simulation/observer.h"
#include "core/simulation/scene.h"

namespace sprung {

/// A body of the scene at rest: in metres, the centre of its bounding box at the origin, rotated so that its bricks are
/// axis-aligned.
struct LoadedBody {
  std::string name;  // of the file, for messages
  SurfaceMesh mesh;
  std::vector<Solid> solids;
  std::vector<Repair> repairs;
  Mat3 bricks_from_rest = Mat3::Identity();                     // of that rotation
  Vec3 extent = Vec3::Zero();                                   // m, sides of the bounding box before that
  double brick_size = 0;                                        // m
  std::vector<std::vector<WallSample>> walls;                   // of a mesh, by solid
  Eigen::Affine3d file_from_rest{Eigen::Affine3d::Identity()};  // before the rotation; in the units of the file
  std::optional<BrickGrid> grid;                                // of a box; none for a mesh, which is yet to be filled

  /// The thickness below which 1 % of the surface of a mesh is, m; 0: unknown.
  [[nodiscard]] double thinnest_wall() const { return thickness_quantile(walls, 0.01); }
};

/// Makes the box, or reads and scales the mesh, and finds its solids; reports what was repaired. The walls are not yet
/// measured, and the volumes of solids that overlap themselves count overlaps twice. Throws Error(kBadInput).
[[nodiscard]] LoadedBody load_solids(const SceneBody& body, const Observer& observer);

/// load_solids(), with the volumes enclosed, the walls, and the brick size chosen where it is "auto". Throws
/// Error(kBadInput).
[[nodiscard]] LoadedBody load_body(const SceneBody& body, const Observer& observer);

}  // namespace sprung
