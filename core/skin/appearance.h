#pragma once

namespace sprung {

/// How a surface takes light.
enum class Look {
  kPlastic,  // smooth, softly lit; for toys
  kGelatin,  // light goes through, wet highlights
  kRubber,   // matt
  kSteel,    // polished metal
  kChart     // matt, and bright by itself: its colours stand for something
};

}  // namespace sprung
