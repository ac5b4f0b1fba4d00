#pragma once

namespace sprung {

/// By what share a part of calibrated bricks bends less than the solid, if it is curved and `across` bricks thick, at
/// most 1; flat ones bend by up to 1 % less. That of a half ring under an end load, in or out of its plane, whichever
/// is worse (`sprung validate --case cut` measures it).
[[nodiscard]] double missing_bend_if_curved(double across);

}  // namespace sprung
