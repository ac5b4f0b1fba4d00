#pragma once
#include <string>
#include <string_view>

namespace sprung {

/// The first fault of an OBJ text that a reader would pass over or report without its place: a vertex that is not
/// finite, a face that refers to a vertex that is not there. Faces and vertices are counted from 1, as in the format.
/// Empty where there is none.
[[nodiscard]] std::string find_obj_fault(std::string_view text);

}  // namespace sprung
