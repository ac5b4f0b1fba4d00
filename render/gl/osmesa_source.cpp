#include <array>

#include "core/error.h"
#include "render/gl/gl_source.h"

// osmesa.h would include the old gl.h, which hides the typedefs of glcorearb.h.
#define __gl_h_ 1  // NOLINT(bugprone-reserved-identifier)
#define GLAPIENTRY APIENTRY
#include <GL/osmesa.h>

namespace sprung {
namespace {

OSMesaContext create_osmesa_context() {
  const std::array<int, 11> attributes{OSMESA_FORMAT,
                                       OSMESA_RGBA,
                                       OSMESA_PROFILE,
                                       OSMESA_CORE_PROFILE,
                                       OSMESA_CONTEXT_MAJOR_VERSION,
                                       3,
                                       OSMESA_CONTEXT_MINOR_VERSION,
                                       3,
                                       OSMESA_DEPTH_BITS,
                                       0,
                                       0};
  OSMesaContext context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
  if (context == nullptr) {
    throw Error(ErrorKind::kFailed,
                "OSMesa cannot make an OpenGL 3.3 core context; is the package libosmesa6 of Debian 12 installed?");
  }
  return context;
}

class OsmesaSource : public GlSource {
 public:
  OsmesaSource() : context_(create_osmesa_context(), OSMesaDestroyContext) {}

  [[nodiscard]] bool make_current() noexcept override {
    return OSMesaMakeCurrent(context_.get(), dummy_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_FALSE;
  }
  void release() noexcept override {}  // other threads may use it anyway
  [[nodiscard]] GlProc function(const char* name) const override { return OSMesaGetProcAddress(name); }

 private:
  std::unique_ptr<osmesa_context, void (*)(osmesa_context*)> context_;
  std::array<unsigned char, 4> dummy_{};  // OSMesa insists on a buffer of its own
};

}  // namespace

std::unique_ptr<GlSource> make_osmesa_source() { return std::make_unique<OsmesaSource>(); }

}  // namespace sprung
