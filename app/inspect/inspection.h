#pragma once
#include <string>
#include <vector>

#include "app/inspect/forecast.h"
#include "core/mesh/repair/repair.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// What a file holds, in its own units.
struct MeshFacts {
  long vertices = 0;  // places that triangles use, each once
  long triangles = 0;
  long parts = 0;  // named pieces
  long solids = 0;
  bool is_closed = false;  // as it was read: every edge has two triangles or more
  double volume = 0;       // of the solids
  double thin = 0;         // what 1 % of the surface is thinner than, over the longest side
  double median = 0;       // what half of it is thinner than, likewise
  std::vector<Repair> repairs;
};

/// The bricks of a body.
struct BrickFacts {
  long count = 0;
  long nodes = 0;
  long solids = 0;   // pieces that hang together
  long divided = 0;  // bricks that share their cell with another one
  double size = 0;   // m
  double least_fill = 0;
  double volume = 0;        // m^3
  double volume_error = 0;  // relative to the solids
  std::vector<ThinPart> thin_parts;
  double mass = 0;  // kg
};

struct BodyFacts {
  std::string name;
  double unit = 1;             // m per unit of the file
  Vec3 extent = Vec3::Zero();  // m
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
[[nodiscard]] Inspection inspect(const Preparation& prepared, const Film& scene);

/// For people: a few lines a body.
[[nodiscard]] std::string inspection_text(const Inspection& inspection);

/// One JSON object. `mesh` and `bricks` are sums over the bodies (sizes: the smallest), `bodies` has each.
[[nodiscard]] std::string inspection_json(const Inspection& inspection);

}  // namespace sprung
