#include <array>
#include <cstdlib>

#include "core/error.h"
#include "render/gl/context.h"

// osmesa.h would pull in the old gl.h, which hides the typedefs of glcorearb.h.
#define __gl_h_ 1  // NOLINT(bugprone-reserved-identifier)
#define GLAPIENTRY APIENTRY
#include <GL/osmesa.h>

namespace sprung {

namespace {

/// Settings of a user's desktop that make software rendering crash, lose OpenGL 3.3, or draw other bits.
void clear_hostile_settings() {
  for (const char* name : {"GALLIUM_DRIVER", "LP_NATIVE_VECTOR_WIDTH", "LP_PERF", "GALLIVM_PERF",
                           "GALLIUM_OVERRIDE_CPU_CAPS", "MESA_GL_VERSION_OVERRIDE", "MESA_GLSL_VERSION_OVERRIDE",
                           "MESA_EXTENSION_OVERRIDE", "LIBGL_ALWAYS_SOFTWARE", "LIBGL_DRIVERS_PATH"}) {
    unsetenv(name);
  }
}

class OsmesaContext final : public GlContext {
 public:
  OsmesaContext() {
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
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (context_ == nullptr) fail("OSMesa cannot make an OpenGL 3.3 core context");
  }
  ~OsmesaContext() override { OSMesaDestroyContext(context_); }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  void make_current() override {
    if (OSMesaMakeCurrent(context_, dummy_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
      fail("OSMesa cannot make its context current");
    }
    if (gl().GetString == nullptr) load_functions();
  }

 private:
  [[noreturn]] static void fail(const std::string& what) {
    throw Error(ErrorKind::kFailed, what + "; is the package libosmesa6 of Debian 12 or later installed?");
  }

  void load_functions() {
    functions().load([](const char* name) { return OSMesaGetProcAddress(name); });
    // Where another libGL comes first at link time, every call silently does nothing.
    if (gl().GetString(GL_RENDERER) == nullptr) fail("OpenGL calls do not reach OSMesa");
  }

  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4> dummy_{};  // OSMesa insists on a buffer of its own; pictures go to framebuffer objects
};

}  // namespace

std::unique_ptr<GlContext> make_gl_context() {
  auto context = std::make_unique<OsmesaContext>();
  context->make_current();
  return context;
}

}  // namespace sprung
