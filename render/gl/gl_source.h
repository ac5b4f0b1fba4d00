#pragma once
#include <memory>
#include <string_view>

#include "render/gl/functions.h"

namespace sprung {

/// An OpenGL 3.3 core context without a window; pictures go to framebuffer objects. It is current in one thread at a
/// time.
class GlSource {
 public:
  GlSource() = default;
  virtual ~GlSource() = default;
  GlSource(const GlSource&) = delete;
  GlSource& operator=(const GlSource&) = delete;

  /// Makes it current in the calling thread; false if that fails.
  [[nodiscard]] virtual bool make_current() noexcept = 0;
  /// Releases it from the calling thread, where it is current, so that another may use it.
  virtual void release() noexcept = 0;
  /// Null if there is none of that name, which begins with "gl".
  [[nodiscard]] virtual GlProc function(const char* name) const = 0;
};

/// A context of Mesa's OSMesa, a software renderer. Throws Error(kFailed) if it is too old, or if this program was
/// built without it.
[[nodiscard]] std::unique_ptr<GlSource> make_osmesa_source();

enum class GlDevice { kSoftware, kAny };

/// A context of EGL without a surface (EGL_MESA_platform_surfaceless), whose software renderer gives the same bits as
/// OSMesa. Throws Error(kFailed) if there is none, or if this program was built without it.
[[nodiscard]] std::unique_ptr<GlSource> make_egl_source(GlDevice device);

}  // namespace sprung
