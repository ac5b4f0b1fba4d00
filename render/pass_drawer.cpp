#include "render/pass_drawer.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <optional>

#include "render/shaders.h"

namespace sprung {

namespace {

constexpr int kSamplesAside = 4;  // of a pixel, for what covers it

using FloatPixels = std::vector<Eigen::Vector4f>;

constexpr TextureFormat kNumbers{GL_RGBA32F, GL_RGBA, GL_FLOAT, false, false, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kDepth{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, false, false, GL_CLAMP_TO_EDGE};

/// What is visible in a pixel; positions in stage space.
struct Sight {
  Vec3 position;
  Vec3 before;  // where it is one frame earlier ...
  Vec3 after;   // ... and later
  Vec3 normal;
  Eigen::Vector2f uv;  // on skins
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

/// The offset of a position from the picture's middle, to the right and up.
Eigen::Vector2d pixels_of(const View& view, const Vec3& position, int width, int height) {
  const Vec3 clip = (view.clip_from_stage * position.homogeneous()).hnormalized();
  return {0.5 * width * clip.x(), -0.5 * height * clip.y()};
}

void set(Passes& passes, std::size_t pixel, const Sight& sight, const PassViews& views) {
  const StageSpace& space = views.now.frame.space;
  const Vec3 world = sight.position / space.scale + space.center;
  const Vec3 ahead = (views.camera.target - views.camera.eye).normalized();
  passes.depth[pixel] = float(ahead.dot(world - views.camera.eye));
  passes.id[pixel] = sight.id;
  for (std::size_t k = 0; k < 3; ++k) {
    passes.position[k][pixel] = float(world[k]);
    passes.normal[k][pixel] = float(sight.normal[k]);
  }
  const auto seen = [&](const View& view, const Vec3& position) {
    return pixels_of(view, position, passes.width, passes.height);
  };
  const Eigen::Vector2d now = seen(views.now, sight.position);
  const Eigen::Vector2d from = seen(views.before, sight.before) - now;
  const Eigen::Vector2d to = now - seen(views.after, sight.after);
  passes.uv[2][pixel] = sight.id > 0 ? 1 : 0;
  for (std::size_t k = 0; k < 2; ++k) {
    passes.uv[k][pixel] = sight.uv[k];
    passes.motion[k][pixel] = float(from[k]);
    passes.motion[k + 2][pixel] = float(to[k]);
  }
}

/// Finds where the lines of sight through pixels' centres meet the ground, in stage space.
class GroundSight {
 public:
  GroundSight(const View& view, int width, int height)
      : frame_(view.frame),
        stage_from_clip_(view.clip_from_stage.inverse()),
        is_above_(view.frame.has_ground && view.eye.y() > view.frame.ground_height),
        width_(width),
        height_(height) {}

  /// Whether the ground is before a skin that is seen at this height.
  [[nodiscard]] bool hides(double y) const { return is_above_ && y < frame_.ground_height; }
  [[nodiscard]] std::optional<Vec3> place(std::size_t pixel) const {
    if (!frame_.has_ground) return std::nullopt;
    const auto x = int(pixel % std::size_t(width_));
    const auto y = int(pixel / std::size_t(width_));
    const Line line = line_of_sight(stage_from_clip_, (2 * x + 1.0) / width_ - 1, (2 * y + 1.0) / height_ - 1);
    if (!(line.from.y() > frame_.ground_height && line.way.y() < 0)) return std::nullopt;
    return line.from + line.way * ((frame_.ground_height - line.from.y()) / line.way.y());
  }

 private:
  const DrawFrame& frame_;
  Eigen::Matrix4d stage_from_clip_;
  bool is_above_;
  int width_;
  int height_;
};

/// The view with its picture shifted by fractions of a pixel.
View shifted(View view, double right, double down, int width, int height) {
  Eigen::Matrix4d shift = Eigen::Matrix4d::Identity();
  shift(0, 3) = 2 * right / width;
  shift(1, 3) = 2 * down / height;
  view.clip_from_stage = shift * view.clip_from_stage;
  return view;
}

/// How many samples of a pixel see what.
struct Tally {
  struct Entry {
    int id = -1;
    int samples = 0;
  };
  std::array<Entry, Passes::kRanks> entries{};

  void add(int id) {
    for (Entry& entry : entries) {
      if (entry.samples > 0 && entry.id != id) continue;
      entry = {id, entry.samples + 1};
      return;
    }
  }
};

}  // namespace

PassDrawer::PassDrawer(const GlFunctions& gl, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      depth_(make_texture(gl, width, height, kDepth)),
      program_(load_program(gl, "passes.vert", "passes.frag")) {
  std::array<const GlTexture*, kTextures> colors{};
  for (std::size_t i = 0; i < kTextures; ++i) {
    numbers_[i] = make_texture(gl, width, height, kNumbers);
    colors[i] = &numbers_[i];
  }
  target_ = make_colors_target(gl, colors, depth_);
}

Passes PassDrawer::draw(const std::vector<SkinBuffers>& skins, const std::vector<int>& ids,
                        const PassViews& views) const {
  draw_skins(skins, ids, views.now);
  Passes passes(width_, height_);
  read(views, passes);
  find_coverage(skins, ids, views.now, passes);
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

void PassDrawer::read(const PassViews& views, Passes& passes) const {
  std::array<FloatPixels, kTextures> numbers;
  for (std::size_t i = 0; i < kTextures; ++i) {
    numbers[i].resize(passes.depth.size());
    gl_.ReadBuffer(GL_COLOR_ATTACHMENT0 + GLenum(i));
    gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, numbers[i].data());
  }
  const GroundSight ground(views.now, width_, height_);
  for (std::size_t pixel = 0; pixel < passes.depth.size(); ++pixel) {
    const auto place = [&](std::size_t texture) -> Vec3 { return numbers[texture][pixel].head<3>().cast<double>(); };
    Sight sight{.position = place(0),
                .before = place(2),
                .after = place(3),
                .normal = place(1).normalized(),
                .uv = {numbers[1][pixel].w(), numbers[2][pixel].w()},
                .id = numbers[0][pixel].w()};
    if (sight.id < 0 || ground.hides(sight.position.y())) {
      const std::optional<Vec3> met = ground.place(pixel);
      if (!met) continue;
      sight = {.position = *met, .before = *met, .after = *met, .normal = Vec3::UnitY(), .uv = {0, 0}, .id = 0};
    }
    set(passes, pixel, sight, views);
  }
}

void PassDrawer::find_coverage(const std::vector<SkinBuffers>& skins, const std::vector<int>& ids, const View& view,
                               Passes& passes) const {
  const GroundSight ground(view, width_, height_);
  std::vector<char> meets_ground;
  for (std::size_t pixel = 0; pixel < passes.depth.size(); ++pixel) {
    meets_ground.push_back(ground.place(pixel).has_value());
  }
  std::vector<Tally> tallies(passes.depth.size());
  FloatPixels places(passes.depth.size());
  for (int sample = 0; sample < kSamplesAside * kSamplesAside; ++sample) {
    const double right = (sample % kSamplesAside + 0.5) / kSamplesAside - 0.5;
    const int row = sample / kSamplesAside;
    const double down = (row + 0.5) / kSamplesAside - 0.5;
    draw_skins(skins, ids, shifted(view, right, down, width_, height_));
    gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, places.data());
    for (std::size_t pixel = 0; pixel < places.size(); ++pixel) {
      const bool is_skin = places[pixel].w() >= 0 && !ground.hides(places[pixel].y());
      if (is_skin || meets_ground[pixel] != 0) tallies[pixel].add(is_skin ? int(places[pixel].w()) : 0);
    }
  }
  for (std::size_t pixel = 0; pixel < tallies.size(); ++pixel) {
    auto& entries = tallies[pixel].entries;
    std::sort(entries.begin(), entries.end(), [](const Tally::Entry& a, const Tally::Entry& b) {
      return a.samples != b.samples ? a.samples > b.samples : a.id < b.id;
    });
    for (std::size_t rank = 0; rank < Passes::kRanks; ++rank) {
      passes.matte[rank][pixel] = float(entries[rank].id);
      passes.coverage[rank][pixel] = float(entries[rank].samples) / (kSamplesAside * kSamplesAside);
    }
  }
}

}  // namespace sprung
