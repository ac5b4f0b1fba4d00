#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/types.h"

namespace sprung {

/// sRGB, 8 bits a channel.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// In fractions of a body's bounding box.
struct Box {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Ones();
};

struct Ball {
  Vec3 centre = Vec3::Constant(0.5);  // in fractions of a body's bounding box
  double radius = 0;                  // in longest sides of it
};

/// What lies on that side of a plane to which the normal points.
struct HalfSpace {
  Vec3 point = Vec3::Constant(0.5);  // in fractions of a body's bounding box
  Vec3 normal = Vec3::UnitY();       // of any length
};

/// A part of a body, as it is at rest and before it is turned: exactly one of these.
struct Selection {
  std::optional<Box> box;
  std::optional<Ball> sphere;
  std::optional<HalfSpace> half_space;
  std::string part;              // what lies nearest to the triangles of that name in the mesh
  std::optional<Color> painted;  // what lies nearest to vertices of this colour
  std::optional<Vec3> nearest;   // the one node or brick nearest to a point in fractions of the bounding box
  std::filesystem::path mesh;    // absolute; what a mesh encloses, in the units and frame of the body's own
};

/// Whether it names no part, but means all of a body.
[[nodiscard]] bool is_whole(const Selection& selection);

}  // namespace sprung
