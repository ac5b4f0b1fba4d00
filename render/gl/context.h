#pragma once
#include <memory>
#include <string>

#include "render/gl/gl_source.h"

namespace sprung {

/// An OpenGL 3.3 core context without a window. It comes from OSMesa or, if that fails, from EGL's software renderer;
/// the environment variable SPRUNG_GL decides: "osmesa", "egl", or "gpu" for whatever driver EGL finds.
class GlContext {
 public:
  /// Makes it current in the calling thread. Throws Error(kFailed) if there is none, Error(kUsage) for another value of
  /// SPRUNG_GL.
  GlContext();

  /// Makes it current in the calling thread. Throws Error(kFailed).
  void make_current();
  /// The same; false instead of an error.
  [[nodiscard]] bool try_make_current() noexcept { return source_->make_current(); }
  /// Releases it, so that another thread can use it.
  void release() noexcept { source_->release(); }

  [[nodiscard]] const GlFunctions& gl() const { return gl_; }
  /// "Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5"; the context must be current.
  [[nodiscard]] std::string driver() const;

 private:
  std::unique_ptr<GlSource> source_;
  GlFunctions gl_;
};

/// Keeps a context current in the calling thread during its lifetime.
class CurrentContext {
 public:
  /// Throws Error(kFailed).
  explicit CurrentContext(GlContext& context) : context_(context) { context.make_current(); }
  ~CurrentContext() { context_.release(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

 private:
  GlContext& context_;
};

}  // namespace sprung
