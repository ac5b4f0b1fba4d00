#pragma once
#include <vector>

#include "core/skin/skin.h"

namespace sprung {

/// Vertices of a skin at which the light around it is gathered, and how all of its vertices interpolate it.
struct LightProbes {
  std::vector<int> vertices;  // by probe
  std::vector<int> first;     // by vertex, and one more: of its probes and weights below
  std::vector<int> probes;
  std::vector<float> weights;  // of a vertex: > 0, sum 1
};

/// One probe represents all vertices in a cell of side `min_spacing` (m, > 0; more where vertices are sparse) whose
/// normals pass through the same side of a cube. Vertices take their light from the probes around them whose normals
/// are within a right angle of theirs, so that the two sides of a thin part do not affect each other. Deterministic.
[[nodiscard]] LightProbes place_probes(const Skin& skin, double min_spacing);

/// A distance between probes at which each skin gets about as many as suit its size and all together no more than about
/// `most`; m, by skin.
[[nodiscard]] std::vector<double> probe_spacings(const std::vector<const Skin*>& skins, int most);

}  // namespace sprung
