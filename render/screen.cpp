#include "render/screen.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "render/shaders.h"
#include "render/trace/layer.h"

namespace sprung {
namespace {

/// White in the picture, however strong the light.
constexpr float kWhite = 8;

/// Clamps the panorama, so that bytes resolve the rest of it.
float brightest(const Environment& environment) {
  float most = 1e-6F;
  for (const Panorama& level : environment.reflections) {
    for (const Eigen::Vector3f& light : level.light) most = std::max(most, light.maxCoeff());
  }
  return std::min(most, kWhite);
}

GlTexture make_reflections(const GlFunctions& gl, const Environment& environment, float brightest) {
  std::vector<Eigen::Matrix3Xf> roots;
  std::vector<const float*> levels;
  levels.reserve(environment.reflections.size());
  for (const Panorama& level : environment.reflections) {
    Eigen::Matrix3Xf& root = roots.emplace_back(3, level.light.size());
    for (std::size_t i = 0; i < level.light.size(); ++i) {
      root.col(i) = (level.light[i] / brightest).cwiseMin(1.0F).cwiseSqrt();
    }
  }
  for (const Eigen::Matrix3Xf& root : roots) levels.push_back(root.data());
  const Panorama& finest = environment.reflections.front();
  return make_level_texture(gl, finest.width, finest.height, levels);
}

}  // namespace

EnvironmentTexture::EnvironmentTexture(const GlFunctions& gl, const Environment& environment)
    : gl_(gl),
      irradiance_(environment.irradiance),
      brightest_(brightest(environment)),
      reflections_(make_reflections(gl, environment, brightest_)) {}

void EnvironmentTexture::bind(const GlProgram& program, int unit) const {
  for (std::size_t k = 0; k < irradiance_.size(); ++k) {
    program.set(("irradiance[" + std::to_string(k) + "]").c_str(), irradiance_[k]);
  }
  program.set("brightest_reflection", brightest_);
  bind_texture(gl_, unit, reflections_);
  program.set("reflections", unit);
}

namespace {

constexpr int kFirstMapUnit = 1;  // unit 0 is the skin's texture
constexpr int kFirstSurfaceUnit = kFirstMapUnit + LightMaps::kUnits;

// Kinds of pixels, encoded as depths.
constexpr float kSkin = 0.5F;
constexpr float kNoSkin = 1;

constexpr double kLargestCircle = 0.06;  // of confusion, in heights of the picture
constexpr double kLevel = 1e-4;          // sine of the elevation of a ray that counts as level

constexpr TextureFormat kColorFormat{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, false, false, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kGatheredFormat{GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT, false, false, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kLightFormat{GL_RGBA32F, GL_RGBA, GL_FLOAT, false, false, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kCircleFormat{GL_R32F, GL_RED, GL_FLOAT, false, false, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kDepthFormat{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, false, false,
                                     GL_CLAMP_TO_EDGE};

const TextureFormat& picture_format(ScreenOutput output) {
  return output == ScreenOutput::kPicture ? kColorFormat : kLightFormat;
}

const char* output_define(ScreenOutput output) {
  if (output == ScreenOutput::kPicture) return "";
  return output == ScreenOutput::kLight ? "#define EXPOSURE\n" : "#define EXPOSURE\n#define SHARES\n";
}

std::string gathered_define(Gathering gathering) {
  return fmt::format("{}{}", gathering >= Gathering::kAround ? "#define GATHERED\n" : "",
                     gathering >= Gathering::kThrough
                         ? fmt::format("#define THROUGH\n#define LAYER {:.3f}\n#define INNER {:.3f}\n",
                                       Layer::kScattering, Layer::kInner)
                         : "");
}

/// The tint of the floor comes from the light maps if these have what the picture has.
std::string floor_define(ScreenOutput output, bool exposes) {
  return output_define(output) + std::string(output == ScreenOutput::kLight && !exposes ? "#define LIGHT\n" : "");
}

bool has_floor_in_sight(const View& view) {
  const bool looks_down = view.near > 0 || view.sight(1, 2) < -kLevel;  // parallel rays may run along the floor
  return view.frame.has_ground && view.eye.y() > view.frame.ground_height && looks_down;
}

}  // namespace

Screen::Screen(const GlFunctions& gl, const RenderOptions& options, const Floor& floor,
               const std::optional<Environment>& environment, ScreenOutput output, Gathering gathering)
    : gl_(gl),
      width_(options.width),
      height_(options.height),
      side_(sample_side(options.samples)),
      is_transparent_(options.transparent),
      gathering_(gathering),
      output_(output),
      surface_color_(make_texture(gl, side_ * width_, side_ * height_, kColorFormat)),
      surface_normal_(make_texture(gl, side_ * width_, side_ * height_, kColorFormat)),
      surface_depth_(make_texture(gl, side_ * width_, side_ * height_, kDepthFormat)),
      surface_light_(make_gathered(Gathering::kAround)),
      surface_through_(make_gathered(Gathering::kThrough)),
      surface_(make_surface()),
      picture_(make_texture(gl, width_, height_, picture_format(output))),
      kinds_(make_texture(gl, width_, height_, kDepthFormat)),
      developed_(make_texture_target(gl, &picture_, &kinds_)),
      backdrop_(gl, width_, height_, picture_format(output), floor, environment, output_define(output)),
      environment_(environment ? std::optional(EnvironmentTexture(gl, *environment)) : std::nullopt),
      nearer_sampler_(make_comparing_sampler(gl, GL_GREATER)),
      no_buffers_(make_vertex_array(gl)),
      surface_programs_(load_skin_programs(gl, "surface.frag", output_define(output) + gathered_define(gathering))),
      floor_program_(load_program(gl, "floor.vert", "floor.frag",
                                  floor_define(output, options.exposes) + gathered_define(gathering))),
      kinds_program_(load("kinds.frag", options)),
      skins_program_(load("skins.frag", options)) {
  if (!options.exposes) return;
  exposures_.emplace(gl, width_, height_, is_transparent_);
  circles_ = make_texture(gl, width_, height_, kCircleFormat);
  circles_target_ = make_texture_target(gl, &circles_, nullptr);
  circles_program_ = load("circles.frag", options);
}

/// Empty if less is gathered.
GlTexture Screen::make_gathered(Gathering least) const {
  return gathering_ < least ? GlTexture() : make_texture(gl_, side_ * width_, side_ * height_, kGatheredFormat);
}

GlFramebuffer Screen::make_surface() const {
  std::vector<const GlTexture*> colors{&surface_color_, &surface_normal_};
  if (gathering_ >= Gathering::kAround) colors.push_back(&surface_light_);
  if (gathering_ >= Gathering::kThrough) colors.push_back(&surface_through_);
  return make_colors_target(gl_, colors, surface_depth_);
}

GlProgram Screen::load(const char* fragment, const RenderOptions& options) const {
  const bool is_high = options.quality == Quality::kHigh;
  const bool is_preview = options.quality == Quality::kPreview;
  return load_program(
      gl_, "screen.vert", fragment,
      fmt::format("#define SIDE {}\n#define SKIN {:.3f}\n#define NO_SKIN {:.3f}\n"
                  "#define SHADOW_SEARCH {}\n#define SHADOW_TAPS {}\n{}{}{}",
                  side_, kSkin, kNoSkin,
                  is_high      ? 8
                  : is_preview ? 4
                               : 6,
                  is_high      ? 32
                  : is_preview ? 8
                               : 16,
                  environment_ ? "#define ENVIRONMENT\n" : "", output_define(output_), gathered_define(gathering_)));
}

void Screen::draw_light(const LightMaps& maps, const View& view, DrawTimer& clock) {
  if (output_ == ScreenOutput::kShares) {
    clear_picture({1, 1, 1, 1});
  } else if (is_transparent_) {
    clear_picture(Eigen::Vector4f::Zero());
  } else {
    show_backdrop(view);
    clock.stop("backdrop");
  }
  if (!is_transparent_) draw_floor(maps, view);
  clock.stop("floor");
  develop(maps, view, clock);
}

namespace {

/// The largest circle of confusion, in heights of the picture.
double largest_circle(const View& view) {
  double largest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point = view.frame.light.bodies.corner(static_cast<AlignedBox::CornerType>(corner));
    const double away = view.near > 0 ? std::max((view.clip_from_stage * point.homogeneous()).w(), view.near) : 0;
    if (away > 0) largest = std::max(largest, view.lens * std::abs(away - view.focus) / away);
  }
  return view.near > 0 ? std::min(largest, kLargestCircle) : kLargestCircle;
}

}  // namespace

void Screen::add_exposure(const LightMaps& maps, const View& view, double part) const {
  if (view.lens == 0) return exposures_.value().add(picture_, part);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, circles_target_.name());
  gl_.Disable(GL_DEPTH_TEST);
  cover(circles_program_, maps, view);
  exposures_.value().add(picture_, circles_, largest_circle(view), part);
}

Image Screen::read() const {
  if (exposures_) {
    exposures_->develop();
  } else {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, developed_.name());
  }
  return read_picture(gl_, width_, height_, is_transparent_);
}

Image read_picture(const GlFunctions& gl, int width, int height, bool is_transparent) {
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  Image image(width, height);
  gl.ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
  if (!is_transparent) return image;
  image.alpha.resize(std::size_t(width) * std::size_t(height));
  gl.ReadPixels(0, 0, width, height, GL_ALPHA, GL_UNSIGNED_BYTE, image.alpha.data());
  return image;
}

std::vector<Eigen::Vector4f> Screen::read_numbers() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, exposures_ ? exposures_->mean() : developed_.name());
  std::vector<Eigen::Vector4f> numbers(std::size_t(width_) * std::size_t(height_));
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, numbers.data());
  for (Eigen::Vector4f& pixel : numbers) {
    if (!is_transparent_) pixel.w() = 1;
    if (!exposures_) pixel.head<3>() *= pixel.w();
  }
  return numbers;
}

void Screen::clear_surfaces() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, surface_.name());
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
}

/// The triangles are small, and llvmpipe would shade several times as many pixels as they cover. So the light is
/// computed in a deferred pass, one triangle over the whole picture.
void Screen::draw_surfaces(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const View& view,
                           float min_opacity, int turn) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, surface_.name());
  gl_.Viewport(0, 0, side_ * width_, side_ * height_);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  gl_.FrontFace(GL_CW);  // the top row comes first, which flips the image
  for (const GlProgram* program : {&surface_programs_.plain, &surface_programs_.textured, &surface_programs_.mapped}) {
    program->use();
    view.frame.set_common(*program);
    program->set("clip_from_stage", view.clip_from_stage.cast<float>().eval());
    program->set("turn", turn);
    program->set("min_opacity", min_opacity);
  }
  gl_.PolygonOffset(1, 1);  // puts ghosts behind a body in the same place
  for (const SkinBuffers& skin : skins) {
    if (skin.is_ghost() && min_opacity > float(kGhostOpacity)) continue;
    if (skin.sides() != Sides::kBoth) gl_.Enable(GL_CULL_FACE);
    gl_.CullFace(skin.sides() == Sides::kFront ? GL_BACK : GL_FRONT);
    if (skin.is_ghost()) gl_.Enable(GL_POLYGON_OFFSET_FILL);
    skin.draw(surface_programs_, textures, 0, Detail::kFull);
    gl_.Disable(GL_POLYGON_OFFSET_FILL);
    gl_.Disable(GL_CULL_FACE);
  }
  gl_.FrontFace(GL_CCW);
}

void Screen::show_backdrop(const View& view) {
  gl_.Disable(GL_DEPTH_TEST);
  backdrop_.draw(view, has_floor_in_sight(view));
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, backdrop_.target().name());
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, developed_.name());
  gl_.Viewport(0, 0, width_, height_);
  gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, developed_.name());
}

void Screen::clear_picture(const Eigen::Vector4f& color) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, developed_.name());
  gl_.Viewport(0, 0, width_, height_);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.ClearColor(color.x(), color.y(), color.z(), color.w());
  gl_.Clear(GL_COLOR_BUFFER_BIT);
}

void Screen::draw_floor(const LightMaps& maps, const View& view) const {
  if (!has_floor_in_sight(view)) return;
  floor_program_.use();
  view.frame.set_common(floor_program_);
  floor_program_.set("clip_from_stage", view.clip_from_stage.cast<float>().eval());
  const auto bind = [&](const char* name, int unit, const GlTexture& map) {
    bind_texture(gl_, unit, map);
    floor_program_.set(name, unit);
  };
  bind("ground_tint", 0, maps.ground().tint());
  bind("ground_sky", 1, maps.ground().sky());
  bind("ground_shadow", 2, maps.ground().shadow());
  if (gathering_ != Gathering::kNothing) maps.ground().bind_glow(floor_program_, 3);
  bind("backdrop", 4, backdrop_.picture());
  gl_.BindVertexArray(no_buffers_.name());
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

/// An early depth test keeps llvmpipe from running a shader, an `if` does not. So a cheap pass first writes as depth
/// whether a pixel shows a skin.
void Screen::develop(const LightMaps& maps, const View& view, DrawTimer& clock) const {
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  const PixelRectangle seen = seen_rectangle(view, width_, height_);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(seen.left, seen.top, seen.width, seen.height);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_ALWAYS);
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  cover(kinds_program_, maps, view);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  clock.stop("kinds of pixels");
  gl_.DepthMask(GL_FALSE);
  gl_.DepthFunc(GL_EQUAL);
  gl_.Enable(GL_BLEND);
  if (is_transparent_) {
    gl_.Disable(GL_BLEND);
  } else {
    gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  }
  cover(skins_program_, maps, view);
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LESS);
  gl_.Disable(GL_SCISSOR_TEST);
  clock.stop("skins");
}

/// A full-screen program that reads what was stored of the skins.
void Screen::cover(const GlProgram& program, const LightMaps& maps, const View& view) const {
  const Vec3 end = has_floor_in_sight(view) ? floor_depth(view) : Vec3(0, 0, 1);
  program.use();
  maps.bind(program, view.frame, kFirstMapUnit);
  bind_texture(gl_, kFirstSurfaceUnit, surface_color_);
  program.set("surface_color", kFirstSurfaceUnit);
  bind_texture(gl_, kFirstSurfaceUnit + 1, surface_normal_);
  program.set("packed_normal", kFirstSurfaceUnit + 1);
  bind_texture(gl_, kFirstSurfaceUnit + 2, surface_depth_);
  program.set("surface_depth", kFirstSurfaceUnit + 2);
  bind_texture(gl_, kFirstSurfaceUnit + 3, surface_depth_, nearer_sampler_.name());
  program.set("skin_coverage", kFirstSurfaceUnit + 3);
  if (environment_) environment_->bind(program, kFirstSurfaceUnit + 4);
  if (gathering_ >= Gathering::kAround) {
    bind_texture(gl_, kFirstSurfaceUnit + 5, surface_light_);
    program.set("surface_light", kFirstSurfaceUnit + 5);
    program.set("brightest_light", kBrightestVertexLight);
  }
  if (gathering_ >= Gathering::kThrough) {
    bind_texture(gl_, kFirstSurfaceUnit + 6, surface_through_);
    program.set("surface_through", kFirstSurfaceUnit + 6);
  }
  program.set("screen_depth", kSkin);
  program.set("lens", Vec3(view.lens, view.focus, view.near > 0 ? 0 : 1).cast<float>().eval());
  program.set("distance_terms", view.distance_terms.cast<float>().eval());
  program.set("eye", view.eye.cast<float>().eval());
  program.set("stage_from_clip", view.clip_from_stage.inverse().cast<float>().eval());
  program.set("end_depth", end.cast<float>().eval());
  gl_.BindVertexArray(no_buffers_.name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace sprung
