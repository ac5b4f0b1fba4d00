#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "core/types.h"

namespace sprung {

enum class FloorKind {
  kSweep,    // blends into the background without a horizon
  kPlain,    // level, up to a horizon
  kChecker,  // squares of two greys
  kWood,     // boards along x
  kNone      // the ground is invisible
};

/// A picture that repeats over the floor, from the origin of the world.
struct FloorPattern {
  int width;                       // texels along x
  int height;                      // along z
  Eigen::Vector2d sides;           // m
  std::vector<std::uint8_t> rgba;  // 8-bit sRGB, rows along x
  Eigen::Vector3f mean;            // linear; the fraction of light that the floor reflects

  /// Linear, at a position in the world, m; bilinear.
  [[nodiscard]] Eigen::Vector3f albedo(double x, double z) const;
};

struct Floor {
  bool has_horizon = false;
  std::shared_ptr<const FloorPattern> pattern{};  // none: even

  /// Sines of the line of sight's elevation between which the floor blends into the background, unless the two are one.
  [[nodiscard]] Eigen::Vector2f end() const;
};

/// `size`: of a square's side or a board's width, m. Deterministic.
[[nodiscard]] Floor floor_of(FloorKind kind, double size);

}  // namespace sprung
