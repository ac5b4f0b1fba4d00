#pragma once
#include <vector>

#include "app/scene/scene_keys.h"

namespace sprung {

/// How a part of a body is chosen, whatever is done with it.
template <class Owner>
std::vector<Key<Owner>> selection_and(std::span<const Key<Owner>> others) {
  std::vector<Key<Owner>> keys{
      {{"box", "the part in a box, in fractions of the body's bounding box"}, &Owner::box},
      {{"sphere", "the part in a ball, in fractions of the body's bounding box"}, &Owner::sphere},
      {{"half_space", "the part on one side of a plane"}, &Owner::half_space},
      {{"part", "what lies nearest to the part of the mesh of this name"}, &Owner::part},
      {{"painted", "what lies nearest to the vertices of this colour: \"#rrggbb\""}, &Owner::painted},
      {{"nearest", "the one node or brick nearest to a point, in fractions of the body's bounding box",
        Dimension::kRatio},
       &Owner::nearest},
      {{"mesh", "what a closed mesh encloses: its file, in units and frame of the body's own mesh"}, &Owner::mesh},
  };
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

/// The rule for these keys.
[[nodiscard]] inline KeyRule one_selection(KeyRule::Kind kind) {
  return {kind, {"box", "sphere", "half_space", "part", "painted", "nearest", "mesh"}};
}

}  // namespace sprung
