#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "render/gl/context.h"
#include "render/gl/pass_clock.h"
#include "render/pass_drawer.h"
#include "render/screen.h"

namespace sprung {

namespace {

constexpr double kGhost = 0.28;  // opacity

/// Radius of the ball around a skin's bounding box, m.
double radius(const Skin& skin) {
  const AlignedBox bounds = bounding_box(skin.positions);
  return bounds.isEmpty() ? 0 : 0.5 * bounds.diagonal().norm();
}

/// Blends a share of another picture in.
void mix(Image& image, const Image& other, double share) {
  const auto mixed = [share](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround((1 - share) * a + share * b));
  };
  std::transform(image.pixels.begin(), image.pixels.end(), other.pixels.begin(), image.pixels.begin(), mixed);
  std::transform(image.alpha.begin(), image.alpha.end(), other.alpha.begin(), image.alpha.begin(), mixed);
}

void check_options(const Stage& stage, const RenderOptions& options) {
  const int largest = 16384 / sample_side(options.samples);  // llvmpipe's limit
  if (options.width < 1 || options.height < 1 || options.width > largest || options.height > largest) {
    throw Error(ErrorKind::kUsage, "resolution " + std::to_string(options.width) + "x" +
                                       std::to_string(options.height) + ": each side must be 1 to " +
                                       std::to_string(largest) + " pixels");
  }
  if (options.samples != 1 && options.samples != 4 && options.samples != 16) {
    throw Error(ErrorKind::kUsage, "samples " + std::to_string(options.samples) + ": must be 1, 4 or 16");
  }
  if (stage.bounds.isEmpty() || stage.skins.size() != stage.default_colors.size()) {
    throw Error(ErrorKind::kFailed, "a stage needs bounds and a default colour for every skin");
  }
}

}  // namespace

struct Renderer::Device {
  GlContext context;  // first, since all others need it until they are gone
  const GlFunctions& gl;
  bool has_ground;
  bool has_ghosts = false;
  StageSpace space;
  double ground_height;
  Eigen::Vector3f sky_on_ground;
  double body_radius = 0;
  TextureSet textures;
  std::vector<SkinBuffers> skins;
  std::vector<int> ids;  // by skin
  LightMaps maps;
  Screen screen;
  PassClock clock;
  std::optional<PassDrawer> passes;  // made with the first ones

  Device(const Stage& stage, const RenderOptions& options)
      : gl(context.gl()),
        has_ground(stage.has_ground),
        space(stage.bounds),
        ground_height((stage.ground.height - space.center.y()) * space.scale),
        sky_on_ground(stage.environment ? stage.environment->irradiance_on(Eigen::Vector3f::UnitY()) : studio_sky()),
        textures(gl, stage.color_map),
        ids(stage.ids),
        maps(gl, options.quality),
        screen(gl, options, stage.environment),
        clock(gl, options.measure_passes) {
    for (std::size_t i = 0; i < stage.skins.size(); ++i) {
      const bool is_ghost = !stage.ghosts.empty() && stage.ghosts[i];
      const Look look = stage.looks.empty() ? Look::kPlastic : stage.looks[i];
      skins.emplace_back(gl, *stage.skins[i], stage.default_colors[i], look, is_ghost, textures);
      has_ghosts = has_ghosts || is_ghost;
      body_radius = std::max(body_radius, radius(*stage.skins[i]) * space.scale);
    }
    if (body_radius == 0) body_radius = 1;
    if (!ids.empty()) return;
    ids.resize(skins.size());
    std::iota(ids.begin(), ids.end(), 1);
  }
  ~Device() { static_cast<void>(context.try_make_current()); }  // the members' OpenGL objects are deleted next
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// Uploads the shapes.
  DrawFrame frame(const std::vector<SkinShape>& shapes) {
    if (shapes.size() != skins.size()) throw Error(ErrorKind::kFailed, "drawing needs a shape for every skin");
    context.make_current();
    for (std::size_t i = 0; i < shapes.size(); ++i) skins[i].update(shapes[i]);
    return {space,        fit_light(shapes, space, body_radius, ground_height), body_radius, ground_height, has_ground,
            sky_on_ground};
  }
};

Renderer::Renderer(const Stage& stage, const RenderOptions& options) {
  check_options(stage, options);
  device_ = std::make_unique<Device>(stage, options);
}

Renderer::~Renderer() = default;

Image Renderer::draw(const std::vector<SkinShape>& shapes, const Camera& camera) {
  Device& device = *device_;
  device.context.make_current();
  device.clock.start();
  const DrawFrame frame = device.frame(shapes);
  device.clock.stop("upload");
  device.maps.draw(device.skins, device.textures, frame, device.clock);
  const View view = make_view(frame, camera, device.screen.aspect());
  device.screen.draw(device.skins, device.textures, device.maps, view, false, device.clock);
  Image image = device.screen.read();
  if (device.has_ghosts) {
    device.screen.draw(device.skins, device.textures, device.maps, view, true, device.clock);
    mix(image, device.screen.read(), kGhost);
  }
  device.clock.stop("read back");
  return image;
}

Passes Renderer::draw_passes(const std::vector<SkinShape>& shapes, const Camera& camera) {
  Device& device = *device_;
  const View view = make_view(device.frame(shapes), camera, device.screen.aspect());
  if (!device.passes) device.passes.emplace(device.gl, device.screen.width(), device.screen.height());
  return device.passes->draw(device.skins, device.ids, view, camera);
}

const std::vector<PassTime>& Renderer::pass_times() const { return device_->clock.times(); }

std::string Renderer::driver() const {
  device_->context.make_current();
  return device_->context.driver();
}

}  // namespace sprung
