#pragma once
#include <array>
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// A contact point of a body.
struct ContactPoint {
  int brick;
  int corner;             // of the brick, the nearest
  CornerWeights weights;  // of the brick's corners
};

/// The normals of a brick's points at rest: none is further than `spread` (rad) from `axis`.
struct NormalCone {
  Vec3 axis;
  double spread;
};

/// Points embedded in a body and the triangles between them, if any, arranged by brick.
struct ContactSurface {
  /// `corners`: rows of `embedding`. `skin`: of what is drawn; `beneath`: by row of it, the row of `corners` under it
  /// or -1; or none.
  ContactSurface(const Body& body, const Embedding& embedding, const Triangles& corners, const Embedding& skin = {},
                 const std::vector<int>& beneath = {});

  std::vector<int> bricks;                    // b; that hold points, ascending
  std::vector<ContactPoint> points;           // n; grouped by brick
  std::vector<int> first_point;               // b + 1
  std::vector<std::array<int, 3>> triangles;  // of points; grouped by the brick of the first of them
  std::vector<int> first_triangle;            // b + 1
  std::vector<std::vector<int>> around;       // by point: the triangles that have it as a corner, ascending
  std::vector<ContactPoint> drawn;            // vertices of the drawn skin; grouped by the triangle beneath
  std::vector<int> first_drawn;               // t + 1
  std::vector<std::array<int, 2>> edges;      // of the triangles, each once; grouped by the brick of the first point
  std::vector<int> first_edge;                // b + 1
  std::vector<std::array<int, 2>> opposite;   // by edge: the third corners of its two triangles; -1: none
  Points normals;                             // n x 3, at rest, unit, outward; 0 without triangles
  std::vector<NormalCone> cones;              // b
  /// By row of a brick, ascending: the rows of those that share a node with it, itself included.
  std::vector<std::vector<int>> connected;  // b
  /// Likewise: the rows of those connected to it or to a common neighbour. Their skins cannot meet without a fold
  /// within a brick or two.
  std::vector<std::vector<int>> neighbours;  // b

  /// The row of the edge between two points, of which `low` is the smaller.
  [[nodiscard]] std::size_t row_of_edge(int low, int high) const;

 private:
  /// Returns the index in points of each of the embedding's.
  [[nodiscard]] std::vector<int> add_points(const Embedding& embedding);
  /// Returns the index in triangles of each row of `corners`.
  [[nodiscard]] std::vector<int> add_triangles(const Body& body, const Triangles& corners,
                                               const std::vector<int>& point_of);
  void add_skin(const Embedding& embedding, const std::vector<int>& beneath, const std::vector<int>& triangle_of);
  void add_edges();
};

/// The largest cosine between the normals of features in contact, and how far (rad) a brick's normals may turn,
/// relative to each other and until they are checked again.
inline constexpr double kFacing = 0.2;
inline constexpr double kBent = 0.5;

/// Sorts them and removes repetitions.
void sort_unique(std::vector<int>& values);

/// A normal of the skin at rest transformed with its brick, unit.
[[nodiscard]] Vec3 carried_normal(const Body& body, int brick, const Vec3& normal);

/// Returns whether two bricks share a node.
[[nodiscard]] bool share_a_node(const Body& body, int a, int b);

/// Built on first use: contacts, their triangles and the rest shape do not change after that.
[[nodiscard]] const ContactSurface& contact_surface_of(SoftBody& body);

/// The vertices of the drawn skin of a body with contact points, which are more than those; none: its contact points. A
/// half-space that holds none of them holds nothing of that skin. Built on first use.
[[nodiscard]] const ContactSurface& outline_of(SoftBody& body);

/// A nodal quantity (m x 3) at a point, interpolated from its brick's corners.
[[nodiscard]] inline Vec3 carried(const Body& body, int brick, const CornerWeights& weights, const Points& values) {
  const auto& nodes = body.grid.nodes[brick];
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 8; ++i) sum += weights[i] * values.row(nodes[i]).transpose();
  return sum;
}
[[nodiscard]] inline Vec3 carried(const Body& body, const ContactPoint& point, const Points& values) {
  return carried(body, point.brick, point.weights, values);
}

}  // namespace sprung
