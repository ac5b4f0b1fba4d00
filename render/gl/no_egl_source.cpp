#include "core/error.h"
#include "render/gl/gl_source.h"

// Replaces egl_source.cpp if EGL is missing.
namespace sprung {

std::unique_ptr<GlSource> make_egl_source(GlDevice /*device*/) {
  throw Error(ErrorKind::kFailed, "this program was built without EGL; install libegl-dev and build it again");
}

}  // namespace sprung
