#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/simulation/scene.h"
#include "render/image/color_map.h"
#include "render/image/image.h"
#include "render/stage/floor.h"
#include "render/stage/lighting.h"

namespace sprung {

/// The camera at a time; it moves smoothly between keyframes.
struct CameraKeyframe {
  double time = 0;        // s
  double azimuth = 30;    // degrees
  double elevation = 14;  // degrees
  double zoom = 1;        // magnification; at 1 everything fits in the picture
};

/// The camera's distance and target follow from what must be visible.
struct SceneCamera {
  double azimuth = 30;    // degrees about y; 0 looks along -z
  double elevation = 14;  // degrees above the horizon
  double orbit = 0;       // degrees by which the azimuth grows over the film
  double zoom = 1;        // magnification; at 1 everything fits in the picture
  bool follow = false;    // tracks the centre of the bodies
  bool orthographic = false;
  double aperture = 0;                    // m, diameter of the lens; what is out of focus is blurred
  std::vector<CameraKeyframe> keyframes;  // instead of azimuth, elevation, orbit and zoom
  std::optional<double> body_height{};    // largest fraction of the picture's height that bodies fill in the last frame
};

/// The field that the colours of the bodies show.
enum class Field { kSkin, kDisplacement, kSpeed, kStretch, kStrain, kStress, kVolume, kFill, kRegion };

/// The values that a colour range covers.
enum class RangeOver { kFilm, kFrame };

/// Bricks drawn instead of the skins.
enum class BrickView {
  kNone,
  kWhole,    // without gaps
  kExploded  // with gaps between them
};

/// Changes to the key light of the preset.
struct SceneKeyLight {
  std::optional<double> azimuth{};    // degrees about y, as a camera's
  std::optional<double> elevation{};  // degrees above the horizon
  std::optional<double> size{};       // angular diameter seen from the bodies, degrees
  std::optional<Color> color{};       // as bright as the preset's if it is white
  double strength = 1;
};

struct SceneRender {
  std::array<int, 2> resolution{1280, 720};
  Quality quality = Quality::kDefault;
  std::optional<int> samples;                  // per pixel; default: by the quality
  bool smooth = true;                          // coarse meshes are drawn with curved edges
  bool transparent = false;                    // background with alpha, no floor
  std::filesystem::path environment;           // absolute; a panorama that lights the bodies, or empty
  std::optional<double> environment_turn;      // degrees about the vertical
  std::optional<bool> environment_sun;         // its sun is the key light; default: yes
  std::optional<bool> environment_background;  // default: no
  FloorKind floor = FloorKind::kSweep;
  std::optional<double> floor_size;  // m, of a square or a board; default: by the bodies
  LightPreset light = LightPreset::kStudio;
  SceneKeyLight key_light;
  double motion_blur = 0;                   // degrees, shutter angle; 360: a whole frame
  std::optional<std::array<int, 2>> sheet;  // columns and rows: that many frames in one picture
  Field color_by = Field::kSkin;
  std::optional<ColorMap> color_map;
  RangeOver color_range = RangeOver::kFilm;
  std::optional<double> color_low;   // SI, of the first colour; default: by color_range
  std::optional<double> color_high;  // SI, of the last colour
  bool legend = true;
  std::string caption;
  bool frame_number = false;
  bool scale_bar = false;
  BrickView bricks = BrickView::kNone;
  std::optional<HalfSpace> cut;  // removes the bricks on the side its normal points to
  bool springs = false;
  bool edges = false;  // of the skins' triangles
  bool nodes = false;
  bool pins = false;
  bool ghost = false;  // of the rest shape
  bool contacts = false;
  bool traces = false;  // paths of the probes
  bool plots = false;   // of the displacement of the probes
};

}  // namespace sprung
