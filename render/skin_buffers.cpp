#include "render/skin_buffers.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/appearance.h"
#include "core/io/decode_image.h"
#include "render/shaders.h"

namespace sprung {
namespace {

enum Attribute : GLuint {
  kPosition,
  kNormal,
  kUv,
  kColor,
  kMapCoordinate,
  kBefore,
  kAfter,
  kLight,
  kThrough,
  kOpacity
};  // as in surface.vert and passes.vert

/// The square root of linear light: what the shaders multiply and keep.
template <class Colors>
Colors root_from_srgb(const Colors& colors) {
  return colors.unaryExpr([](float c) { return std::sqrt(linear_from_srgb(c)); });
}

/// Sides of the cells that merge vertices for the light maps, over the skin's radius: finer than the maps' bias and
/// blur.
constexpr double kCoarseCell = 0.05;
constexpr double kCoarsestCell = 0.11;

constexpr TextureFormat kPicture{GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, true, true, GL_REPEAT};

template <class Matrix>
void upload(const GlFunctions& gl, const GlBuffer& buffer, const Matrix& rows, GLenum usage) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer.name());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(rows.size() * long(sizeof(typename Matrix::Scalar))),
                rows.data(), usage);
}

void describe(const GlFunctions& gl, Attribute attribute, int components) {
  gl.EnableVertexAttribArray(attribute);
  gl.VertexAttribPointer(attribute, components, GL_FLOAT, GL_FALSE, 0, nullptr);
}

GlTexture make_color_map(const GlFunctions& gl, ColorMap map) {
  constexpr int kSteps = 256;
  Eigen::Matrix<float, 4, kSteps> colors = Eigen::Matrix<float, 4, kSteps>::Ones();
  for (int i = 0; i < kSteps; ++i) {
    colors.col(i).head<3>() = root_from_srgb(map_color(map, double(i) / (kSteps - 1)));
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
    if (*sources_[i] == material.texture) return int(i);
  }
  const Pixels pixels = decode_pixels(material.texture, "texture " + material.texture_name);
  textures_.push_back(make_texture(gl_, pixels.width, pixels.height, kPicture, pixels.rgba.data()));
  sources_.push_back(&material.texture);
  return isize(textures_) - 1;
}

SkinPrograms load_skin_programs(const GlFunctions& gl, std::string_view fragment, const std::string& defines) {
  return {load_program(gl, "surface.vert", fragment, defines),
          load_program(gl, "surface.vert", fragment, defines + "#define TEXTURED\n"),
          load_program(gl, "surface.vert", fragment, defines + "#define MAPPED\n")};
}

SkinBuffers::SkinBuffers(const GlFunctions& gl, const Skin& skin, const Eigen::Vector3f& default_color, Look look,
                         bool is_ghost, TextureSet& textures)
    : gl_(gl),
      array_(make_vertex_array(gl)),
      positions_(make_buffer(gl)),
      normals_(make_buffer(gl)),
      uvs_(make_buffer(gl)),
      colors_(make_buffer(gl)),
      map_coordinates_(make_buffer(gl)),
      opacities_(make_buffer(gl)),
      before_(make_buffer(gl)),
      after_(make_buffer(gl)),
      light_(make_buffer(gl)),
      through_(make_buffer(gl)),
      indices_(make_buffer(gl)),
      sides_(visible_sides(skin)),
      look_(look),
      is_ghost_(is_ghost),
      has_colors_(skin.colors.rows() > 0) {
  const double radius = skin_radius(skin);
  const CoarseTriangles coarse = coarse_or_all_triangles(skin, kCoarseCell * radius);
  const CoarseTriangles coarsest = coarse_or_all_triangles(skin, kCoarsestCell * radius);
  upload_indices({&skin.triangles, &coarse.triangles, &coarsest.triangles});
  upload_attributes(skin);
  const auto fewer_of = [](const Range& all, const CoarseTriangles& fewer, int first, int count) {
    const int low = fewer.first[first];
    return Range{all.first + low, fewer.first[first + count] - low};
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
      const SurfaceMaterial& material = skin.materials[part.material];
      next.color = root_from_srgb(material.color.head<3>().eval());
      if (skin.uvs.rows() > 0) next.texture = textures.add(material);
    }
    add_paint(next);
  }
  if (skin.parts.empty()) add_paint(paint(0, all_[0].count, plain));
}

/// Merges consecutive parts that look the same.
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
    all_[i] = {count, int(triangles[i]->rows())};
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
  is_mapped_ = upload_number(map_coordinates_, shape.map_coordinates, kMapCoordinate);
  is_faint_ = upload_number(opacities_, shape.opacities, kOpacity);
  assert(!is_mapped_ || shape.positions.rows() == shape.map_coordinates.rows());
  assert(!is_faint_ || shape.positions.rows() == shape.opacities.rows());
}

/// One number per vertex, or none; returns whether there are any.
bool SkinBuffers::upload_number(const GlBuffer& buffer, const Eigen::VectorXf& numbers, int attribute) const {
  if (numbers.size() == 0) return false;
  gl_.BindVertexArray(array_.name());
  upload(gl_, buffer, numbers, GL_STREAM_DRAW);
  describe(gl_, Attribute(attribute), 1);
  return true;
}

void SkinBuffers::update_motion(const Floats3& before, const Floats3& after) {
  gl_.BindVertexArray(array_.name());
  upload(gl_, before_, before, GL_STREAM_DRAW);
  describe(gl_, kBefore, 3);
  upload(gl_, after_, after, GL_STREAM_DRAW);
  describe(gl_, kAfter, 3);
}

void SkinBuffers::upload_light(const GlBuffer& buffer, const VertexLight& light, int attribute) const {
  gl_.BindVertexArray(array_.name());
  upload(gl_, buffer, light, GL_STREAM_DRAW);
  gl_.EnableVertexAttribArray(GLuint(attribute));
  gl_.VertexAttribPointer(GLuint(attribute), 4, GL_UNSIGNED_SHORT, GL_TRUE, 0, nullptr);
}

void SkinBuffers::update_light(const VertexLight& light) { upload_light(light_, light, kLight); }

void SkinBuffers::update_through(const ThroughLight& light) { upload_light(through_, light, kThrough); }

void SkinBuffers::draw(const Range& range) const {
  const auto offset = static_cast<std::uintptr_t>(range.first) * 3 * sizeof(int);
  gl_.DrawElements(GL_TRIANGLES, 3 * range.count, GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr): OpenGL's way
}

void SkinBuffers::draw(Detail detail) const {
  gl_.BindVertexArray(array_.name());
  draw(all_[std::size_t(detail)]);
}

void SkinBuffers::use(const GlProgram& program, const GlTexture& texture, int unit) const {
  program.use();
  program.set("look", float(look_));
  program.set("base_texture", unit);
  bind_texture(gl_, unit, texture);
}

void SkinBuffers::draw(const SkinPrograms& programs, const TextureSet& textures, int unit, Detail detail) const {
  gl_.BindVertexArray(array_.name());
  gl_.VertexAttrib4f(kUv, 0, 0, 0, 0);
  if (!has_colors_) gl_.VertexAttrib4f(kColor, 1, 1, 1, 1);
  if (!is_faint_) gl_.VertexAttrib4f(kOpacity, 1, 1, 1, 1);
  if (is_mapped_) {
    use(programs.mapped, textures.color_map(), unit);
    draw(all_[std::size_t(detail)]);
    return;
  }
  for (const Paint& paint : paints_) {
    const GlProgram& program = paint.texture == 0 ? programs.plain : programs.textured;
    use(program, textures[paint.texture], unit);
    program.set("base_color", paint.color);
    draw(paint.ranges[std::size_t(detail)]);
  }
}

}  // namespace sprung
