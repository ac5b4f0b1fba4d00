#include "render/trace/skin_paint.h"

#include <algorithm>
#include <cmath>

#include "core/appearance.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr int kMapSteps = 256;

Vector3f linear(const Vector3f& srgb) {
  return srgb.unaryExpr([](float c) { return linear_from_srgb(c); });
}

Vector3f texel(const Pixels& pixels, int x, int y) {
  static const std::array<float, 256> kLinear = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = linear_from_srgb(float(i) / 255);
    return table;
  }();
  const auto wrapped = [](int i, int size) { return std::size_t((i % size + size) % size); };
  const std::size_t at = 4 * (wrapped(y, pixels.height) * std::size_t(pixels.width) + wrapped(x, pixels.width));
  return {kLinear[pixels.rgba[at]], kLinear[pixels.rgba[at + 1]], kLinear[pixels.rgba[at + 2]]};
}

/// Bilinear; repeats.
Vector3f looked_up(const Pixels& pixels, const Eigen::Vector2f& uv) {
  const float x = (uv.x() - std::floor(uv.x())) * float(pixels.width) - 0.5F;
  const float y = (1 - (uv.y() - std::floor(uv.y()))) * float(pixels.height) - 0.5F;  // v runs up, rows run down
  const int left = int(std::floor(x));
  const int top = int(std::floor(y));
  const float across = x - float(left);
  const float down = y - float(top);
  return (1 - down) * ((1 - across) * texel(pixels, left, top) + across * texel(pixels, left + 1, top)) +
         down * ((1 - across) * texel(pixels, left, top + 1) + across * texel(pixels, left + 1, top + 1));
}

}  // namespace

const Pixels* TexturePictures::add(const SurfaceMaterial& material) {
  if (material.texture.empty()) return nullptr;
  for (const Entry& entry : entries_) {
    if (*entry.source == material.texture) return entry.pixels.get();
  }
  auto pixels = std::make_unique<Pixels>(decode_pixels(material.texture, "texture " + material.texture_name));
  return entries_.emplace_back(Entry{&material.texture, std::move(pixels)}).pixels.get();
}

SkinPaint::SkinPaint(const Skin& skin, const Vector3f& default_color, ColorMap map, TexturePictures& pictures)
    : skin_(skin) {
  for (int i = 0; i < kMapSteps; ++i) map_.push_back(linear(map_color(map, double(i) / (kMapSteps - 1))));
  if (skin.colors.rows() > 0) {
    for (const auto& corners : skin.triangles.rowwise()) {
      Eigen::Matrix3f& roots = roots_.emplace_back();
      for (int k = 0; k < 3; ++k) {
        roots.col(k) = linear(skin.colors.row(corners[k]).head<3>().transpose()).cwiseSqrt();
      }
    }
  }
  const Vector3f plain = roots_.empty() ? linear(default_color) : Vector3f::Ones().eval();
  for (const Part& part : skin.parts) {
    Paint paint{part.first_triangle, plain, nullptr};
    if (part.material >= 0) {
      const SurfaceMaterial& material = skin.materials[part.material];
      paint.color = linear(material.color.head<3>());
      if (skin.uvs.rows() > 0) paint.texture = pictures.add(material);
    }
    paints_.push_back(paint);
  }
  if (paints_.empty()) paints_.push_back({0, plain, nullptr});
}

Vector3f SkinPaint::mapped(float coordinate) const {
  constexpr float kLine = 0.74F * 0.74F;  // darker; the shaders take the square root of that
  const bool is_line = coordinate > 1.5F;
  const float place = std::clamp(is_line ? coordinate - 2 : coordinate, 0.0F, 1.0F) * (kMapSteps - 1);
  const int step = std::min(int(place), kMapSteps - 2);
  const float share = place - float(step);
  return (is_line ? kLine : 1.0F) * ((1 - share) * map_[step] + share * map_[step + 1]);
}

Vector3f SkinPaint::color(int triangle, const Vector3f& weights, const Eigen::VectorXf& map_coordinates) const {
  if (map_coordinates.size() > 0) {
    const Eigen::Vector3i corners = skin_.triangles.row(triangle);
    return mapped(weights.dot(Vector3f(map_coordinates[corners[0]], map_coordinates[corners[1]],  //
                                       map_coordinates[corners[2]])));
  }
  const auto after = std::upper_bound(paints_.begin() + 1, paints_.end(), triangle,
                                      [](int t, const Paint& paint) { return t < paint.first_triangle; });
  const Paint& paint = *std::prev(after);
  Vector3f color = paint.color;
  if (!roots_.empty()) {
    const Vector3f root = roots_[triangle] * weights;
    color = color.cwiseProduct(root.cwiseAbs2());
  }
  if (paint.texture == nullptr) return color;
  const Eigen::Vector3i corners = skin_.triangles.row(triangle);
  const Eigen::Vector2f uv = weights[0] * skin_.uvs.row(corners[0]) + weights[1] * skin_.uvs.row(corners[1]) +
                             weights[2] * skin_.uvs.row(corners[2]);
  return color.cwiseProduct(looked_up(*paint.texture, uv));
}

}  // namespace sprung
