#pragma once
#include <memory>
#include <string>

#include "render/gl/functions.h"

namespace sprung {

/// An OpenGL 3.3 core context without a window. One thread at a time may have it current.
class GlContext {
 public:
  GlContext() = default;
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Makes the context current in the calling thread.
  virtual void make_current() = 0;

  [[nodiscard]] const GlFunctions& gl() const { return gl_; }
  /// "Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5"; the context must be current.
  [[nodiscard]] std::string driver() const;

 protected:
  [[nodiscard]] GlFunctions& functions() { return gl_; }

 private:
  GlFunctions gl_;
};

/// A new context, current in the calling thread. Throws Error(kFailed) where there is none to be had.
[[nodiscard]] std::unique_ptr<GlContext> make_gl_context();

}  // namespace sprung
