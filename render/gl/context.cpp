#include "render/gl/context.h"

#include <cstdlib>

#include "core/error.h"

// osmesa.h would include the old gl.h, which hides the typedefs of glcorearb.h.
#define __gl_h_ 1  // NOLINT(bugprone-reserved-identifier)
#define GLAPIENTRY APIENTRY
#include <GL/osmesa.h>

namespace sprung {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorKind::kFailed, what + "; is the package libosmesa6 of Debian 12 or later installed?");
}

/// Removes settings of a user's desktop that make software rendering crash, lose OpenGL 3.3, or draw other bits.
void clear_hostile_settings() {
  for (const char* name : {"GALLIUM_DRIVER", "LP_NATIVE_VECTOR_WIDTH", "LP_PERF", "GALLIVM_PERF",
                           "GALLIUM_OVERRIDE_CPU_CAPS", "MESA_GL_VERSION_OVERRIDE", "MESA_GLSL_VERSION_OVERRIDE",
                           "MESA_EXTENSION_OVERRIDE", "LIBGL_ALWAYS_SOFTWARE", "LIBGL_DRIVERS_PATH"}) {
    unsetenv(name);
  }
}

OSMesaContext create_context() {
  clear_hostile_settings();
  const std::array<int, 11> attributes{OSMESA_FORMAT,
                                       OSMESA_RGBA,
                                       OSMESA_PROFILE,
                                       OSMESA_CORE_PROFILE,
                                       OSMESA_CONTEXT_MAJOR_VERSION,
                                       3,
                                       OSMESA_CONTEXT_MINOR_VERSION,
                                       3,
                                       OSMESA_DEPTH_BITS,
                                       0,
                                       0};
  OSMesaContext context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
  if (context == nullptr) fail("OSMesa cannot make an OpenGL 3.3 core context");
  return context;
}

std::string text(const GlFunctions& gl, GLenum name) {
  const GLubyte* value = gl.GetString(name);
  return value == nullptr ? std::string() : reinterpret_cast<const char*>(value);
}

}  // namespace

void throw_missing_function(const char* name) {
  throw Error(ErrorKind::kFailed, std::string("OpenGL: ") + name + " is missing; OpenGL 3.3 is needed");
}

GlContext::GlContext() : context_(create_context(), OSMesaDestroyContext) {
  make_current();
  gl_.load([](const char* name) { return OSMesaGetProcAddress(name); });
  // Where another libGL comes first at link time, every call silently does nothing.
  if (gl_.GetString(GL_RENDERER) == nullptr) fail("OpenGL calls do not reach OSMesa");
}

bool GlContext::try_make_current() noexcept {
  return OSMesaMakeCurrent(context_.get(), dummy_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_FALSE;
}

void GlContext::make_current() {
  if (!try_make_current()) fail("OSMesa cannot make its context current");
}

std::string GlContext::driver() const { return text(gl_, GL_RENDERER) + ", OpenGL " + text(gl_, GL_VERSION); }

}  // namespace sprung
