#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "core/body/body.h"
#include "core/mesh/query/closest_triangle.h"
#include "core/simulation/body_source.h"
#include "core/simulation/skin_pieces.h"

namespace sprung {

/// Finds the parts of a body that a scene selects. All points are in metres, in the frame of the body's bricks.
class Selector {
 public:
  /// The body must outlive it.
  explicit Selector(const LoadedBody& body) : body_(body) {}

  /// The nodes (`positions`, n x 3) of one of the body's solids in the part or within half a brick of it, so that the
  /// staircase of the selected nodes is centred on the border of the part. Parts chosen by the surface (by name or
  /// paint) select the nodes within a brick of the surface. Rows, ascending. Throws Error(kBadInput) if the mesh has no
  /// such part or paint, or a file cannot be read.
  [[nodiscard]] std::vector<int> nodes(const Selection& selection, const Points& positions, std::size_t solid) const;

  /// The bricks of one of the body's solids with centres in the part. Rows, ascending. Throws like nodes().
  [[nodiscard]] std::vector<int> bricks(const Selection& selection, const BrickGrid& grid, std::size_t solid) const;

  /// The same; if there are none, since the part is thin, those with centres within half a brick of it.
  [[nodiscard]] std::vector<int> touched_bricks(const Selection& selection, const BrickGrid& grid,
                                                std::size_t solid) const;

  /// The part of a surface (`points` n x 3) of one of the body's solids: up to the border of a box, ball or half-space,
  /// else whole triangles, by their centroids. Throws like nodes().
  [[nodiscard]] std::vector<SkinPiece> skin_pieces(const Selection& selection, const Points& points,
                                                   const Triangles& triangles, std::size_t solid) const;

  /// The centre of the part: of the ball, of the box clipped to the body, else of the part's bounding box.
  [[nodiscard]] Vec3 centre(const Selection& selection) const;

  /// A point given in fractions of the bounding box.
  [[nodiscard]] Vec3 position_of(const Vec3& fractions) const;

 private:
  using Test = std::function<bool(const Vec3& position)>;

  /// `margin`: how far outside (m) still counts; `depth`: how deep below the surface (m), for parts chosen by it.
  [[nodiscard]] Test test_of(const Selection& selection, double margin, double depth) const;
  [[nodiscard]] Test test_of(const Box& box, double margin) const;
  [[nodiscard]] Test nearest_to(const Triangles& triangles, double depth) const;
  [[nodiscard]] Test nearest_to_paint(const Color& paint, double depth) const;
  [[nodiscard]] Test enclosed_by(const std::filesystem::path& mesh) const;
  [[nodiscard]] const NearestTriangle& surface() const;
  [[nodiscard]] Triangles triangles_of(const std::string& part) const;
  [[nodiscard]] Triangles face_at(const Vec3& position) const;
  [[nodiscard]] std::vector<bool> vertices_of(const Color& paint) const;
  [[nodiscard]] int nearest_vertex(const SurfaceProjection& position) const;
  [[nodiscard]] std::size_t solid_nearest_to(const Vec3& position) const;
  [[nodiscard]] SurfaceMesh read_enclosure(const std::filesystem::path& mesh) const;

  const LoadedBody& body_;
  mutable std::optional<NearestTriangle> surface_;  // made when it is first needed
};

/// n x 3, m, in the frame of the grid.
[[nodiscard]] Points brick_middles(const BrickGrid& grid);

/// Gives the bricks of the regions of a scene's body their stiffness and mass; if regions overlap, the last one counts.
/// The body is still where its grid is. Returns for each brick which region it is in, counted from 1; 0: in none.
/// Throws Error(kBadInput) if a material has another Poisson's ratio than the body, and as Selector does.
std::vector<int> apply_regions(const SceneBody& scene_body, const Selector& selector, Body& body, std::size_t solid);

}  // namespace sprung
