#include "render/gl/context.h"

#include <fmt/format.h>

#include <cstdlib>

#include "core/error.h"

namespace sprung {

namespace {

/// Removes settings of a user's desktop that make software rendering crash, lose OpenGL 3.3, or draw other bits.
void clear_hostile_settings() {
  for (const char* name : {"GALLIUM_DRIVER", "LP_NATIVE_VECTOR_WIDTH", "LP_PERF", "GALLIVM_PERF",
                           "GALLIUM_OVERRIDE_CPU_CAPS", "MESA_GL_VERSION_OVERRIDE", "MESA_GLSL_VERSION_OVERRIDE",
                           "MESA_EXTENSION_OVERRIDE", "LIBGL_ALWAYS_SOFTWARE", "LIBGL_DRIVERS_PATH"}) {
    unsetenv(name);
  }
}

std::unique_ptr<GlSource> make_source() {
  const char* const named = std::getenv("SPRUNG_GL");
  const std::string_view name = named == nullptr ? "" : named;
  clear_hostile_settings();
  if (name == "osmesa") return make_osmesa_source();
  if (name == "egl") return make_egl_source(GlDevice::kSoftware);
  if (name == "gpu") return make_egl_source(GlDevice::kAny);
  if (!name.empty()) {
    throw Error(ErrorKind::kUsage,
                fmt::format("environment variable SPRUNG_GL: '{}' is none of osmesa, egl, gpu", name));
  }
  try {
    return make_osmesa_source();
  } catch (const Error& osmesa) {
    try {
      return make_egl_source(GlDevice::kSoftware);
    } catch (const Error& egl) {
      throw Error(ErrorKind::kFailed, fmt::format("nothing to draw with: {}; {}", osmesa.what(), egl.what()));
    }
  }
}

std::string text(const GlFunctions& gl, GLenum name) {
  const GLubyte* value = gl.GetString(name);
  return value == nullptr ? std::string() : reinterpret_cast<const char*>(value);
}

}  // namespace

void throw_missing_function(const char* name) {
  throw Error(ErrorKind::kFailed, std::string("OpenGL: ") + name + " is missing; OpenGL 3.3 is needed");
}

GlContext::GlContext() : source_(make_source()) {
  make_current();
  gl_.load([this](const char* name) { return source_->function(name); });
  // If another libGL comes first at link time, every call silently does nothing.
  if (gl_.GetString(GL_RENDERER) == nullptr) throw Error(ErrorKind::kFailed, "OpenGL calls do not reach their driver");
}

void GlContext::make_current() {
  if (!try_make_current()) throw Error(ErrorKind::kFailed, "OpenGL's context cannot become current in this thread");
}

std::string GlContext::driver() const { return text(gl_, GL_RENDERER) + ", OpenGL " + text(gl_, GL_VERSION); }

}  // namespace sprung
