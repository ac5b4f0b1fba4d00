#pragma once
#include <array>
#include <vector>

#include "core/mesh/shells.h"

namespace sprung {

/// A shell that bounds matter from outside, with the cavities in it.
struct Nest {
  const Shell* outer;
  std::vector<const Shell*> cavities;
  bool is_buried = false;  // it lies in the matter of another nest and adds nothing to it
};

/// The nests that are one solid.
using NestGroup = std::vector<Nest>;

/// Closed shells in their nests, from the largest to the smallest: a shell is a cavity of the smallest nest around it
/// when it is turned the other way and in none of that nest's cavities.
[[nodiscard]] std::vector<Nest> nest_shells(const Points& points, const Triangles& triangles,
                                            const std::vector<Shell>& shells);

/// Groups the nests that cross (pairs of rows of `triangles`) or of which one lies in the matter of the other, and
/// marks those that do.
[[nodiscard]] std::vector<NestGroup> unite_nests(const Points& points, const Triangles& triangles,
                                                 std::vector<Nest> nests,
                                                 const std::vector<std::array<int, 2>>& crossings);

}  // namespace sprung
