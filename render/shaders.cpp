#include "render/shaders.h"

#include <cassert>
#include <string>

namespace sprung {

namespace {

constexpr std::string_view kInclude = "//!include ";

std::string with_includes(std::string_view name) {
  std::string text(shader_text(name));
  assert(!text.empty());
  for (std::size_t at = text.find(kInclude); at != std::string::npos; at = text.find(kInclude, at)) {
    const std::size_t end = text.find('\n', at);
    const std::string file = text.substr(at + kInclude.size(), end - at - kInclude.size());
    text.replace(at, end - at, with_includes(file));
  }
  return text;
}

std::string source(std::string_view name, bool fragment, const std::string& defines) {
  return "#version 330 core\n" + defines + with_includes("light.glsl") +
         (fragment ? with_includes("picture.glsl") : "") + with_includes(name);
}

}  // namespace

GlProgram load_program(const GlFunctions& gl, std::string_view vertex, std::string_view fragment,
                       const std::string& defines) {
  return {gl, std::string(fragment), source(vertex, false, defines), source(fragment, true, defines)};
}

}  // namespace sprung
