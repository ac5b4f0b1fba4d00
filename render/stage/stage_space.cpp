#include "render/stage/stage_space.h"

#include <algorithm>

namespace sprung {
namespace {

constexpr double kSmallestSize = 1e-9;  // m

}  // namespace

StageSpace::StageSpace(const AlignedBox& bounds)
    : center(bounds.center()), scale(1 / std::max(0.5 * bounds.diagonal().norm(), kSmallestSize)) {
  center = center.cast<float>().cast<double>();  // the shaders subtract it in single precision
}

}  // namespace sprung
