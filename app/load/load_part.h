#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/simulation/body_source.h"
#include "core/simulation/scene.h"

namespace sprung {

/// A part as oriented in its file: faces, loads and results are in the axes of the file; lengths are given in its unit.
/// In the scene it is upright, rotated by world_from_file.
struct LoadPart {
  SceneBody body;       // with its scale, in the scene
  LoadedBody loaded{};  // not rotated, m, origin at the middle of its bounding box
  double unit = 1;      // m, of the file
  std::string unit_name{};
  Mat3 world_from_file = Mat3::Identity();

  /// Maps a point of the loaded body to the file, and back.
  [[nodiscard]] Vec3 file_from_rest(const Vec3& position) const { return loaded.file_from_rest * position; }
  [[nodiscard]] Vec3 rest_from_file(const Vec3& position) const { return loaded.file_from_rest.inverse() * position; }
  /// The vertical of the file, upwards.
  [[nodiscard]] Vec3 up() const { return world_from_file.transpose() * Vec3::UnitY(); }
};

/// Part of a part's surface.
struct PartFace {
  std::string name;  // as typed
  Selection selection{};
  double area = 0;              // m^2
  Vec3 centre = Vec3::Zero();   // in the loaded body, m
  Vec3 outward = Vec3::Zero();  // mean of its unit normals, so that a flat face has length 1; in the axes of the file
};

/// "X,Y,Z". Throws Error(kUsage) naming the option.
[[nodiscard]] Vec3 point_from(std::string_view option, const std::string& text);

/// The face that a text means: "x-low" ... "z-high" (sides of the bounding box), "face=X,Y,Z" (the face nearest to a
/// point), "box=X,Y,Z,X,Y,Z", "ball=X,Y,Z,R" (the part of the skin inside them; units of the file), "#rrggbb"
/// (painted), or the name of a part or a material of the mesh. Throws Error(kUsage) naming the text and the
/// alternatives.
[[nodiscard]] PartFace find_face(const LoadPart& part, const std::string& text);

/// Unit; "+x", "-z", "x,y,z", "in" and "out" (of the face). None if it is not a direction.
[[nodiscard]] std::optional<Vec3> direction_from(const std::string& text, const PartFace& face);

}  // namespace sprung
