#pragma once
#include <string>

namespace sprung {

/// A JSON Schema (2020-12) of scene files, for editors and pipelines: names, types, ranges and the rules between keys.
/// It takes every scene that parse_scene() takes. Of strings with units it knows the sign of the number only; it does
/// not compare values with each other.
[[nodiscard]] std::string scene_schema();

/// Every key of a scene for people: Markdown that reads well as plain text too.
[[nodiscard]] std::string scene_reference();

}  // namespace sprung
