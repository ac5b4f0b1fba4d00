#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "core/skin/skin.h"
#include "render/gl/objects.h"
#include "render/stage/coarse_triangles.h"
#include "render/stage/stage.h"
#include "render/stage/visible_sides.h"
#include "render/trace/vertex_light.h"

namespace sprung {

/// The textures of all skins, decoded and mipmapped, without duplicates.
class TextureSet {
 public:
  TextureSet(const GlFunctions& gl, ColorMap map);
  /// Index of the texture in the set; 0, a white one, for an empty picture. Throws Error(kBadInput) if the picture
  /// cannot be decoded.
  [[nodiscard]] int add(const SurfaceMaterial& material);
  [[nodiscard]] const GlTexture& color_map() const { return color_map_; }
  [[nodiscard]] const GlTexture& operator[](int index) const { return textures_[index]; }

 private:
  const GlFunctions& gl_;
  GlTexture color_map_;  // one row, square roots of linear light
  std::vector<GlTexture> textures_;
  std::vector<const std::vector<std::byte>*> sources_;
};

/// All triangles of a skin, fewer for blurred maps, or very few for very blurred ones.
enum class Detail { kFull, kCoarse, kCoarsest };
inline constexpr std::size_t kDetails = 3;

/// A program for a skin's parts with a texture, one for those without, and one for skins coloured by a map.
struct SkinPrograms {
  GlProgram plain;
  GlProgram textured;
  GlProgram mapped;
};
[[nodiscard]] SkinPrograms load_skin_programs(const GlFunctions& gl, std::string_view fragment,
                                              const std::string& defines = "");

/// A skin in buffers of OpenGL.
class SkinBuffers {
 public:
  SkinBuffers(const GlFunctions& gl, const Skin& skin, const Eigen::Vector3f& default_color, Look look, bool is_ghost,
              TextureSet& textures);

  void update(const SkinShape& shape);
  /// The vertices' positions one frame earlier and later, for programs that use them.
  void update_motion(const Floats3& before, const Floats3& after);
  /// `light`: n x 4, of vertices, as GatheredLight has it, for programs with GATHERED defined.
  void update_light(const VertexLight& light);
  /// The same for programs with THROUGH defined.
  void update_through(const ThroughLight& light);
  /// Draws with a program that needs positions only.
  void draw(Detail detail) const;
  /// Part by part; sets base_color and base_texture (unit `unit`) of the programs.
  void draw(const SkinPrograms& programs, const TextureSet& textures, int unit, Detail detail) const;
  [[nodiscard]] Sides sides() const { return sides_; }
  [[nodiscard]] bool is_ghost() const { return is_ghost_; }
  [[nodiscard]] bool casts_shadows() const { return !is_ghost_ && !is_faint_; }

 private:
  struct Range {  // of triangles in the index buffer
    int first = 0;
    int count = 0;
  };
  using Ranges = std::array<Range, kDetails>;
  struct Paint {
    Ranges ranges;
    Eigen::Vector3f color;  // square root of linear
    int texture = 0;
  };

  [[nodiscard]] bool upload_number(const GlBuffer& buffer, const Eigen::VectorXf& numbers, int attribute) const;
  void upload_light(const GlBuffer& buffer, const VertexLight& light, int attribute) const;
  void upload_indices(const std::array<const Triangles*, kDetails>& triangles);
  void upload_attributes(const Skin& skin);
  void add_paint(const Paint& paint);
  void use(const GlProgram& program, const GlTexture& texture, int unit) const;
  void draw(const Range& range) const;

  const GlFunctions& gl_;
  GlVertexArray array_;
  GlBuffer positions_;
  GlBuffer normals_;
  GlBuffer uvs_;
  GlBuffer colors_;
  GlBuffer map_coordinates_;
  GlBuffer opacities_;
  GlBuffer before_;  // positions
  GlBuffer after_;
  GlBuffer light_;
  GlBuffer through_;
  GlBuffer indices_;
  Ranges all_;
  Sides sides_;
  Look look_;
  bool is_ghost_;
  bool has_colors_ = false;
  bool is_mapped_ = false;
  bool is_faint_ = false;
  std::vector<Paint> paints_;
};

}  // namespace sprung
