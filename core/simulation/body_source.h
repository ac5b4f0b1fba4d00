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

/// A body of the scene at rest: metres, the middle of its bounding box at the origin, turned so that its bricks are
/// straight.
struct LoadedBody {
  std::string name;  // of the file, for messages
  SurfaceMesh mesh;
  std::vector<Solid> solids;
  std::vector<Repair> repairs;
  Mat3 bricks_from_rest = Mat3::Identity();                     // how it was turned for that
  Vec3 extent = Vec3::Zero();                                   // m, sides of the bounding box before that
  double brick_size = 0;                                        // m
  std::vector<std::vector<WallSample>> walls;                   // of a mesh, by solid: how thick it is
  Eigen::Affine3d file_from_rest{Eigen::Affine3d::Identity()};  // before it was turned; in the units of the file
  std::optional<BrickGrid> grid;                                // of a box; of a mesh the bricks are yet to be found
};

/// Makes the box, or reads the mesh, brings it to its size and finds its solids; says what it had to choose or to mend.
/// Throws Error(kBadInput).
[[nodiscard]] LoadedBody load_body(const SceneBody& body, const Observer& observer);

}  // namespace sprung
