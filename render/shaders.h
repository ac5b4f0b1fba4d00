#pragma once
#include <string>
#include <string_view>

#include "render/gl/objects.h"

namespace sprung {

/// The text of a file in render/shaders; empty where there is none of that name.
[[nodiscard]] std::string_view shader_text(std::string_view name);

/// A program of two files in render/shaders. Both begin with the version, light.glsl, the
/// second with picture.glsl too; a line "//!include NAME" stands for another file. `defines`: lines of "#define".
[[nodiscard]] GlProgram load_program(const GlFunctions& gl, std::string_view vertex, std::string_view fragment,
                                     const std::string& defines = "");

}  // namespace sprung
