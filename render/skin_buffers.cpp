#include "render/skin_buffers.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "render/decode.h"
#include "render/shaders.h"

namespace sprung {

namespace {

enum Attribute : GLuint { kPosition, kNormal, kUv, kColor };  // as in surface.vert

float linear_from_srgb(float c) { return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F); }

/// The square root of linear light: what the shaders multiply and keep.
template <class Colors>
Colors root_from_srgb(const Colors& colors) {
  return colors.unaryExpr([](float c) { return std::sqrt(linear_from_srgb(c)); });
}

/// The cells that merge vertices for the light maps, as a part of the skin's radius: finer than their bias and blur.
constexpr double kCoarseCell = 0.04;

double coarse_cell(const Skin& skin) {
  const Vec3 sides = skin.positions.colwise().maxCoeff() - skin.positions.colwise().minCoeff();
  return std::max(0.5 * kCoarseCell * sides.norm(), 1e-12);
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

}  // namespace

TextureSet::TextureSet(const GlFunctions& gl) : gl_(gl) {
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
  return {load_program(gl, "surface.vert", fragment), load_program(gl, "surface.vert", fragment, "#define TEXTURED\n")};
}

SkinBuffers::SkinBuffers(const GlFunctions& gl, const Skin& skin, const Eigen::Vector3f& default_color,
                         TextureSet& textures)
    : gl_(gl),
      array_(make_vertex_array(gl)),
      positions_(make_buffer(gl)),
      normals_(make_buffer(gl)),
      uvs_(make_buffer(gl)),
      colors_(make_buffer(gl)),
      indices_(make_buffer(gl)),
      sides_(visible_sides(skin)),
      has_colors_(skin.colors.rows() > 0) {
  const CoarseTriangles coarse = coarse_triangles(skin, coarse_cell(skin));
  full_ = {0, static_cast<int>(skin.triangles.rows())};
  coarse_ = {full_.count, static_cast<int>(coarse.triangles.rows())};
  upload_indices(skin, coarse.triangles);
  upload_attributes(skin);
  const auto look = [&](int first, int count, const Eigen::Vector3f& color) {
    const int low = coarse.first[static_cast<std::size_t>(first)];
    const int high = coarse.first[static_cast<std::size_t>(first + count)];
    return Look{{first, count}, {coarse_.first + low, high - low}, color, 0};
  };
  const Eigen::Vector3f plain = has_colors_ ? Eigen::Vector3f::Ones().eval() : root_from_srgb(default_color);
  for (const Part& part : skin.parts) {
    Look next = look(part.first_triangle, part.triangle_count, plain);
    if (part.material >= 0) {
      const SurfaceMaterial& material = skin.materials[static_cast<std::size_t>(part.material)];
      next.color = root_from_srgb(material.color.head<3>().eval());
      if (skin.uvs.rows() > 0) next.texture = textures.add(material);
    }
    add_look(next);
  }
  if (skin.parts.empty()) add_look(look(0, full_.count, plain));
}

/// Neighbours that look the same are drawn together.
void SkinBuffers::add_look(const Look& look) {
  if (!looks_.empty()) {
    Look& last = looks_.back();
    if (last.texture == look.texture && last.color == look.color &&
        last.full.first + last.full.count == look.full.first) {
      last.full.count += look.full.count;
      last.coarse.count += look.coarse.count;
      return;
    }
  }
  looks_.push_back(look);
}

void SkinBuffers::upload_indices(const Skin& skin, const Triangles& coarse) {
  const auto bytes = [](const Triangles& triangles) {
    return static_cast<GLsizeiptr>(triangles.size() * static_cast<long>(sizeof(int)));
  };
  gl_.BindVertexArray(array_.name());
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, bytes(skin.triangles) + bytes(coarse), nullptr, GL_STATIC_DRAW);
  gl_.BufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, bytes(skin.triangles), skin.triangles.data());
  gl_.BufferSubData(GL_ELEMENT_ARRAY_BUFFER, bytes(skin.triangles), bytes(coarse), coarse.data());
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
}

void SkinBuffers::draw(const Range& range) const {
  const auto offset = static_cast<std::uintptr_t>(range.first) * 3 * sizeof(int);
  gl_.DrawElements(GL_TRIANGLES, 3 * range.count, GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr): OpenGL's way
}

void SkinBuffers::draw(Detail detail) const {
  gl_.BindVertexArray(array_.name());
  draw(detail == Detail::kFull ? full_ : coarse_);
}

void SkinBuffers::draw(const SkinPrograms& programs, const TextureSet& textures, int unit, Detail detail) const {
  gl_.BindVertexArray(array_.name());
  gl_.VertexAttrib4f(kUv, 0, 0, 0, 0);
  if (!has_colors_) gl_.VertexAttrib4f(kColor, 1, 1, 1, 1);
  for (const Look& look : looks_) {
    const GlProgram& program = look.texture == 0 ? programs.plain : programs.textured;
    program.use();
    program.set("base_color", look.color);
    program.set("base_texture", unit);
    bind_texture(gl_, unit, textures[look.texture]);
    draw(detail == Detail::kFull ? look.full : look.coarse);
  }
}

}  // namespace sprung
