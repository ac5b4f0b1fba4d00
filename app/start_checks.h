#pragma once
#include "app/build_world.h"

namespace sprung {

/// A body may start a little too deep in what it touches, and is then lifted out gently; deeper it would be shot out.
/// Nodes that are held are in nobody's way.
/// Throws Error(kBadInput) naming the bodies or obstacles, how deep, and what to move.
void check_start(const Scene& scene, const Production& production);

}  // namespace sprung
