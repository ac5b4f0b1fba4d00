#pragma once
#include <string>

#include "render/image/compare.h"

namespace sprung {

/// How far a picture may be from its golden, in levels of 255. The defaults let pass what another processor or another
/// build of Mesa's llvmpipe changes (single levels here and there, a few edge pixels), and no visible change: a lamp
/// moved by a degree or a shadow gone is far beyond them.
struct GoldenTolerance {
  double mean = 0.4;         // mean absolute difference of all bytes
  double worst_block = 6.0;  // the same of the worst 8 x 8 block
};

/// Fails the test where `image` is not within tolerance of tests/golden/NAME.png, or there is none. Then keeps NAME.png
/// and NAME.difference.png in SPRUNG_KEEP_DIR and names the command that accepts the new picture.
void expect_golden(const Image& image, const std::string& name, const GoldenTolerance& tolerance = {});

}  // namespace sprung
