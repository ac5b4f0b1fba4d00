#include "render/renderer.h"

#include <algorithm>

#include "core/error.h"
#include "render/gl/context.h"
#include "render/screen.h"

namespace sprung {

namespace {

/// Radius of the ball around a skin's bounding box, m.
double radius(const Skin& skin) {
  Bounds bounds;
  bounds.include(skin.positions);
  return bounds.empty() ? 0 : 0.5 * (bounds.high - bounds.low).norm();
}

void check_options(const Stage& stage, const RenderOptions& options) {
  const int largest = options.samples > 1 ? 8192 : 16384;  // llvmpipe's limit, and two samples along each side
  if (options.width < 1 || options.height < 1 || options.width > largest || options.height > largest) {
    throw Error(ErrorKind::kUsage, "resolution " + std::to_string(options.width) + "x" +
                                       std::to_string(options.height) + ": each side must be 1 to " +
                                       std::to_string(largest) + " pixels");
  }
  if (options.samples != 1 && options.samples != 4) {
    throw Error(ErrorKind::kUsage, "samples " + std::to_string(options.samples) + ": must be 1 or 4");
  }
  if (stage.bounds.empty() || stage.skins.size() != stage.default_colors.size()) {
    throw Error(ErrorKind::kFailed, "a stage needs bounds and one default colour a skin");
  }
}

}  // namespace

struct Renderer::Device {
  std::unique_ptr<GlContext> context;  // first: the others need it to the end
  const GlFunctions& gl;
  bool has_ground;
  StageSpace space;
  double ground_height;
  double body_radius = 0;
  TextureSet textures;
  std::vector<SkinBuffers> skins;
  LightMaps maps;
  Screen screen;
  PassClock clock;

  Device(const Stage& stage, const RenderOptions& options)
      : context(make_gl_context()),
        gl(context->gl()),
        has_ground(stage.has_ground),
        space(stage.bounds),
        ground_height((stage.ground.height - space.center.y()) * space.scale),
        textures(gl),
        maps(gl),
        screen(gl, options),
        clock(gl, options.measure_passes) {
    for (std::size_t i = 0; i < stage.skins.size(); ++i) {
      skins.emplace_back(gl, *stage.skins[i], stage.default_colors[i], textures);
      body_radius = std::max(body_radius, radius(*stage.skins[i]) * space.scale);
    }
    if (body_radius == 0) body_radius = 1;
  }
  ~Device() { context->make_current(); }  // the objects are deleted next
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
};

Renderer::Renderer(const Stage& stage, const RenderOptions& options) {
  check_options(stage, options);
  device_ = std::make_unique<Device>(stage, options);
}

Renderer::~Renderer() = default;

Image Renderer::draw(const std::vector<SkinShape>& shapes, const Camera& camera) {
  Device& device = *device_;
  if (shapes.size() != device.skins.size()) throw Error(ErrorKind::kFailed, "one shape a skin is needed to draw");
  device.context->make_current();
  device.clock.start();
  for (std::size_t i = 0; i < shapes.size(); ++i) device.skins[i].update(shapes[i]);
  const DrawFrame frame{device.space, fit_light(shapes, device.space, device.body_radius, device.ground_height),
                        device.body_radius, device.ground_height, device.has_ground};
  device.clock.stop("upload");
  device.maps.draw(device.skins, device.textures, frame, device.clock);
  device.screen.draw(device.skins, device.textures, device.maps, make_view(frame, camera, device.screen.aspect()),
                     device.clock);
  Image image = device.screen.read();
  device.clock.stop("read back");
  return image;
}

const std::vector<PassTime>& Renderer::pass_times() const { return device_->clock.times(); }

std::string Renderer::driver() const {
  device_->context->make_current();
  return device_->context->driver();
}

}  // namespace sprung
