#pragma once
#include "render/environment.h"
#include "render/gl/objects.h"

namespace sprung {

/// An environment on the device, for shaders with ENVIRONMENT defined.
class EnvironmentTexture {
 public:
  EnvironmentTexture(const GlFunctions& gl, const Environment& environment);
  /// Binds the texture to a unit, and sets the uniforms that go with it.
  void bind(const GlProgram& program, int unit) const;

 private:
  const GlFunctions& gl_;
  std::array<Eigen::Vector3f, 9> irradiance_;
  float brightest_;
  GlTexture reflections_;
};

}  // namespace sprung
