#include "render/map_brush.h"

#include <array>

#include "render/shaders.h"

namespace sprung {

namespace {

/// Nothing beyond the map.
void set_border(const GlFunctions& gl) {
  const std::array<float, 4> border{};
  gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border.data());
}

}  // namespace

MapBrush::MapBrush(const GlFunctions& gl)
    : gl_(gl),
      no_buffers_(make_vertex_array(gl)),
      depth_program_(load_program(gl, "depth.vert", "depth.frag")),
      blur_program_(load_program(gl, "screen.vert", "blur.frag")) {}

LightMap MapBrush::make_map(int size, const TextureFormat* color, bool depth) const {
  LightMap map;
  map.size = size;
  if (color != nullptr) {
    map.color = make_texture(gl_, size, size, *color);
    set_border(gl_);
  }
  if (depth) map.depth = make_texture(gl_, size, size, map_format::kDepth);
  map.target = make_texture_target(gl_, color != nullptr ? &map.color : nullptr, depth ? &map.depth : nullptr);
  return map;
}

void MapBrush::fill(const LightMap& map) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, map.target.name());
  gl_.Viewport(0, 0, map.size, map.size);
  gl_.BindVertexArray(no_buffers_.name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void MapBrush::clear(const LightMap& map) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, map.target.name());
  gl_.Viewport(0, 0, map.size, map.size);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void MapBrush::make_mipmaps(const GlTexture& texture) const {
  bind_texture(gl_, 0, texture);
  gl_.GenerateMipmap(GL_TEXTURE_2D);
}

void MapBrush::blur(const LightMap& from, const LightMap& pass, const LightMap& to,
                    const Eigen::Vector2f& reach) const {
  blur_program_.use();
  blur_program_.set("source", 0);
  bind_texture(gl_, 0, from.color);
  blur_program_.set("reach", Eigen::Vector2f(reach.x(), 0));
  fill(pass);
  bind_texture(gl_, 0, pass.color);
  blur_program_.set("reach", Eigen::Vector2f(0, reach.y()));
  fill(to);
}

void MapBrush::draw_depth(const LightMap& map, const LightView& view, const std::vector<SkinBuffers>& skins,
                          Detail detail, const DrawFrame& frame) const {
  clear(map);
  depth_program_.use();
  frame.set_common(depth_program_);
  depth_program_.set("clip_from_stage", view.clip_from_stage.cast<float>().eval());
  for (const SkinBuffers& skin : skins) {
    if (!skin.is_ghost()) skin.draw(detail);
  }
}

}  // namespace sprung
