#pragma once
#include <optional>

#include "render/trace/interior.h"
#include "render/trace/sampler.h"
#include "render/trace/traced_skins.h"

namespace sprung {

/// Where light leaves a translucent body.
struct Emergence {
  SurfacePoint point;         // seen from outside
  Eigen::Vector3f direction;  // in which it leaves if it was not scattered
  bool is_scattered = false;  // then it leaves isotropically
  Eigen::Vector3f share;      // the fraction that was not absorbed
};

/// Follows light that has entered a body at that point of its skin, and whatever other bodies are inside or overlap
/// with it: a random walk from one scattering event to the next, until it leaves. Light that was never scattered is
/// refracted there, or reflected back; all scattered light leaves. Bodies that light does not enter are matt. None if
/// the light is absorbed. `inside`: starts behind the point.
[[nodiscard]] std::optional<Emergence> walk_through_body(const TracedSkins& skins, const Media& media,
                                                         const SurfacePoint& entry, const Ray& inside,
                                                         Sampler& sampler);

}  // namespace sprung
