#include "render/skin_buffers.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "render/decode.h"
#include "render/shaders.h"

namespace sprung {

namespace {

enum Attribute : GLuint { kPosition, kNormal, kUv, kColor, kShare };  // as in surface.vert

float linear_from_srgb(float c) { return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F); }

/// The square root of linear light: what the shaders multiply and keep.
template <class Colors>
Colors root_from_srgb(const Colors& colors) {
  return colors.unaryExpr([](float c) { return std::sqrt(linear_from_srgb(c)); });
}

/// The cells that merge vertices for the light maps, as a part of the skin's radius: finer than their bias and blur.
constexpr double kCoarseCell = 0.05;
constexpr double kCoarsestCell = 0.11;

/// Of the triangles: where fewer are left the skin is made of thin things, and is drawn as it is.
constexpr double kFewest = 0.01;

double radius(const Skin& skin) {
  const Vec3 sides = skin.positions.colwise().maxCoeff() - skin.positions.colwise().minCoeff();
  return 0.5 * sides.norm();
}

CoarseTriangles triangles_for_maps(const Skin& skin, double cell) {
  CoarseTriangles coarse = coarse_triangles(skin, std::max(cell * radius(skin), 1e-12));
  const auto all = static_cast<std::size_t>(skin.triangles.rows());
  if (static_cast<double>(coarse.triangles.rows()) >= kFewest * static_cast<double>(all)) return coarse;
  coarse.triangles = skin.triangles;
  coarse.first.resize(all + 1);
  std::iota(coarse.first.begin(), coarse.first.end(), 0);
  return coarse;
}

constexpr TextureFormat kPicture{GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, true, true, GL_REPEAT};

template <class Matrix>
void upload(const GlFunctions& gl, const GlBuffer& buffer, const Matrix& rows, GLenum usage) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer.name());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(rows.size() * static_cast<long>(sizeof(float))), rows.data(),
                usage);
}

void describe(const GlFunctions& gl, Attribute attribute, int components) {
  gl.EnableVertexAttribArray(attribute);
  gl.VertexAttribPointer(attribute, components, GL_FLOAT, GL_FALSE, 0, nullptr);
}

GlTexture make_color_map(const GlFunctions& gl, ColorMap map) {
  constexpr int kSteps = 256;
  Eigen::Matrix<float, 4, kSteps> colors = Eigen::Matrix<float, 4, kSteps>::Ones();
  for (int i = 0; i < kSteps; ++i) {
    colors.col(i).head<3>() = root_from_srgb(map_color(map, static_cast<double>(i) / (kSteps - 1)));
  }
  return make_texture(gl, kSteps, 1, {GL_RGBA8, GL_RGBA, GL_FLOAT, false, true, GL_CLAMP_TO_EDGE}, colors.data());
}

}  // namespace

TextureSet::TextureSet(const GlFunctions& gl, ColorMap map) : gl_(gl), color_map_(make_color_map(gl, map)) {
  const std::uint32_t white = 0xffffffffU;
  textures_.push_back(make_texture(gl, 1, 1, kPicture, &white));
  sources_.push_back(nullptr);
}

int TextureSet::add(const SurfaceMaterial& material) {
  if (material.texture.empty()) return 0;
  for (std::size_t i = 1; i < sources_.size(); ++i) {
    if (*sources_[i] == material.texture) return static_cast<int>(i);
  }
  const Pixels pixels = decode_pixels(material.texture, "texture " + material.texture_name);
  textures_.push_back(make_texture(gl_, pixels.width, pixels.height, kPicture, pixels.rgba.data()));
  sources_.push_back(&material.texture);
  return static_cast<int>(textures_.size()) - 1;
}

SkinPrograms load_skin_programs(const GlFunctions& gl, std::string_view fragment) {
  return {load_program(gl, "surface.vert", fragment), load_program(gl, "surface.vert", fragment, "#define TEXTURED\n"),
          load_program(gl, "surface.vert", fragment, "#define MAPPED\n")};
}

SkinBuffers::SkinBuffers(const GlFunctions& gl, const Skin& skin, const Eigen::Vector3f& default_color, Look look,
                         bool is_ghost, TextureSet& textures)
    : gl_(gl),
      array_(make_vertex_array(gl)),
      positions_(make_buffer(gl)),
      normals_(make_buffer(gl)),
      uvs_(make_buffer(gl)),
      colors_(make_buffer(gl)),
      shares_(make_buffer(gl)),
      indices_(make_buffer(gl)),
      sides_(visible_sides(skin)),
      look_(look),
      is_ghost_(is_ghost),
      has_colors_(skin.colors.rows() > 0) {
  const CoarseTriangles coarse = triangles_for_maps(skin, kCoarseCell);
  const CoarseTriangles coarsest = triangles_for_maps(skin, kCoarsestCell);
  upload_indices({&skin.triangles, &coarse.triangles, &coarsest.triangles});
  upload_attributes(skin);
  const auto fewer_of = [](const Range& all, const CoarseTriangles& fewer, int first, int count) {
    const int low = fewer.first[static_cast<std::size_t>(first)];
    return Range{all.first + low, fewer.first[static_cast<std::size_t>(first + count)] - low};
  };
  const auto paint = [&](int first, int count, const Eigen::Vector3f& color) {
    return Paint{{{{first, count}, fewer_of(all_[1], coarse, first, count), fewer_of(all_[2], coarsest, first, count)}},
                 color,
                 0};
  };
  const Eigen::Vector3f plain = has_colors_ ? Eigen::Vector3f::Ones().eval() : root_from_srgb(default_color);
  for (const Part& part : skin.parts) {
    Paint next = paint(part.first_triangle, part.triangle_count, plain);
    if (part.material >= 0) {
      const SurfaceMaterial& material = skin.materials[static_cast<std::size_t>(part.material)];
      next.color = root_from_srgb(material.color.head<3>().eval());
      if (skin.uvs.rows() > 0) next.texture = textures.add(material);
    }
    add_paint(next);
  }
  if (skin.parts.empty()) add_paint(paint(0, all_[0].count, plain));
}

/// Neighbours that look the same are drawn together.
void SkinBuffers::add_paint(const Paint& paint) {
  if (!paints_.empty()) {
    Paint& last = paints_.back();
    const Range& before = last.ranges.front();
    if (last.texture == paint.texture && last.color == paint.color &&
        before.first + before.count == paint.ranges.front().first) {
      for (std::size_t i = 0; i < kDetails; ++i) last.ranges[i].count += paint.ranges[i].count;
      return;
    }
  }
  paints_.push_back(paint);
}

/// One after another.
void SkinBuffers::upload_indices(const std::array<const Triangles*, kDetails>& triangles) {
  constexpr auto kBytes = static_cast<GLsizeiptr>(3 * sizeof(int));
  int count = 0;
  for (std::size_t i = 0; i < kDetails; ++i) {
    all_[i] = {count, static_cast<int>(triangles[i]->rows())};
    count += all_[i].count;
  }
  gl_.BindVertexArray(array_.name());
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, kBytes * count, nullptr, GL_STATIC_DRAW);
  for (std::size_t i = 0; i < kDetails; ++i) {
    gl_.BufferSubData(GL_ELEMENT_ARRAY_BUFFER, kBytes * all_[i].first, kBytes * all_[i].count, triangles[i]->data());
  }
}

void SkinBuffers::upload_attributes(const Skin& skin) {
  gl_.BindBuffer(GL_ARRAY_BUFFER, positions_.name());
  describe(gl_, kPosition, 3);
  gl_.BindBuffer(GL_ARRAY_BUFFER, normals_.name());
  describe(gl_, kNormal, 3);
  if (skin.uvs.rows() > 0) {
    upload(gl_, uvs_, skin.uvs, GL_STATIC_DRAW);
    describe(gl_, kUv, 2);
  }
  if (has_colors_) {
    upload(gl_, colors_, root_from_srgb(skin.colors), GL_STATIC_DRAW);
    describe(gl_, kColor, 4);
  }
}

void SkinBuffers::update(const SkinShape& shape) {
  assert(shape.positions.rows() == shape.normals.rows());
  upload(gl_, positions_, shape.positions, GL_STREAM_DRAW);
  upload(gl_, normals_, shape.normals, GL_STREAM_DRAW);
  is_mapped_ = shape.shares.size() > 0;
  if (!is_mapped_) return;
  assert(shape.positions.rows() == shape.shares.rows());
  gl_.BindVertexArray(array_.name());
  upload(gl_, shares_, shape.shares, GL_STREAM_DRAW);
  describe(gl_, kShare, 1);
}

void SkinBuffers::draw(const Range& range) const {
  const auto offset = static_cast<std::uintptr_t>(range.first) * 3 * sizeof(int);
  gl_.DrawElements(GL_TRIANGLES, 3 * range.count, GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr): OpenGL's way
}

void SkinBuffers::draw(Detail detail) const {
  gl_.BindVertexArray(array_.name());
  draw(all_[static_cast<std::size_t>(detail)]);
}

void SkinBuffers::use(const GlProgram& program, const GlTexture& texture, int unit) const {
  program.use();
  program.set("look", static_cast<float>(look_));
  program.set("base_texture", unit);
  bind_texture(gl_, unit, texture);
}

void SkinBuffers::draw(const SkinPrograms& programs, const TextureSet& textures, int unit, Detail detail) const {
  gl_.BindVertexArray(array_.name());
  gl_.VertexAttrib4f(kUv, 0, 0, 0, 0);
  if (!has_colors_) gl_.VertexAttrib4f(kColor, 1, 1, 1, 1);
  if (is_mapped_) {
    use(programs.mapped, textures.color_map(), unit);
    draw(all_[static_cast<std::size_t>(detail)]);
    return;
  }
  for (const Paint& paint : paints_) {
    const GlProgram& program = paint.texture == 0 ? programs.plain : programs.textured;
    use(program, textures[paint.texture], unit);
    program.set("base_color", paint.color);
    draw(paint.ranges[static_cast<std::size_t>(detail)]);
  }
}

}  // namespace sprung
