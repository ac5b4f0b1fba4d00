#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/simulation/scene.h"
#include "render/image/color_map.h"
#include "render/image/image.h"

namespace sprung {

/// Where the camera is at a time; in between it moves smoothly.
struct CameraKeyframe {
  double time = 0;        // s
  double azimuth = 30;    // degrees
  double elevation = 14;  // degrees
  double zoom = 1;        // size in the picture over that at which everything is seen
};

/// Where the film is seen from; distance and target follow from what is to be seen.
struct SceneCamera {
  double azimuth = 30;                    // degrees about y; 0 looks along -z
  double elevation = 14;                  // degrees above the horizon
  double orbit = 0;                       // degrees that the azimuth grows over the film
  double zoom = 1;                        // size in the picture over that at which everything is seen
  bool follow = false;                    // looks at the middle of the bodies in every frame
  bool orthographic = false;              // parallel lines of sight
  double aperture = 0;                    // m, diameter of the lens; what is off the middle of the view is blurred
  std::vector<CameraKeyframe> keyframes;  // instead of azimuth, elevation, orbit and zoom
};

/// What the colours of the bodies show.
enum class Field { kSkin, kDisplacement, kSpeed, kStretch, kStrain, kStress, kVolume, kFill, kRegion };

/// Bricks in place of the skins.
enum class BrickView {
  kNone,
  kWhole,    // where they touch each other
  kExploded  // with gaps between them
};

struct SceneRender {
  std::array<int, 2> resolution{1280, 720};
  Quality quality = Quality::kDefault;
  std::optional<int> samples;               // of a pixel; as the quality has it
  bool transparent = false;                 // nothing behind the bodies
  std::filesystem::path environment;        // absolute; a panorama whose light is that around the bodies, or empty
  double motion_blur = 0;                   // degrees that the shutter is open, of 360 a frame
  std::optional<std::array<int, 2>> sheet;  // columns and rows: that many frames in one picture
  Field color_by = Field::kSkin;
  std::optional<ColorMap> color_map;
  std::optional<double> color_low;   // SI; what the first colour stands for; else by all frames
  std::optional<double> color_high;  // SI; the last
  bool legend = true;                // of colours that stand for something
  std::string caption;
  bool frame_number = false;
  bool scale_bar = false;
  BrickView bricks = BrickView::kNone;
  std::optional<HalfSpace> cut;  // takes the bricks away to which its normal points
  bool springs = false;
  bool nodes = false;
  bool pins = false;
  bool ghost = false;     // of the shape at rest
  bool contacts = false;  // where bodies touch
  bool traces = false;    // of the probes
  bool plots = false;     // of how far they are from where they were
};

}  // namespace sprung
