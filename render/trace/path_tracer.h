#pragma once
#include <vector>

#include "render/stage/stage.h"
#include "render/trace/camera_rays.h"
#include "render/trace/light_paths.h"
#include "render/trace/traced_light.h"

namespace sprung {

/// Pictures by path tracing: light that has been reflected any number of times, from the same key light, surroundings
/// and floor as in the shaders. Deterministic on one machine for any number of threads.
class PathTracer {
 public:
  /// Throws Error(kFailed) if this program was built without Embree.
  PathTracer(const Stage& stage, const RenderOptions& options) : paths_(stage), options_(options) {}

  /// Linear light times opacity, and opacity, by pixel, rows from the top.
  [[nodiscard]] std::vector<Eigen::Vector4f> draw(const Motion& motion, const Camera& camera);
  /// The light before draw() smooths it.
  [[nodiscard]] TracedLight trace(const Motion& motion, const Camera& camera);

 private:
  LightPaths paths_;
  RenderOptions options_;
};

}  // namespace sprung
