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

  /// In the calling thread; false where that fails.
  [[nodiscard]] virtual bool make_current() noexcept = 0;
  /// So that another thread may have it; the calling one has it.
  virtual void release() noexcept = 0;
  /// Null where there is none of that name, which begins with "gl".
  [[nodiscard]] virtual GlProc function(const char* name) const = 0;
};

/// By Mesa's OSMesa, which draws in software. Throws Error(kFailed) where it is too old, or where this program was
/// built without it.
[[nodiscard]] std::unique_ptr<GlSource> make_osmesa_source();

enum class GlDevice { kSoftware, kAny };

/// By EGL without a surface (EGL_MESA_platform_surfaceless), whose software gives the same bits as OSMesa. Throws
/// Error(kFailed) where there is none, or where this program was built without it.
[[nodiscard]] std::unique_ptr<GlSource> make_egl_source(GlDevice device);

}  // namespace sprung
