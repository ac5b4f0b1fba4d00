#pragma once
#include <array>
#include <optional>
#include <vector>

#include "core/appearance.h"
#include "core/skin/skin.h"
#include "render/image/color_map.h"
#include "render/image/image.h"
#include "render/stage/camera.h"
#include "render/stage/environment.h"
#include "render/stage/floor.h"
#include "render/stage/lighting.h"

namespace sprung {

/// One skin in one frame.
struct SkinShape {
  Floats3 positions;  // n x 3, m, world
  Floats3 normals;    // n x 3, any length
  Eigen::VectorXf map_coordinates =
      {};  // n, on the stage's colour map: 0 to 1, plus 2 for darker lines; no rows: the skin's own colours
  /// n, of kOpacities, the same at all corners of a triangle: the skin casts no shadow. No rows: opaque.
  Eigen::VectorXf opacities = {};

  [[nodiscard]] bool is_faint() const { return opacities.size() > 0; }
};

/// Shapes by time, at equal steps while the shutter is open, and skin; a single time is an instant.
using Motion = std::vector<const std::vector<SkinShape>*>;

struct GroundPlane {
  double height = 0;  // y, m
};

struct RenderOptions {
  int width = 1280;
  int height = 720;
  int samples = 4;  // per pixel: 1, 4 or 16; for kFinal 1 to 4096
  bool measure_passes = false;
  Quality quality = Quality::kDefault;  // of light
  bool transparent = false;             // pictures with alpha: bodies without a background
  bool exposes = false;                 // pictures are of several exposures
  /// Rays gather the surrounding light, so that bodies occlude it from each other and themselves. Needs Embree; not
  /// used in preview and final quality.
  bool gathers_light = true;
};

inline constexpr double kGhostOpacity = 0.28;

/// The opacities that objects in a picture can have.
inline constexpr std::array kOpacities{0.18, kGhostOpacity, 0.6, 1.0};

/// Everything that does not change during a film: the skins at rest (indices, UVs, colours, textures), ground and
/// light.
struct Stage {
  std::vector<const Skin*> skins;               // must outlive the renderer
  std::vector<Eigen::Vector3f> default_colors;  // sRGB, one per skin: for parts without material, colours or texture
  std::vector<Look> looks{};                    // one per skin; none: plastic
  /// Mean free paths of light inside, m, one per skin. None or 0: no light enters.
  std::vector<double> mean_free_paths{};
  std::vector<bool> ghosts{};  // one per skin; none: no ghosts. They are faint and cast no shadow
  std::vector<int> ids{};      // one per skin, for passes; none: 1, 2, ...
  ColorMap color_map = ColorMap::kViridis;
  bool has_ground = true;
  GroundPlane ground;
  Floor floor{};      // what the ground looks like
  AlignedBox bounds;  // of the whole motion: sizes shadow map, ground fade and light
  Lighting lighting = lighting_of(LightPreset::kStudio);
  std::optional<Environment> environment{};  // replaces the sky and the studio's walls, not the key light
};

/// A part of the time that a shutter is open. Skins move from the first shapes to the last, and each sample of a pixel
/// sees them at a different time.
struct Exposure {
  const std::vector<SkinShape>& first;
  const std::vector<SkinShape>& last;  // the same ones: at rest
  Camera camera;
};

/// The state at one time.
struct Moment {
  const std::vector<SkinShape>& shapes;
  Camera camera;
};

/// The lighting of the stage, with the sky of its environment and the colour of its floor.
[[nodiscard]] Lighting lighting_of(const Stage& stage);

}  // namespace sprung
