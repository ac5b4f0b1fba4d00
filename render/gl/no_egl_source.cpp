#include "core/error.h"
#include "render/gl/gl_source.h"

// In place of egl_source.cpp where EGL is missing.
namespace sprung {

std::unique_ptr<GlSource> make_egl_source(GlDevice /*device*/) {
  throw Error(ErrorKind::kFailed, "this program was built without EGL; install libegl-dev and build it again");
}

}  // namespace sprung
