#pragma once
#include <vector>

#include "app/load/part_answer.h"

namespace sprung {

/// The `count` slowest vibrations of the held part without its loads, Hz, slowest first. Of the coarser grids where
/// there are several, which such global quantities need no finer ones than. Throws Error(kBadInput) where the part is
/// several bodies.
[[nodiscard]] std::vector<Estimate> frequencies_of(const std::vector<PartSolution>& solutions, int count,
                                                   const Observer& observer);

/// The factor by which the loads have to grow until the part buckles, by linear buckling. Of the coarser grids. None
/// where no such growth makes it buckle. Throws likewise, and where the loads prescribe displacements.
[[nodiscard]] std::optional<Estimate> buckling_factor_of(const std::vector<PartSolution>& solutions,
                                                         const Observer& observer);

}  // namespace sprung
