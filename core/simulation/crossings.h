#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/types.h"

namespace sprung {

/// How the skins of a frame cross each other, themselves and obstacles; see CrossingWatch.
struct Crossings {
  int frame = 0;                     // from 0
  double time = 0;                   // s
  long pairs = 0;                    // of triangles that have a point in common; of planes: triangles that reach behind
  long pairs_at_start = 0;           // not counted in `pairs`: next to pairs that crossed at the start
  double depth = 0;                  // m, at the deepest point of `pairs`
  double share = 0;                  // depth over the largest body's size
  Vec3 position = Vec3::Zero();      // m, there
  std::array<int, 2> skins{-1, -1};  // there: rows of the world's bodies, then of its obstacles; twice the same: itself
  std::string names{};               // of them: "body 1 (a.obj) and obstacle 2"
};

/// The frame with the deepest point, of several the first; null if no skins cross.
[[nodiscard]] const Crossings* deepest_of(const std::vector<Crossings>& frames);

}  // namespace sprung
