#pragma once
#include <Eigen/Core>
#include <optional>

#include "render/stage/stage.h"
#include "render/trace/directions.h"

namespace sprung {

/// The light around the bodies, the same as in shaders/light.glsl and skin_light.glsl: a key light, a studio or an
/// environment above, a floor below. Radiances are of a unit in which a white matt surface under an irradiance of pi
/// has 1.
class StageLight {
 public:
  explicit StageLight(const Stage& stage);
  StageLight(const Lighting& lighting, const std::optional<Environment>& environment, Floor floor = {});
  /// Uniform, without a key light: a white furnace.
  [[nodiscard]] static StageLight even(const Eigen::Vector3f& radiance);

  /// The radiance from that direction (unit), without the key light; from below as much as the open floor reflects.
  [[nodiscard]] Eigen::Vector3f around(const Eigen::Vector3f& direction) const;
  /// Irradiance over pi of an unoccluded surface from all of around(), by side x side directions.
  [[nodiscard]] Eigen::Vector3f from_around(const Eigen::Vector3f& normal, int side) const;
  /// The light that the camera sees where there is nothing.
  [[nodiscard]] Eigen::Vector3f background(const Eigen::Vector3f& direction) const;
  /// The light that it sees of the floor, of that albedo, without bodies.
  [[nodiscard]] Eigen::Vector3f floor(const Eigen::Vector3f& direction, const Eigen::Vector3f& albedo) const;
  /// Irradiance over pi of unoccluded level ground, as it follows from around() and the key light.
  [[nodiscard]] const Eigen::Vector3f& on_open_floor() const { return on_open_floor_; }
  /// The mean fraction of the light that the floor reflects.
  [[nodiscard]] const Eigen::Vector3f& floor_albedo() const { return lighting_.floor; }
  /// Irradiance over pi of level ground from the whole sky.
  [[nodiscard]] const Eigen::Vector3f& sky_on_ground() const { return lighting_.sky; }

  /// Irradiance over pi of a surface that faces the middle of the key light.
  [[nodiscard]] Eigen::Vector3f on_facing_key() const { return (1 - key_cosine_ * key_cosine_) * key_radiance_; }
  /// Unit, the middle of the key light.
  [[nodiscard]] const Eigen::Vector3f& to_key() const { return to_key_; }
  /// Unit; evenly over the key light's disc.
  [[nodiscard]] Eigen::Vector3f towards_key(const Eigen::Vector2f& random) const;
  [[nodiscard]] bool is_key(const Eigen::Vector3f& direction) const { return direction.dot(to_key_) > key_cosine_; }
  [[nodiscard]] const Eigen::Vector3f& key_radiance() const { return key_radiance_; }
  /// One over the key light's solid angle: the density of towards_key().
  [[nodiscard]] float key_density() const { return key_density_; }

 private:
  [[nodiscard]] Eigen::Vector3f studio(const Eigen::Vector3f& direction) const;

  std::optional<Environment> environment_;
  Floor floor_;
  std::optional<Eigen::Vector3f> even_;
  Lighting lighting_;
  Eigen::Vector3f to_key_;
  TangentFrame key_frame_;
  float key_cosine_;
  float key_density_;
  Eigen::Vector3f key_radiance_;
  Eigen::Vector3f on_open_floor_;
};

}  // namespace sprung
