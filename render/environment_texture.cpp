#include "render/environment_texture.h"

#include <algorithm>
#include <string>

namespace sprung {

namespace {

/// White in the picture, however strong the light.
constexpr float kWhite = 8;

/// Not brighter than that: what bytes stand for should not be spread thin.
float brightest(const Environment& environment) {
  float most = 1e-6F;
  for (const Panorama& level : environment.reflections) {
    for (const Eigen::Vector3f& light : level.light) most = std::max(most, light.maxCoeff());
  }
  return std::min(most, kWhite);
}

GlTexture make_reflections(const GlFunctions& gl, const Environment& environment, float brightest) {
  std::vector<Eigen::Matrix3Xf> roots;
  std::vector<const float*> levels;
  levels.reserve(environment.reflections.size());
  for (const Panorama& level : environment.reflections) {
    Eigen::Matrix3Xf& root = roots.emplace_back(3, static_cast<Eigen::Index>(level.light.size()));
    for (std::size_t i = 0; i < level.light.size(); ++i) {
      root.col(static_cast<Eigen::Index>(i)) = (level.light[i] / brightest).cwiseMin(1.0F).cwiseSqrt();
    }
  }
  for (const Eigen::Matrix3Xf& root : roots) levels.push_back(root.data());
  const Panorama& finest = environment.reflections.front();
  return make_level_texture(gl, finest.width, finest.height, levels);
}

}  // namespace

EnvironmentTexture::EnvironmentTexture(const GlFunctions& gl, const Environment& environment)
    : gl_(gl),
      irradiance_(environment.irradiance),
      brightest_(brightest(environment)),
      reflections_(make_reflections(gl, environment, brightest_)) {}

void EnvironmentTexture::bind(const GlProgram& program, int unit) const {
  for (std::size_t k = 0; k < irradiance_.size(); ++k) {
    program.set(("irradiance[" + std::to_string(k) + "]").c_str(), irradiance_[k]);
  }
  program.set("brightest_reflection", brightest_);
  bind_texture(gl_, unit, reflections_);
  program.set("reflections", unit);
}

}  // namespace sprung
