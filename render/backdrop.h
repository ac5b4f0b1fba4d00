#pragma once
#include <optional>

#include "render/frame.h"
#include "render/gl/objects.h"

namespace sprung {

/// The background of a stage, and its floor where no body changes the light.
class Backdrop {
 public:
  /// `defines`: macros that say what pixels hold.
  Backdrop(const GlFunctions& gl, int width, int height, const TextureFormat& format, const Floor& floor,
           const std::optional<Environment>& environment, const std::string& defines);
  /// Redrawn only if the view requires it: without a horizon, pattern and panorama it stays the same while the camera
  /// orbits about the vertical. `shows_floor`: whether the eye is above it.
  void draw(const View& view, bool shows_floor);
  /// The result; as large as the picture.
  [[nodiscard]] const GlFramebuffer& target() const { return target_; }
  [[nodiscard]] const GlTexture& picture() const { return picture_; }

 private:
  /// The parameters that the picture depends on; rounded, so that it stays the same while the camera orbits.
  struct Sight {
    Eigen::Vector3f height;
    Eigen::Vector2f slopes;
    Eigen::Matrix4f stage_from_clip = Eigen::Matrix4f::Zero();  // if the direction matters too
    bool operator==(const Sight&) const = default;
  };

  [[nodiscard]] bool is_even() const { return !floor_.has_horizon && !panorama_; }
  [[nodiscard]] Sight sight_of(const View& view) const;
  void set_floor(const View& view, bool shows_floor) const;

  const GlFunctions& gl_;
  int width_;
  int height_;
  Floor floor_;
  std::shared_ptr<const Panorama> panorama_;
  float panorama_scale_ = 1;
  GlTexture pattern_texture_;
  GlTexture panorama_texture_;
  GlTexture picture_;
  GlFramebuffer target_;
  GlVertexArray no_buffers_;
  GlProgram program_;
  std::optional<Sight> drawn_;
};

}  // namespace sprung
