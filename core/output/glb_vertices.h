#pragma once
#include <string>
#include <vector>

#include "core/output/animated_glb.h"
#include "core/output/glb_buffer.h"

namespace sprung {

/// Where in a buffer the vertices of a film are: accessors of the first frame, then of what later ones add to it.
struct GlbVertices {
  std::vector<int> positions;
  std::vector<int> normals;
  std::string placement;  // ",\"scale\":[...]..." of the node that has the mesh; "": none
  double error = 0;       // m: a coordinate is off by at most this
};

/// Floats.
[[nodiscard]] GlbVertices add_floats(GlbBuffer& buffer, const AnimatedMesh& mesh);

/// Positions as multiples of a step, of 16 bits: in no frame off by more than half of it. A normal is added as
/// s n - n_0, which turns n_0 into the direction of n whatever s > 0 is: where that fits into [-1, 1] with s >= 1/4 at
/// all vertices of a frame, normals have 8 bits and are off by at most 1.6 degrees, else they are floats.
/// By the extension KHR_mesh_quantization.
[[nodiscard]] GlbVertices add_quantized(GlbBuffer& buffer, const AnimatedMesh& mesh);

}  // namespace sprung
