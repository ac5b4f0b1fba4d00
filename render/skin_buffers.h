#pragma once
#include <vector>

#include "render/gl/objects.h"
#include "render/renderer.h"

namespace sprung {

/// The textures of all skins, each picture once, decoded and mipmapped.
class TextureSet {
 public:
  explicit TextureSet(const GlFunctions& gl);
  /// The texture's place in the set; 0, a white one, for an empty picture. Throws Error(kBadInput) where the picture
  /// cannot be decoded.
  [[nodiscard]] int add(const SurfaceMaterial& material);
  [[nodiscard]] const GlTexture& operator[](int index) const { return textures_[static_cast<std::size_t>(index)]; }

 private:
  const GlFunctions& gl_;
  std::vector<GlTexture> textures_;
  std::vector<const std::vector<std::byte>*> sources_;
};

/// A skin on the device.
class SkinBuffers {
 public:
  SkinBuffers(const GlFunctions& gl, const Skin& skin, const Eigen::Vector3f& default_color, TextureSet& textures);

  void update(const SkinShape& shape);
  /// All triangles, for a program that needs places only.
  void draw() const;
  /// Part by part, with base_color and base_texture (unit `unit`) of the program set.
  void draw(const GlProgram& program, const TextureSet& textures, int unit) const;

 private:
  struct Look {
    int first_triangle = 0;
    int triangle_count = 0;
    Eigen::Vector3f color;  // linear
    int texture = 0;
  };

  void upload_indices(const Skin& skin);
  void upload_attributes(const Skin& skin);
  void add_look(const Look& look);

  const GlFunctions& gl_;
  GlVertexArray array_;
  GlBuffer positions_;
  GlBuffer normals_;
  GlBuffer uvs_;
  GlBuffer colors_;
  GlBuffer indices_;
  int triangle_count_ = 0;
  bool has_colors_ = false;
  std::vector<Look> looks_;
};

}  // namespace sprung
