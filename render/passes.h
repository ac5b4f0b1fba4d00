#pragma once
#include <array>
#include <vector>

namespace sprung {

/// What a compositor needs beside a picture: what is seen through the middle of every pixel, rows from the top. Nothing
/// is mixed at edges, and ghosts are left out.
struct Passes {
  using Plane = std::vector<float>;  // width * height

  int width = 0;
  int height = 0;
  Plane depth;                    // m, along the camera's axis; kNothing where there is nothing
  std::array<Plane, 3> normal;    // x, y, z: unit, in the world, towards the camera; 0 where there is nothing
  std::array<Plane, 3> position;  // x, y, z: m, in the world; 0 where there is nothing
  Plane id;                       // as the stage has them; 0 for the ground and where there is nothing

  static constexpr float kNothing = 1e10F;

  Passes() = default;
  Passes(int w, int h) : width(w), height(h) {
    const auto size = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
    depth.assign(size, kNothing);
    normal.fill(Plane(size, 0));
    position.fill(Plane(size, 0));
    id.assign(size, 0);
  }
};

}  // namespace sprung
