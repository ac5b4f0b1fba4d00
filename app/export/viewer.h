#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/io/mesh_export.h"
#include "render/camera.h"

namespace sprung {

/// viewer.html with three.js and its licence in it: a page that shows a film in three dimensions in any browser with
/// WebGL. The film, a JavaScript object, goes in place of kViewerFilm. Drag to turn, wheel to zoom, space or the bar to
/// stop.
inline constexpr std::string_view kViewerFilm = "/*FILM*/";
[[nodiscard]] std::string_view viewer_page();

/// Collects a film for viewer_page(): the model of its first frame, with textures, as glTF, and the positions of every
/// frame, rounded to 1/65535 of the film's longest side.
class ViewerFilm {
 public:
  /// The meshes of the next frame, the same ones in every frame.
  void add_frame(const std::vector<PosedMesh>& meshes);

  /// The page, which starts with this camera and shows as much as a picture of this width / height.
  [[nodiscard]] std::string page(double fps, const Camera& camera, double aspect) const;

 private:
  std::string model_;                         // glTF
  std::vector<std::vector<Floats3>> frames_;  // [mesh][frame]
};

}  // namespace sprung
