#pragma once
#include <string>

#include "app/load/load_answer_text.h"
#include "render/image/image.h"

namespace sprung {

/// A self-contained page for any browser: the results as a table, the picture, and the shape of a (coarse) solution,
/// coloured by von Mises stress, which deforms from rest to `magnification` times its displacements and can be rotated.
[[nodiscard]] std::string load_page(const PartReport& report, const PartSolution& coarse, const Image& picture,
                                    double magnification);

}  // namespace sprung
