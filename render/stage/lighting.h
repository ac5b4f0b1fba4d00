#pragma once
#include "core/types.h"

namespace sprung {

/// The light of a stage without an environment: a key light far away, a sky, and a floor that reflects both.
/// Irradiances are divided by pi: a white matt surface under 1 has a radiance of 1.
struct Lighting {
  double azimuth;                                // degrees about y, as a camera's: where the key light is; 0: along z
  double elevation;                              // degrees above the horizon, > 0 and < 90
  Eigen::Vector3f key;                           // irradiance of a surface that faces the key light
  float key_radius;                              // of the key light, seen from a distance of 1
  Eigen::Vector3f sky;                           // irradiance of level ground from the open sky
  Eigen::Vector3f far_off;                       // the background high up, over the floor at the viewer's feet
  Eigen::Vector3f floor{0.74F, 0.722F, 0.700F};  // the fraction of light that the floor reflects

  /// Unit vector towards the key light, world space.
  [[nodiscard]] Vec3 to_key() const;
};

enum class LightPreset {
  kStudio,    // a large warm light and a pale sky
  kSoftbox,   // a wide light from above, soft shadows
  kSunset,    // a low warm sun, a violet sky
  kOvercast,  // hardly any shadow
  kNight      // the moon
};
[[nodiscard]] Lighting lighting_of(LightPreset preset);

}  // namespace sprung
