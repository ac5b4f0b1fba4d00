#pragma once
#include <functional>
#include <string>
#include <vector>

#include "assets/models/shapes.h"

namespace sprung::models {

/// sRGB in [0, 1].
using Color = Vec3;

/// 0xRRGGBB, as artists write it.
[[nodiscard]] inline Color color_from_hex(unsigned hex) {
  return Color((hex >> 16) & 0xFFU, (hex >> 8) & 0xFFU, hex & 0xFFU) / 255.0;
}

/// Paint on the surface where it lies inside `region`, over the layers before it.
struct Layer {
  Shape region;
  Color color = Color::Zero();
  double border = 0.1;   // width over which the paint fades in; the mesh is refined to it there
  double opacity = 1.0;  // 0..1
};

/// A toy to be meshed. Lengths in centimetres, y up, standing on y = 0, looking along +z.
struct Model {
  std::string name;  // file name without ending
  Shape shape;
  Vec3 center = Vec3::Zero();  // inside the shape or its box; the ball about it holds everything
  double radius = 0;
  double edge = 0.5;                       // longest edge of triangles, about
  double tolerance = 0.02;                 // largest distance of a triangle from the surface, about
  std::function<Color(const Vec3&)> base;  // none: the mesh has no colours
  std::vector<Layer> layers;
};

[[nodiscard]] Model make_bear();
[[nodiscard]] Model make_gummy();  // the bear without paint
[[nodiscard]] Model make_octopus();
[[nodiscard]] Model make_torus();
[[nodiscard]] Model make_pudding();
[[nodiscard]] Model make_jelly();
[[nodiscard]] Model make_knot();
[[nodiscard]] Model make_tentacle();
[[nodiscard]] Model make_gripper();
[[nodiscard]] Model make_wheel();
[[nodiscard]] Model make_cushion();

}  // namespace sprung::models
