#pragma once
#include <string>

#include "core/body/body.h"
#include "core/mesh/repair/solids.h"

namespace sprung::test {

/// A body of about `bricks` bricks, deformed by a hundredth and in motion. `shape`: "box" (a cube), "shell" (a hollow
/// ball two bricks thick) or the name of a model of assets/models.
[[nodiscard]] Body bench_body(const std::string& shape, double bricks, Model model);

/// Names the boxes by their side too: "box64" has 64^3 bricks.
[[nodiscard]] std::string box_name(int side);

/// The largest solid of a model of assets/models, its longest side 1 m.
[[nodiscard]] Solid bench_solid(const std::string& model);

/// Bytes that a body keeps a brick: grid, state and what its springs' computation needs.
[[nodiscard]] double bytes_per_brick(const Body& body);

}  // namespace sprung::test
