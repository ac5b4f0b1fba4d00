#pragma once
#include <string>
#include <vector>

#include "app/inspect/forecast.h"
#include "core/mesh/repair/repair.h"
#include "core/simulation/simulation.h"
#include "render/image/image.h"

namespace sprung {

/// A mesh, in units of its file.
struct MeshFacts {
  long vertices = 0;  // distinct positions that triangles use
  long triangles = 0;
  long parts = 0;  // named pieces
  long solids = 0;
  bool is_closed = false;  // as read: every edge has two or more triangles
  double volume = 0;       // of the solids
  double thin = 0;         // thickness below which 1 % of the surface is, over the longest side
  double median = 0;       // median thickness, likewise
  std::vector<Repair> repairs;
};

/// The bricks of a body.
struct BrickFacts {
  long count = 0;
  long nodes = 0;
  long solids = 0;   // connected components
  long divided = 0;  // bricks that share their cell with another
  double size = 0;   // m
  double min_fill = 0;
  double volume = 0;        // m^3
  double volume_error = 0;  // relative to the solids
  std::vector<ThinPart> thin_parts;
  double walls = 0;  // bricks across the thinnest walls; 0: unknown
  Model model = Model::kCalibrated;
  double mass = 0;  // kg
};

struct BodyFacts {
  std::string name;
  double unit = 1;             // m per unit of the file
  Vec3 extent = Vec3::Zero();  // m
  Material material;           // without that of its regions
  MeshFacts mesh;
  BrickFacts bricks;
};

struct Inspection {
  std::vector<BodyFacts> bodies;
  double stable_step = 0;  // s
  Forecast forecast;
  std::vector<std::string> warnings;
};

/// Everything but the warnings.
[[nodiscard]] Inspection inspect(const Preparation& prepared, const Film& film);

/// Human-readable: a few lines per body.
[[nodiscard]] std::string inspection_text(const Inspection& inspection);

/// One JSON object. `mesh` and `bricks` are sums over the bodies (of sizes the smallest), `bodies` lists each.
[[nodiscard]] std::string inspection_json(const Inspection& inspection);

/// The bodies at the start, their skins on the left and their bricks on the right. Bricks of parts thinner than a brick
/// are orange, those that share their cell with another component blue, those where a hole was closed purple, those
/// that are less than half full slightly darker. Throws Error(kFailed) if no picture can be drawn.
[[nodiscard]] Image draw_bricks(const Preparation& prepared);

}  // namespace sprung
