#include "render/gl/context.h"

#include "core/error.h"

namespace sprung {

namespace {

std::string text(const GlFunctions& gl, GLenum name) {
  const GLubyte* value = gl.GetString(name);
  return value == nullptr ? std::string() : reinterpret_cast<const char*>(value);
}

}  // namespace

void throw_missing_function(const char* name) {
  throw Error(ErrorKind::kFailed, std::string("OpenGL: ") + name + " is missing; OpenGL 3.3 is needed");
}

std::string GlContext::driver() const { return text(gl_, GL_RENDERER) + ", OpenGL " + text(gl_, GL_VERSION); }

}  // namespace sprung
