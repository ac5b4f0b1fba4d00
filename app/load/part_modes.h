#pragma once
#include <vector>

#include "app/load/part_answer.h"

namespace sprung {

/// The `count` lowest natural frequencies of the supported part without its loads, Hz, lowest first. Computed on the
/// coarser grids if there are several, which suffice for such global quantities. Throws Error(kBadInput) if the part is
/// several bodies.
[[nodiscard]] std::vector<Estimate> frequencies_of(const std::vector<PartSolution>& solutions, int count,
                                                   const Observer& observer);

/// The factor by which the loads have to grow until the part buckles, by linear buckling analysis on the coarser grids.
/// None if no such factor exists. Throws likewise, and if the loads prescribe displacements.
[[nodiscard]] std::optional<Estimate> buckling_factor_of(const std::vector<PartSolution>& solutions,
                                                         const Observer& observer);

}  // namespace sprung
