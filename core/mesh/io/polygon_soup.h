#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/surface_mesh.h"
#include "core/types.h"

namespace sprung {

/// Triangulates a polygon of n >= 3 corners (rows of `points`) into exactly n - 2 triangles of the same winding,
/// appended to `triangles`: convex polygons by a fan, others by ear clipping in the plane of their area vector.
void cut_polygon(const Points& points, std::span<const int> polygon, std::vector<std::array<int, 3>>& triangles);

/// A corner of a polygon: rows of the soup's lists, counted from 0; -1 if the file gives none.
struct Corner {
  int position = 0;
  int uv = -1;
  int normal = -1;
};

/// Polygons as a file lists them, each corner with its own UV and normal.
struct PolygonSoup {
  std::vector<Vec3> positions;
  std::vector<Eigen::Vector4f> colors;  // of the positions, sRGB in [0, 1]; as many as these, or none
  std::vector<Eigen::Vector2f> uvs;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Corner> corners;     // of all polygons, one after the other
  std::vector<int> corner_counts;  // of each polygon, at least 3
  std::vector<int> polygon_parts;  // of each polygon, an index into parts
  std::vector<Part> parts;         // without triangle counts
  std::vector<SurfaceMaterial> materials;
  std::vector<std::string> notes;
  long lines = 0;  // in the file, which are left out
  bool single_precision = false;
};

/// Adds a position; the message names its location if it is not finite. Throws Error(kBadInput).
void add_position(PolygonSoup& soup, const Vec3& position, std::string_view name);

/// Adds a UV or a normal; non-finite ones become 0, since the shape does not depend on them. Normals are normalised.
void add_uv(PolygonSoup& soup, const Eigen::Vector2d& uv);
void add_normal(PolygonSoup& soup, const Vec3& normal);

/// The message for a file with points and lines but no faces.
[[nodiscard]] std::string no_faces(long points, long lines);

/// The soup as a mesh: polygons are triangulated and ordered by part, vertices split where UVs or normals differ.
/// Unused positions are kept; parts without triangles are dropped. Preconditions: rows of corners are in range. Throws
/// Error(kBadInput) if there is no polygon, or more than an int can count.
[[nodiscard]] SurfaceMesh mesh_from(PolygonSoup soup, std::string_view name);

}  // namespace sprung
