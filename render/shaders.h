#pragma once
#include <string>
#include <string_view>

#include "render/gl/objects.h"

namespace sprung {

/// The text of a file in render/shaders; empty if there is none of that name.
[[nodiscard]] std::string_view shader_text(std::string_view name);

/// A program of two files in render/shaders. Both are preceded by the version, `defines` (lines of "#define") and
/// light.glsl, the fragment shader also by picture.glsl. A line "//!include NAME" stands for another file.
[[nodiscard]] GlProgram load_program(const GlFunctions& gl, std::string_view vertex, std::string_view fragment,
                                     const std::string& defines = "");

}  // namespace sprung
