#pragma once
#include <string>
#include <vector>

#include "render/renderer.h"

namespace sprung {

/// Colours, sRGB.
inline const Eigen::Vector3f kRed(0.85F, 0.20F, 0.16F);
inline const Eigen::Vector3f kCream(0.95F, 0.93F, 0.88F);

inline constexpr RenderOptions kSmall{320, 180, 4};

/// Skins for pictures in tests, in metres.
[[nodiscard]] Skin make_sphere_skin(const Vec3& center, double radius);
/// A ring around the y axis.
[[nodiscard]] Skin make_ring_skin(const Vec3& center, double radius, double thickness);
/// A box with uvs that show the whole picture on each side, upright on the four around.
[[nodiscard]] Skin make_box_skin(const Vec3& low, const Vec3& high);
/// The skin with edges of that length at most, m.
[[nodiscard]] Skin refined(Skin skin, double max_edge);
/// One material with a texture for all triangles.
void set_texture(Skin& skin, const Image& picture);

/// Some skins at rest as a stage, with their shapes.
struct StillLife {
  std::vector<Skin> skins;
  std::vector<Eigen::Vector3f> colors;  // sRGB
  bool has_ground = true;               // at y = 0

  void add(Skin skin, const Eigen::Vector3f& color);
  [[nodiscard]] Stage stage() const;
  [[nodiscard]] std::vector<SkinShape> shapes() const;
  /// Everything multiplied by that factor.
  [[nodiscard]] StillLife scaled(double factor) const;
};

/// Red, one metre across.
[[nodiscard]] StillLife ball_on_ground();

[[nodiscard]] Image draw_scene(const StillLife& scene, const RenderOptions& options, double azimuth = 30,
                               double elevation = 14);

/// sRGB, 0 to 255.
[[nodiscard]] Eigen::Vector3d pixel(const Image& image, int x, int y);

}  // namespace sprung
