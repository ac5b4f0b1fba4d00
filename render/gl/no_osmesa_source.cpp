#include "core/error.h"
#include "render/gl/gl_source.h"

// Replaces osmesa_source.cpp if OSMesa is missing.
namespace sprung {

std::unique_ptr<GlSource> make_osmesa_source() {
  throw Error(ErrorKind::kFailed, "this program was built without OSMesa; install libosmesa6-dev and build it again");
}

}  // namespace sprung
