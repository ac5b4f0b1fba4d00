#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/load/load_part.h"
#include "core/units.h"

namespace sprung {

/// A support: the skin of a face, held by a stiff foundation.
struct PartFix {
  std::string text;  // as typed
  PartFace face;
  Pin pin{};  // in the scene
};

/// One load.
struct PartLoad {
  std::string text;                               // as typed
  std::optional<PartFace> face;                   // none: on the whole part
  Dimension dimension = Dimension::kForce;        // kForce, kMass, kPressure, kTorque, kLength, kAcceleration
  double amount = 0;                              // SI
  Vec3 direction = Vec3::Zero();                  // unit, in the axes of the file; zero for a pressure
  std::optional<BodyForce> force{};               // in the scene; or
  std::optional<Pin> movement{};                  // in the scene
  [[nodiscard]] std::string description() const;  // "50 N along (0, -1, 0)"
};

/// The supports and loads of a part.
struct LoadCase {
  std::vector<PartFix> fixes;
  std::vector<PartLoad> loads;
  Vec3 gravity = Vec3::Zero();  // m/s^2, in the scene: own weight and accelerations
};

/// Reads "WHERE", "WHERE:xz" (held along these axes of the file only) or "WHERE:slide" (along its normal only) for each
/// fix, and for each load
///   WHERE:AMOUNT[:DIRECTION]  a force (N, towards the inside if no direction is named), a pressure (MPa, inward), a
///                             mass that hangs there (kg, down), a torque (N m, about the direction) or a displacement
///                             (mm)
///   weight                    the part's own
///   acceleration:AMOUNT:DIR   the part's inertia, as if gravity pulled it that way
/// Throws Error(kUsage) naming the text and what to write.
[[nodiscard]] LoadCase parse_load_case(const std::vector<std::string>& fixes, const std::vector<std::string>& loads,
                                       const LoadPart& part);

}  // namespace sprung
