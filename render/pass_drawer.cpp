#include "render/pass_drawer.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>

#include "render/shaders.h"

namespace sprung {

namespace {

using FloatPixels = std::vector<Eigen::Vector4f>;

constexpr TextureFormat kNumbers{GL_RGBA32F, GL_RGBA, GL_FLOAT, false, false, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kDepth{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, false, false, GL_CLAMP_TO_EDGE};

/// What is visible in a pixel.
struct Sight {
  Vec3 place;  // m, world space
  Vec3 normal;
  float id;
};

/// A line of sight in stage space: from + t * way, t >= 0.
struct Line {
  Vec3 from;
  Vec3 way;
};

Line line_of_sight(const Eigen::Matrix4d& stage_from_clip, double x, double y) {
  const Vec3 near = (stage_from_clip * Eigen::Vector4d(x, y, -1, 1)).hnormalized();
  const Vec3 far = (stage_from_clip * Eigen::Vector4d(x, y, 1, 1)).hnormalized();
  return {near, far - near};
}

void set(Passes& passes, std::size_t pixel, const Sight& sight, double depth) {
  passes.depth[pixel] = float(depth);
  passes.id[pixel] = sight.id;
  for (std::size_t k = 0; k < 3; ++k) {
    passes.position[k][pixel] = float(sight.place[k]);
    passes.normal[k][pixel] = float(sight.normal[k]);
  }
}

}  // namespace

PassDrawer::PassDrawer(const GlFunctions& gl, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      place_(make_texture(gl, width, height, kNumbers)),
      normal_(make_texture(gl, width, height, kNumbers)),
      depth_(make_texture(gl, width, height, kDepth)),
      target_(make_two_color_target(gl, place_, normal_, depth_)),
      program_(load_program(gl, "surface.vert", "passes.frag")) {}

Passes PassDrawer::draw(const std::vector<SkinBuffers>& skins, const std::vector<int>& ids, const View& view,
                        const Camera& camera) const {
  draw_skins(skins, ids, view);
  Passes passes(width_, height_);
  read(view, camera, passes);
  return passes;
}

void PassDrawer::draw_skins(const std::vector<SkinBuffers>& skins, const std::vector<int>& ids,
                            const View& view) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_.name());
  gl_.Viewport(0, 0, width_, height_);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.FrontFace(GL_CW);  // the top row comes first, which flips the image
  gl_.ClearColor(0, 0, 0, -1);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  program_.use();
  view.frame.set_common(program_);
  program_.set("clip_from_stage", view.clip_from_stage.cast<float>().eval());
  for (std::size_t i = 0; i < skins.size(); ++i) {
    if (skins[i].is_ghost()) continue;
    program_.set("id", float(ids[i]));
    skins[i].draw(Detail::kFull);
  }
  gl_.FrontFace(GL_CCW);
  gl_.Disable(GL_DEPTH_TEST);
}

void PassDrawer::read(const View& view, const Camera& camera, Passes& passes) const {
  FloatPixels places(passes.depth.size());
  FloatPixels normals(passes.depth.size());
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, places.data());
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, normals.data());
  const Vec3 ahead = (camera.target - camera.eye).normalized();
  const Eigen::Matrix4d stage_from_clip = view.clip_from_stage.inverse();
  const double ground = view.frame.ground_height;
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const auto pixel = std::size_t(y) * std::size_t(width_) + std::size_t(x);
      const bool is_skin = places[pixel].w() >= 0;
      Vec3 place = places[pixel].head<3>().cast<double>();
      Vec3 normal = normals[pixel].head<3>().cast<double>().normalized();
      float id = places[pixel].w();
      if (!is_skin || (view.frame.has_ground && place.y() < ground && view.eye.y() > ground)) {
        const Line line = line_of_sight(stage_from_clip, (2 * x + 1.0) / width_ - 1, (2 * y + 1.0) / height_ - 1);
        const bool meets_ground = view.frame.has_ground && line.from.y() > ground && line.way.y() < 0;
        if (!meets_ground) continue;
        place = line.from + line.way * ((ground - line.from.y()) / line.way.y());
        normal = Vec3::UnitY();
        id = 0;
      }
      const Vec3 world = place / view.frame.space.scale + view.frame.space.center;
      set(passes, pixel, {world, normal, id}, ahead.dot(world - camera.eye));
    }
  }
}

}  // namespace sprung
