#pragma once
#include "app/selector.h"
#include "core/body/body.h"

namespace sprung {

/// Gives the bricks of the regions of a body their stiffness and mass; where regions overlap the last one counts. The
/// body is still where its grid is. Returns for each brick which region it is in, counted from 1; 0: in none.
/// Throws Error(kBadInput) where a material has another Poisson's ratio than the body, and as Selector does.
std::vector<int> apply_regions(const std::vector<Region>& regions, const Selector& selector, Body& body,
                               std::size_t solid);

}  // namespace sprung
