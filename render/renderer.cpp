#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/error.h"
#include "render/gl/context.h"
#include "render/gl/draw_timer.h"
#include "render/pass_drawer.h"
#include "render/picture_layers.h"
#include "render/screen.h"
#include "render/trace/gathered_light.h"
#include "render/trace/path_tracer.h"

namespace sprung {

namespace {

constexpr int kMaxSamples = 4096;    // of traced pictures
constexpr double kMaxMotion = 0.25;  // of a body's radius; overlays jump

std::vector<SkinShape> between(const std::vector<SkinShape>& first, const std::vector<SkinShape>& last, float part) {
  std::vector<SkinShape> shapes = first;
  for (std::size_t i = 0; i < shapes.size() && &first != &last; ++i) {
    shapes[i].positions += part * (last[i].positions - first[i].positions);
    shapes[i].normals += part * (last[i].normals - first[i].normals);
  }
  return shapes;
}

void check_options(const Stage& stage, const RenderOptions& options) {
  const bool is_traced = options.quality == Quality::kFinal;
  const int largest = 16384 / sample_side(is_traced ? 1 : options.samples);  // llvmpipe's limit
  if (options.width < 1 || options.height < 1 || options.width > largest || options.height > largest) {
    throw Error(ErrorKind::kUsage, "resolution " + std::to_string(options.width) + "x" +
                                       std::to_string(options.height) + ": each side must be 1 to " +
                                       std::to_string(largest) + " pixels");
  }
  const bool is_known =
      is_traced ? options.samples >= 1 && options.samples <= kMaxSamples : is_raster_samples(options.samples);
  if (!is_known) {
    throw Error(ErrorKind::kUsage, "samples " + std::to_string(options.samples) + ": must be " +
                                       (is_traced ? "1 to " + std::to_string(kMaxSamples) : "1, 4 or 16"));
  }
  if (stage.bounds.isEmpty() || stage.skins.size() != stage.default_colors.size()) {
    throw Error(ErrorKind::kFailed, "a stage needs bounds and a default colour for every skin");
  }
}

/// While the shutter is open.
Motion motion_of(const std::vector<Exposure>& exposures) {
  Motion motion;
  for (const Exposure& exposure : exposures) motion.push_back(&exposure.first);
  const std::vector<SkinShape>& last = exposures.back().last;
  if (&last != motion.back()) motion.push_back(&last);
  return motion;
}

int rays_of(Quality quality) { return quality == Quality::kHigh ? 64 : 32; }
int probes_of(Quality quality) { return quality == Quality::kHigh ? 32000 : 16000; }

/// The options for what the shaders draw: of a traced picture, its passes.
RenderOptions options_of_shaders(RenderOptions options) {
  if (options.quality == Quality::kPreview || !RayScene::is_available()) options.gathers_light = false;
  if (options.quality != Quality::kFinal) return options;
  options.gathers_light = false;
  options.quality = Quality::kHigh;
  options.samples = samples_of(Quality::kHigh);
  options.exposes = false;
  return options;
}

}  // namespace

/// Draws by path tracing; OpenGL only turns the light into a picture.
struct Renderer::Tracing {
  PathTracer tracer;
  Exposures picture;
  std::vector<Eigen::Vector4f> light{};  // of the last picture

  Tracing(const GlFunctions& gl, const Stage& stage, const RenderOptions& options)
      : tracer(stage, options), picture(gl, options.width, options.height, options.transparent) {}

  void draw(const Motion& motion, const Camera& camera) {
    light = tracer.draw(motion, camera);
    picture.set_mean(light);
    picture.develop();
  }
};

struct Renderer::Device {
  GlContext context;  // first, since all others need it until they are gone
  const GlFunctions& gl;
  bool has_ground;
  bool has_ghosts = false;
  StageSpace space;
  double ground_height;
  Lighting lighting;
  double body_radius = 0;
  TextureSet textures;
  std::vector<SkinBuffers> skins;
  std::vector<int> ids;  // by skin
  LightMaps maps;
  std::optional<GatheredLight> gathered;
  Screen screen;
  DrawTimer clock;
  Floor floor;
  std::optional<Environment> environment;
  RenderOptions options;
  std::optional<PassDrawer> passes;  // made with the first ones, as the next two
  std::optional<Screen> light_screen;
  std::optional<Screen> share_screen;
  std::optional<Tracing> tracing;  // if pictures are traced

  Device(const Stage& stage, const RenderOptions& wanted)
      : gl(context.gl()),
        has_ground(stage.has_ground),
        space(stage.bounds),
        ground_height((stage.ground.height - space.center.y()) * space.scale),
        lighting(lighting_of(stage)),
        textures(gl, stage.color_map),
        ids(stage.ids),
        maps(gl, options_of_shaders(wanted)),
        gathered(make_gathered(stage, options_of_shaders(wanted))),
        screen(gl, options_of_shaders(wanted), stage.floor, stage.environment,
               options_of_shaders(wanted).exposes ? ScreenOutput::kLight : ScreenOutput::kPicture, gathering()),
        clock(gl, wanted.measure_passes),
        floor(stage.floor),
        environment(stage.environment),
        options(options_of_shaders(wanted)) {
    if (wanted.quality == Quality::kFinal) tracing.emplace(gl, stage, wanted);
    for (std::size_t i = 0; i < stage.skins.size(); ++i) {
      const bool is_ghost = !stage.ghosts.empty() && stage.ghosts[i];
      const Look look = stage.looks.empty() ? Look::kPlastic : stage.looks[i];
      skins.emplace_back(gl, *stage.skins[i], stage.default_colors[i], look, is_ghost, textures);
      has_ghosts = has_ghosts || is_ghost;
      body_radius = std::max(body_radius, skin_radius(*stage.skins[i]) * space.scale);
    }
    if (body_radius == 0) body_radius = 1;
    if (!ids.empty()) return;
    ids.resize(skins.size());
    std::iota(ids.begin(), ids.end(), 1);
  }
  ~Device() { static_cast<void>(context.try_make_current()); }  // the members' OpenGL objects are deleted next
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  static std::optional<GatheredLight> make_gathered(const Stage& stage, const RenderOptions& options) {
    if (!options.gathers_light) return std::nullopt;
    return std::optional<GatheredLight>(std::in_place, stage, rays_of(options.quality), probes_of(options.quality));
  }
  [[nodiscard]] Gathering gathering() const {
    if (!gathered) return Gathering::kNothing;
    return gathered->has_through() ? Gathering::kThrough : Gathering::kAround;
  }

  void update(const std::vector<SkinShape>& shapes) {
    if (shapes.size() != skins.size()) throw Error(ErrorKind::kFailed, "drawing needs a shape for every skin");
    for (std::size_t i = 0; i < shapes.size(); ++i) skins[i].update(shapes[i]);
  }

  /// Uploads the shapes.
  DrawFrame frame(const std::vector<SkinShape>& shapes) {
    update(shapes);
    return {.space = space,
            .light = fit_light(shapes, space, body_radius, ground_height, lighting.to_key()),
            .body_radius = body_radius,
            .ground_height = ground_height,
            .has_ground = has_ground,
            .lighting = lighting};
  }

  /// Lit as in the middle of the exposure.
  DrawFrame frame(const Exposure& exposure, const std::vector<SkinShape>& shapes) {
    AlignedBox bodies = frame(exposure.first).light.bodies;
    bodies.extend(frame(exposure.last).light.bodies);
    DrawFrame middle = frame(shapes);
    middle.light.bodies = bodies;
    double longest = 0;  // m
    for (std::size_t i = 0; i < skins.size(); ++i) {
      const Floats3 ways = exposure.last[i].positions - exposure.first[i].positions;
      if (ways.rows() > 0) longest = std::max<double>(longest, ways.rowwise().norm().maxCoeff());
    }
    middle.motion = std::min(0.5 * space.scale * longest, kMaxMotion * body_radius);
    return middle;
  }

  /// Everything that follows from the shapes, which must have been uploaded with the frame.
  View light(const std::vector<SkinShape>& shapes, const DrawFrame& frame, const Camera& camera) {
    maps.draw(skins, textures, frame, clock);
    View view = make_view(frame, camera, screen.aspect());
    if (!gathered) {
      maps.ground().draw_tint(frame, nullptr);
      return view;
    }
    const GroundLight ground = maps.ground().read_light(frame);
    gathered->update(shapes, view.eye.cast<float>(), ground);
    maps.ground().draw_tint(frame, has_ground ? &gathered->onto_ground(ground) : nullptr);
    for (std::size_t i = 0; i < skins.size(); ++i) {
      skins[i].update_light(gathered->of_vertices(i));
      if (gathered->has_through()) skins[i].update_through(gathered->through_to_vertices(i));
    }
    clock.stop("light from around");
    return view;
  }

  void draw(const View& view, float min_opacity) { draw(screen, view, min_opacity); }

  void draw(Screen& target, const View& view, float min_opacity) {
    target.clear_surfaces();
    target.draw_surfaces(skins, textures, view, min_opacity);
    clock.stop("surfaces");
    target.draw_light(maps, view, clock);
  }

  Image trace(const Motion& motion, const Camera& camera) {
    tracing->draw(motion, camera);
    clock.stop("paths of light");
    Image image = read_picture(gl, options.width, options.height, options.transparent);
    clock.stop("read back");
    return image;
  }

  /// The light maps must be those of the view.
  void draw_light_passes(const View& view, const std::vector<PictureLayer>& layers, Passes& out) {
    if (!share_screen) make_light_screens();
    std::vector<Eigen::Vector4f> light;
    if (tracing) {
      light = std::exchange(tracing->light, {});
    } else if (light_screen) {
      light.assign(out.shadow.size(), Eigen::Vector4f::Zero());
      for (const PictureLayer& layer : layers) {
        draw(*light_screen, view, layer.min_opacity);
        const std::vector<Eigen::Vector4f> part = light_screen->read_numbers();
        for (std::size_t i = 0; i < light.size(); ++i) light[i] += float(layer.weight) * part[i];
      }
    } else {
      light = screen.read_numbers();
    }
    draw(*share_screen, view, 1);
    const std::vector<Eigen::Vector4f> shares = share_screen->read_numbers();
    for (std::size_t i = 0; i < light.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) out.beauty[k][i] = light[i][Eigen::Index(k)];
      out.shadow[i] = shares[i].x();
      out.occlusion[i] = shares[i].y();
    }
  }

  /// Pictures with exposures are of light already.
  void make_light_screens() {
    RenderOptions single = options;
    single.exposes = false;
    if (!options.exposes && !tracing)
      light_screen.emplace(gl, single, floor, environment, ScreenOutput::kLight, gathering());
    single.transparent = false;
    share_screen.emplace(gl, single, floor, environment, ScreenOutput::kShares, gathering());
  }

  void draw(const Exposure& exposure, const View& view, float min_opacity) {
    if (&exposure.first == &exposure.last) return draw(view, min_opacity);
    screen.clear_surfaces();
    for (int turn = 0; turn < kTurns; ++turn) {
      update(between(exposure.first, exposure.last, (float(turn) + 0.5F) / kTurns));
      screen.draw_surfaces(skins, textures, view, min_opacity, turn);
    }
    clock.stop("surfaces");
    screen.draw_light(maps, view, clock);
  }
};

bool is_raster_samples(int samples) { return samples == 1 || samples == 4 || samples == 16; }

void require_path_tracer() { static_cast<void>(RayScene({}, {})); }

Renderer::Renderer(const Stage& stage, const RenderOptions& options) {
  check_options(stage, options);
  device_ = std::make_unique<Device>(stage, options);
  device_->context.release();
}

Renderer::~Renderer() = default;

Image Renderer::draw(const std::vector<SkinShape>& shapes, const Camera& camera) {
  Device& device = *device_;
  const CurrentContext current(device.context);
  device.clock.start();
  if (device.tracing) return device.trace({&shapes}, camera);
  const DrawFrame frame = device.frame(shapes);
  device.clock.stop("upload");
  const View view = device.light(shapes, frame, camera);
  const std::vector<PictureLayer> layers = picture_layers(device.has_ghosts, shapes);
  std::vector<Image> pictures;
  for (const PictureLayer& layer : layers) {
    device.draw(view, layer.min_opacity);
    pictures.push_back(device.screen.read());
  }
  device.clock.stop("read back");
  return mean_of(std::move(pictures), layers);
}

Image Renderer::draw(const std::vector<Exposure>& exposures) {
  Device& device = *device_;
  const CurrentContext current(device.context);
  device.clock.start();
  if (device.tracing) return device.trace(motion_of(exposures), exposures.front().camera);
  device.screen.clear_exposures();
  const double part = 1.0 / double(exposures.size());
  for (const Exposure& exposure : exposures) {
    const std::vector<SkinShape> middle = between(exposure.first, exposure.last, 0.5F);
    const View view = device.light(middle, device.frame(exposure, middle), exposure.camera);
    for (const PictureLayer& layer : picture_layers(device.has_ghosts, middle)) {
      device.draw(exposure, view, layer.min_opacity);
      device.screen.add_exposure(device.maps, view, layer.weight * part);
    }
  }
  Image image = device.screen.read();
  device.clock.stop("read back");
  return image;
}

Passes Renderer::draw_passes(const Moment& now, const Moment& before, const Moment& after) {
  Device& device = *device_;
  const CurrentContext current(device.context);
  const DrawFrame frame = device.frame(now.shapes);
  for (std::size_t i = 0; i < device.skins.size(); ++i) {
    device.skins[i].update_motion(before.shapes[i].positions, after.shapes[i].positions);
  }
  const auto seen_by = [&](const Camera& camera) { return make_view(frame, camera, device.screen.aspect()); };
  const PassViews views{seen_by(now.camera), now.camera, seen_by(before.camera), seen_by(after.camera)};
  if (!device.passes) device.passes.emplace(device.gl, device.screen.width(), device.screen.height());
  Passes passes = device.passes->draw(device.skins, device.ids, views);
  static_cast<void>(device.light(now.shapes, frame, now.camera));
  if (device.tracing && device.tracing->light.empty()) device.tracing->draw({&now.shapes}, now.camera);
  device.draw_light_passes(views.now, picture_layers(device.has_ghosts, now.shapes), passes);
  return passes;
}

const std::vector<DrawTime>& Renderer::draw_times() const { return device_->clock.times(); }

std::string Renderer::driver() const {
  const CurrentContext current(device_->context);
  return device_->context.driver();
}

}  // namespace sprung
