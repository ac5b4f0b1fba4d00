#pragma once
#include <array>
#include <memory>
#include <string>

#include "render/gl/functions.h"

struct osmesa_context;

namespace sprung {

/// An OpenGL 3.3 core context of OSMesa, without a window. It is current in one thread at a time.
class GlContext {
 public:
  /// Makes it current in the calling thread. Throws Error(kFailed) where OSMesa is missing or too old.
  GlContext();

  /// In the calling thread. Throws Error(kFailed).
  void make_current();
  /// The same; false in place of an error.
  [[nodiscard]] bool try_make_current() noexcept;

  [[nodiscard]] const GlFunctions& gl() const { return gl_; }
  /// "Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5"; the context must be current.
  [[nodiscard]] std::string driver() const;

 private:
  std::unique_ptr<osmesa_context, void (*)(osmesa_context*)> context_;
  std::array<unsigned char, 4> dummy_{};  // OSMesa insists on a buffer of its own; pictures go to framebuffer objects
  GlFunctions gl_;
};

}  // namespace sprung
