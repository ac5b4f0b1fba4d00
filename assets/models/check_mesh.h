#pragma once
#include <string>

#include "assets/models/toy.h"

namespace sprung::models {

struct Health {
  double volume = 0;          // m^3
  double smallest_angle = 0;  // degrees, of all triangles
  int thin_triangles = 0;     // with an angle below 20 degrees
};

/// Throws Error(kFailed), naming `name` and the fault, unless the toy, as its file will hold it, is one closed
/// manifold piece, outward, standing on y = 0 within 0.1 mm, that nowhere crosses itself.
[[nodiscard]] Health check_mesh(const Toy& toy, const std::string& name);

}  // namespace sprung::models
