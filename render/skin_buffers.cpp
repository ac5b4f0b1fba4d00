#include "render/skin_buffers.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "render/decode.h"

namespace sprung {

namespace {

enum Attribute : GLuint { kPosition, kNormal, kUv, kColor };  // as in skin.vert

float linear_from_srgb(float c) { return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F); }

Eigen::Vector3f linear_from_srgb(const Eigen::Vector3f& color) {
  return color.unaryExpr([](float c) { return linear_from_srgb(c); });
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

SkinBuffers::SkinBuffers(const GlFunctions& gl, const Skin& skin, const Eigen::Vector3f& default_color,
                         TextureSet& textures)
    : gl_(gl),
      array_(make_vertex_array(gl)),
      positions_(make_buffer(gl)),
      normals_(make_buffer(gl)),
      uvs_(make_buffer(gl)),
      colors_(make_buffer(gl)),
      indices_(make_buffer(gl)),
      triangle_count_(static_cast<int>(skin.triangles.rows())),
      has_colors_(skin.colors.rows() > 0) {
  upload_indices(skin);
  upload_attributes(skin);
  const Eigen::Vector3f plain = has_colors_ ? Eigen::Vector3f::Ones().eval() : linear_from_srgb(default_color);
  for (const Part& part : skin.parts) {
    Look look{part.first_triangle, part.triangle_count, plain, 0};
    if (part.material >= 0) {
      const SurfaceMaterial& material = skin.materials[static_cast<std::size_t>(part.material)];
      look.color = linear_from_srgb(material.color.head<3>().eval());
      if (skin.uvs.rows() > 0) look.texture = textures.add(material);
    }
    add_look(look);
  }
  if (skin.parts.empty()) add_look({0, triangle_count_, plain, 0});
}

/// Neighbours that look the same are drawn together.
void SkinBuffers::add_look(const Look& look) {
  if (!looks_.empty()) {
    Look& last = looks_.back();
    if (last.texture == look.texture && last.color == look.color &&
        last.first_triangle + last.triangle_count == look.first_triangle) {
      last.triangle_count += look.triangle_count;
      return;
    }
  }
  looks_.push_back(look);
}

void SkinBuffers::upload_indices(const Skin& skin) {
  gl_.BindVertexArray(array_.name());
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(skin.triangles.size() * static_cast<long>(sizeof(int))), skin.triangles.data(),
                 GL_STATIC_DRAW);
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
    upload(gl_, colors_, skin.colors, GL_STATIC_DRAW);
    describe(gl_, kColor, 4);
  }
}

void SkinBuffers::update(const SkinShape& shape) {
  assert(shape.positions.rows() == shape.normals.rows());
  upload(gl_, positions_, shape.positions, GL_STREAM_DRAW);
  upload(gl_, normals_, shape.normals, GL_STREAM_DRAW);
}

void SkinBuffers::draw() const {
  gl_.BindVertexArray(array_.name());
  gl_.DrawElements(GL_TRIANGLES, 3 * triangle_count_, GL_UNSIGNED_INT, nullptr);
}

void SkinBuffers::draw(const GlProgram& program, const TextureSet& textures, int unit) const {
  gl_.BindVertexArray(array_.name());
  gl_.VertexAttrib4f(kUv, 0, 0, 0, 0);
  if (!has_colors_) gl_.VertexAttrib4f(kColor, 1, 1, 1, 1);
  program.set("base_texture", unit);
  for (const Look& look : looks_) {
    program.set("base_color", look.color);
    bind_texture(gl_, unit, textures[look.texture]);
    const auto offset = static_cast<std::uintptr_t>(look.first_triangle) * 3 * sizeof(int);
    gl_.DrawElements(GL_TRIANGLES, 3 * look.triangle_count, GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr): OpenGL's way
  }
}

}  // namespace sprung
