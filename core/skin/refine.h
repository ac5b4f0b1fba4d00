#pragma once
#include "core/skin/skin.h"

namespace sprung {

/// Halves every edge longer than max_edge (m), again and again, with both its triangles, so that no gap opens: edges
/// that are equal by position are split alike. New vertices are appended; the first ones stay as they were.
void refine(Skin& skin, double max_edge);

}  // namespace sprung
