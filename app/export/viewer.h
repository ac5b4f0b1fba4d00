#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/output/posed_mesh.h"

namespace sprung {

/// A film for viewer_page.h as it grows. Positions are kept in 65535 steps of the film's longest side, so that they are
/// off by 1/131070 of that at most; textures are left out.
class ViewerFilm {
 public:
  /// The meshes of the next frame, the same ones in every frame.
  void add_frame(const std::vector<PosedMesh>& meshes);

  /// The page. Camera angles in degrees, as in scenes.
  [[nodiscard]] std::string page(double fps, double azimuth, double elevation) const;

 private:
  [[nodiscard]] std::string mesh_text(std::size_t mesh, const Vec3& low, double step) const;

  struct Mesh {
    Triangles triangles;
    std::vector<std::uint8_t> colors;  // red green blue of each vertex
    std::vector<Floats3> frames;
  };
  std::vector<Mesh> meshes_;
};

}  // namespace sprung
