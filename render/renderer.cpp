#include "render/renderer.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "render/gl/context.h"
#include "render/light_maps.h"
#include "render/shaders.h"
#include "render/skin_buffers.h"

namespace sprung {

namespace {

constexpr double kFar = 100;      // stage space, where 1 is the radius of everything; the end of what is drawn
constexpr int kFirstMapUnit = 1;  // unit 0 is the skin's own texture

constexpr TextureFormat kScreenColor{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, false, false, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kScreenDepth{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, false, false,
                                     GL_CLAMP_TO_EDGE};

/// Radius of the ball around a skin's bounding box, m.
double radius(const Skin& skin) {
  Bounds bounds;
  bounds.include(skin.positions);
  return bounds.empty() ? 0 : 0.5 * (bounds.high - bounds.low).norm();
}

Eigen::Matrix4d view_from_stage(const Vec3& eye, const Vec3& target, const Vec3& up) {
  const Vec3 backwards = (eye - target).normalized();
  const Vec3 right = up.cross(backwards).normalized();
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.row(0).head<3>() = right;
  view.row(1).head<3>() = backwards.cross(right);
  view.row(2).head<3>() = backwards;
  view.topRightCorner<3, 1>() = -view.topLeftCorner<3, 3>() * eye;
  return view;
}

Eigen::Matrix4d clip_from_view(double field_of_view, double aspect, double near, double far) {
  const double slope = std::tan(field_of_view * std::numbers::pi / 360);
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 1 / (slope * aspect);
  clip(1, 1) = 1 / slope;
  clip(2, 2) = -(far + near) / (far - near);
  clip(2, 3) = -2 * far * near / (far - near);
  clip(3, 2) = -1;
  return clip;
}

/// One frame as a camera sees it, in stage space.
struct View {
  DrawFrame frame;
  Vec3 eye;
  Eigen::Matrix4d clip_from_stage;
};

View make_view(const DrawFrame& frame, const Camera& camera, double aspect) {
  const Vec3 eye = frame.space.from_world(camera.eye);
  const double away = eye.norm();
  const double near = std::max(0.02 * away, 0.002);
  const double far = away + kFar;
  return {frame, eye,
          clip_from_view(camera.vertical_field_of_view, aspect, near, far) *
              view_from_stage(eye, frame.space.from_world(camera.target), camera.up)};
}

/// Buffers of the picture's size. `shaded` is drawn once a pixel; with multisampling `smooth` follows and is resolved
/// into `shaded` again.
struct Screen {
  int width;
  int height;
  bool multisampled;
  GlTexture color;
  GlTexture depth;
  GlFramebuffer shaded;
  GlRenderbuffer smooth_color;
  GlRenderbuffer smooth_depth;
  GlFramebuffer smooth;

  Screen(const GlFunctions& gl, const RenderOptions& options)
      : width(options.width),
        height(options.height),
        multisampled(options.samples > 1),
        color(make_texture(gl, width, height, kScreenColor)),
        depth(make_texture(gl, width, height, kScreenDepth)),
        shaded(make_texture_target(gl, &color, &depth)) {
    if (!multisampled) return;
    smooth_color = make_renderbuffer(gl, GL_RGBA8, width, height, options.samples);
    smooth_depth = make_renderbuffer(gl, GL_DEPTH_COMPONENT32F, width, height, options.samples);
    smooth = make_framebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, smooth.name());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, smooth_color.name());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, smooth_depth.name());
    check_framebuffer(gl, "a picture of this size");
  }

  void begin(const GlFunctions& gl, const GlFramebuffer& target) const {
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.name());
    gl.Viewport(0, 0, width, height);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
  }

  [[nodiscard]] Image read(const GlFunctions& gl) const {
    if (multisampled) {
      gl.BindFramebuffer(GL_READ_FRAMEBUFFER, smooth.name());
      gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, shaded.name());
      gl.BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, shaded.name());
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    Image image(width, height);
    gl.ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
    const auto stride = 3 * static_cast<std::ptrdiff_t>(width);
    for (int top = 0, bottom = height - 1; top < bottom; ++top, --bottom) {  // OpenGL's rows run upwards
      const auto row = image.pixels.begin() + top * stride;
      std::swap_ranges(row, row + stride, image.pixels.begin() + bottom * stride);
    }
    return image;
  }
};

void check_options(const Stage& stage, const RenderOptions& options) {
  constexpr int kLargest = 16384;  // llvmpipe's limit
  if (options.width < 1 || options.height < 1 || options.width > kLargest || options.height > kLargest) {
    throw Error(ErrorKind::kUsage, "resolution " + std::to_string(options.width) + "x" +
                                       std::to_string(options.height) + ": each side must be 1 to 16384 pixels");
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
  GlVertexArray no_buffers;
  GlProgram depth_program;
  GlProgram skin_program;
  GlProgram edge_program;
  GlProgram surroundings_program;

  Device(const Stage& stage, const RenderOptions& options)
      : context(make_gl_context()),
        gl(context->gl()),
        has_ground(stage.has_ground),
        space(stage.bounds),
        ground_height((stage.ground.height - space.center.y()) * space.scale),
        textures(gl),
        maps(gl),
        screen(gl, options),
        no_buffers(make_vertex_array(gl)),
        depth_program(load_program(gl, "depth.vert", "depth.frag")),
        skin_program(load_program(gl, "skin.vert", "skin.frag")),
        edge_program(load_program(gl, "depth.vert", "skin_edges.frag")),
        surroundings_program(load_program(gl, "screen.vert", "surroundings.frag")) {
    for (std::size_t i = 0; i < stage.skins.size(); ++i) {
      skins.emplace_back(gl, *stage.skins[i], stage.default_colors[i], textures);
      body_radius = std::max(body_radius, radius(*stage.skins[i]) * space.scale);
    }
    if (body_radius == 0) body_radius = 1;
  }
  ~Device() { context->make_current(); }  // the objects are deleted next
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  void draw_picture(const View& view) const;
  void draw_surroundings(const View& view) const;
  void prepare(const GlProgram& program, const View& view) const;
};

/// llvmpipe runs the shader of a multisampled triangle even where it is hidden, so the skins' costly one runs without
/// multisampling, behind a pass that settles the depth; only then are the edges smoothed.
void Renderer::Device::draw_picture(const View& view) const {
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);  // the second pass repeats the depths of the first; the backdrop lies at the far end
  screen.begin(gl, screen.shaded);
  prepare(depth_program, view);
  for (const SkinBuffers& skin : skins) skin.draw();
  prepare(skin_program, view);
  for (const SkinBuffers& skin : skins) skin.draw(skin_program, textures, 0);
  if (screen.multisampled) {
    screen.begin(gl, screen.smooth);
    prepare(edge_program, view);
    bind_texture(gl, 0, screen.color);
    bind_texture(gl, 1, screen.depth);
    edge_program.set("shaded", 0);
    edge_program.set("shaded_depth", 1);
    for (const SkinBuffers& skin : skins) skin.draw();
  }
  draw_surroundings(view);
}

void Renderer::Device::prepare(const GlProgram& program, const View& view) const {
  program.use();
  maps.bind(program, view.frame, kFirstMapUnit);
  program.set("eye", view.eye.cast<float>().eval());
  program.set("clip_from_stage", view.clip_from_stage.cast<float>().eval());
}

void Renderer::Device::draw_surroundings(const View& view) const {
  prepare(surroundings_program, view);
  surroundings_program.set("floor_in_sight", has_ground && view.eye.y() > ground_height ? 1 : 0);
  surroundings_program.set("stage_from_clip", view.clip_from_stage.inverse().cast<float>().eval());
  gl.BindVertexArray(no_buffers.name());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

Renderer::Renderer(const Stage& stage, const RenderOptions& options) {
  check_options(stage, options);
  device_ = std::make_unique<Device>(stage, options);
}

Renderer::~Renderer() = default;

Image Renderer::draw(const std::vector<SkinShape>& shapes, const Camera& camera) {
  Device& device = *device_;
  if (shapes.size() != device.skins.size()) throw Error(ErrorKind::kFailed, "one shape a skin is needed to draw");
  device.context->make_current();
  for (std::size_t i = 0; i < shapes.size(); ++i) device.skins[i].update(shapes[i]);
  const DrawFrame frame{device.space, fit_light(shapes, device.space, device.body_radius, device.ground_height),
                        device.body_radius, device.ground_height, device.has_ground};
  device.maps.draw(device.skins, device.textures, frame);
  device.draw_picture(make_view(frame, camera, static_cast<double>(device.screen.width) / device.screen.height));
  return device.screen.read(device.gl);
}

std::string Renderer::driver() const {
  device_->context->make_current();
  return device_->context->driver();
}

}  // namespace sprung
