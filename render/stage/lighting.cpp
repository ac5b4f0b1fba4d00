#include "render/stage/lighting.h"

#include <cmath>
#include <numbers>

namespace sprung {

Vec3 Lighting::to_key() const {
  const double a = azimuth * std::numbers::pi / 180;
  const double e = elevation * std::numbers::pi / 180;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

Lighting lighting_of(LightPreset preset) {
  switch (preset) {
    case LightPreset::kSoftbox:
      return {.azimuth = -20,
              .elevation = 62,
              .key = {0.78F, 0.77F, 0.75F},
              .key_radius = 0.22F,
              .sky = {0.40F, 0.40F, 0.41F},
              .far_off = {0.84F, 0.84F, 0.845F}};
    case LightPreset::kSunset:
      return {.azimuth = -58,
              .elevation = 22,
              .key = {1.60F, 1.00F, 0.55F},
              .key_radius = 0.05F,
              .sky = {0.24F, 0.25F, 0.34F},
              .far_off = {0.50F, 0.47F, 0.62F}};
    case LightPreset::kOvercast:
      return {.azimuth = -28,
              .elevation = 70,
              .key = {0.24F, 0.245F, 0.25F},
              .key_radius = 0.28F,
              .sky = {0.76F, 0.79F, 0.83F},
              .far_off = {0.78F, 0.80F, 0.83F}};
    case LightPreset::kNight:
      return {.azimuth = 38,
              .elevation = 46,
              .key = {0.20F, 0.25F, 0.36F},
              .key_radius = 0.035F,
              .sky = {0.030F, 0.040F, 0.066F},
              .far_off = {0.30F, 0.34F, 0.42F}};
    case LightPreset::kStudio:
      break;
  }
  return {.azimuth = -28,
          .elevation = 52,
          .key = {0.93F, 0.89F, 0.825F},
          .key_radius = 0.11F,
          .sky = {0.275F, 0.29F, 0.305F},
          .far_off = {0.62F, 0.612F, 0.605F}};
}

}  // namespace sprung
