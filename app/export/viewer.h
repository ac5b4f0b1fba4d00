#pragma once
#include <string>
#include <vector>

#include "core/io/mesh_export.h"
#include "render/camera.h"

namespace sprung {

/// A film for viewer_page.h as it grows: the model of its first frame, with textures and all, as glTF, and the
/// positions of every frame. Those are kept in 65535 steps of the film's longest side, so that they are off by 1/131070
/// of that at most.
class ViewerFilm {
 public:
  /// The meshes of the next frame, the same ones in every frame.
  void add_frame(const std::vector<PosedMesh>& meshes);

  /// The page, first seen by this camera, and as much of it in pictures of this width / height.
  [[nodiscard]] std::string page(double fps, const Camera& camera, double aspect) const;

 private:
  std::string model_;                         // glTF
  std::vector<std::vector<Floats3>> frames_;  // [mesh][frame]
};

}  // namespace sprung
