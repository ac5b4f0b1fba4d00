#include "core/error.h"
#include "render/gl/gl_source.h"

// In place of osmesa_source.cpp where OSMesa is missing.
namespace sprung {

std::unique_ptr<GlSource> make_osmesa_source() {
  throw Error(ErrorKind::kFailed, "this program was built without OSMesa; install libosmesa6-dev and build it again");
}

}  // namespace sprung
