#pragma once

namespace sprung {

/// The share by which a wall of calibrated bricks, `across` bricks thick, bends less than the solid where it is curved
/// or meets another. Up to one brick that of a half ring under an end load, in or out of its plane, whichever is worse;
/// above it that of a short L of a Poisson's ratio of up to 0.45, whose corner is then at fault (`sprung validate
/// --case cut` and `--case l_bracket`). Flat walls along the bricks bend as they should; askew ones see
/// assets/docs/accuracy.md.
[[nodiscard]] double missing_bend(double across);

/// Bricks across a wall, beyond which that is no longer said.
inline constexpr double kResolvedWall = 6;

}  // namespace sprung
