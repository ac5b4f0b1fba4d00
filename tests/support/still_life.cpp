#include "tests/support/still_life.h"

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <utility>

#include "render/image/png.h"
#include "tests/support/temp_folder.h"

namespace sprung {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A grid of columns x rows cells over (u, v) in [0, 1]^2, with positions and normals from the two functions.
Skin make_grid(int columns, int rows, const std::function<Vec3(double, double)>& place,
               const std::function<Vec3(double, double)>& normal) {
  Skin skin;
  const int count = (columns + 1) * (rows + 1);
  skin.positions.resize(count, 3);
  skin.normals.resize(count, 3);
  skin.uvs.resize(count, 2);
  skin.triangles.resize(2 * columns * rows, 3);
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      const int vertex = i * (rows + 1) + j;
      const double u = double(i) / columns;
      const double v = double(j) / rows;
      skin.positions.row(vertex) = place(u, v).transpose();
      skin.normals.row(vertex) = normal(u, v).transpose();
      skin.uvs.row(vertex) << float(u), float(v);
    }
  }
  int triangle = 0;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const int a = i * (rows + 1) + j;
      const int b = a + rows + 1;
      skin.triangles.row(triangle++) << a, b, b + 1;
      skin.triangles.row(triangle++) << a, b + 1, a + 1;
    }
  }
  return skin;
}

}  // namespace

Skin make_sphere_skin(const Vec3& center, double radius) {
  const auto normal = [](double u, double v) {
    const double ring = std::sin(0.5 * kTurn * v);
    return Vec3(ring * std::sin(kTurn * u), -std::cos(0.5 * kTurn * v), ring * std::cos(kTurn * u));
  };
  return make_grid(
      48, 24, [&](double u, double v) { return Vec3(center + radius * normal(u, v)); }, normal);
}

Skin make_ring_skin(const Vec3& center, double radius, double thickness) {
  const auto normal = [](double u, double v) {
    return Vec3(std::cos(kTurn * v) * std::sin(kTurn * u), std::sin(kTurn * v),
                std::cos(kTurn * v) * std::cos(kTurn * u));
  };
  const auto place = [&](double u, double v) {
    const Vec3 spine(std::sin(kTurn * u), 0, std::cos(kTurn * u));
    return Vec3(center + radius * spine + thickness * normal(u, v));
  };
  return make_grid(64, 24, place, normal);
}

Skin make_box_skin(const Vec3& low, const Vec3& high) {
  Skin skin;
  skin.positions.resize(24, 3);
  skin.normals.resize(24, 3);
  skin.uvs.resize(24, 2);
  skin.triangles.resize(12, 3);
  // Outward normal, and the direction of v; u follows to the right, seen from outside.
  const std::array<std::pair<Vec3, Vec3>, 6> sides{{{Vec3::UnitX(), Vec3::UnitY()},
                                                    {-Vec3::UnitX(), Vec3::UnitY()},
                                                    {Vec3::UnitZ(), Vec3::UnitY()},
                                                    {-Vec3::UnitZ(), Vec3::UnitY()},
                                                    {Vec3::UnitY(), -Vec3::UnitZ()},
                                                    {-Vec3::UnitY(), Vec3::UnitZ()}}};
  const Vec3 middle = 0.5 * (low + high);
  const Vec3 half = 0.5 * (high - low);
  for (int s = 0; s < 6; ++s) {
    const auto& [normal, up] = sides[s];
    const Vec3 right = up.cross(normal);
    for (int corner = 0; corner < 4; ++corner) {
      const int u = corner & 1;
      const int v = corner >> 1;
      const int vertex = 4 * s + corner;
      skin.positions.row(vertex) =
          (middle + half.cwiseProduct(normal + (2 * u - 1) * right + (2 * v - 1) * up)).transpose();
      skin.normals.row(vertex) = normal.transpose();
      skin.uvs.row(vertex) << float(u), float(v);
    }
    skin.triangles.row(2 * s) << 4 * s, 4 * s + 1, 4 * s + 3;
    skin.triangles.row(2 * s + 1) << 4 * s, 4 * s + 3, 4 * s + 2;
  }
  return skin;
}

Skin refined(Skin skin, double max_edge) {
  refine(skin, max_edge);
  return skin;
}

void set_texture(Skin& skin, const Image& picture) {
  const TempFolder folder;
  write_png(picture, folder.path() / "texture.png");
  std::ifstream in(folder.path() / "texture.png", std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  SurfaceMaterial material;
  material.color = {1, 1, 1, 1};
  material.texture.resize(bytes.size());
  std::memcpy(material.texture.data(), bytes.data(), bytes.size());
  skin.materials = {material};
  skin.parts = {{"all", 0, int(skin.triangles.rows()), 0}};
}

void StillLife::add(Skin skin, const Eigen::Vector3f& color) {
  skins.push_back(std::move(skin));
  colors.push_back(color);
}

Stage StillLife::stage() const {
  Stage stage;
  for (const Skin& skin : skins) {
    stage.skins.push_back(&skin);
    stage.bounds.extend(bounding_box(skin.positions));
  }
  stage.default_colors = colors;
  stage.has_ground = has_ground;
  return stage;
}

std::vector<SkinShape> StillLife::shapes() const {
  std::vector<SkinShape> shapes;
  for (const Skin& skin : skins) shapes.push_back({skin.positions.cast<float>(), skin.normals.cast<float>()});
  return shapes;
}

StillLife StillLife::scaled(double factor) const {
  StillLife scene = *this;
  for (Skin& skin : scene.skins) skin.positions *= factor;
  return scene;
}

StillLife ball_on_ground() {
  StillLife scene;
  scene.add(make_sphere_skin({0, 0.5, 0}, 0.5), kRed);
  return scene;
}

Image draw_scene(const StillLife& scene, const RenderOptions& options, double azimuth, double elevation) {
  const Stage stage = scene.stage();
  Renderer renderer(stage, options);
  const double aspect = double(options.width) / options.height;
  return renderer.draw(scene.shapes(), frame_bounds(stage.bounds, aspect, azimuth, elevation));
}

Eigen::Vector3d pixel(const Image& image, int x, int y) {
  const auto at = 3 * std::size_t(y * image.width + x);
  return {double(image.pixels[at]), double(image.pixels[at + 1]), double(image.pixels[at + 2])};
}

}  // namespace sprung
