#define EGL_NO_X11 1  // egl.h would include the headers of X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <string>

#include "core/error.h"
#include "render/gl/gl_source.h"

namespace sprung {
namespace {

[[noreturn]] void fail_egl(std::string_view what) {
  throw Error(ErrorKind::kFailed,
              fmt::format("EGL {} (error 0x{:x}); are the packages libegl1 and libgl1-mesa-dri installed?", what,
                          unsigned(eglGetError())));
}

class EglSource : public GlSource {
 public:
  EglSource() {
    display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY) fail_egl("has no platform without surfaces");
    if (eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) fail_egl("finds no driver");
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) fail_egl("has no OpenGL");
    const std::array<EGLint, 7> attributes{
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) fail_egl("cannot make an OpenGL 3.3 core context");
  }
  // The display stays: all contexts of a process share it.
  ~EglSource() override {
    release();
    eglDestroyContext(display_, context_);
  }
  EglSource(const EglSource&) = delete;
  EglSource& operator=(const EglSource&) = delete;

  [[nodiscard]] bool make_current() noexcept override {
    return eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_FALSE;
  }
  void release() noexcept override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
  [[nodiscard]] GlProc function(const char* name) const override { return eglGetProcAddress(name); }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlSource> make_egl_source(GlDevice device) {
  if (device == GlDevice::kSoftware) setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  return std::make_unique<EglSource>();
}

}  // namespace sprung
