#pragma once
#include <Eigen/Core>
#include <span>
#include <string>
#include <utility>

#include "render/gl/functions.h"

namespace sprung {

/// Owns the name of one OpenGL object. The context must be current when it is destroyed.
template <void (*Destroy)(const GlFunctions&, GLuint)>
class GlObject {
 public:
  GlObject() = default;
  GlObject(const GlFunctions& gl, GLuint name) : gl_(&gl), name_(name) {}
  GlObject(GlObject&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() {
    if (name_ != 0) Destroy(*gl_, name_);
  }
  [[nodiscard]] GLuint name() const { return name_; }

 private:
  const GlFunctions* gl_ = nullptr;
  GLuint name_ = 0;
};

namespace detail {
inline void delete_buffer(const GlFunctions& gl, GLuint name) { gl.DeleteBuffers(1, &name); }
inline void delete_texture(const GlFunctions& gl, GLuint name) { gl.DeleteTextures(1, &name); }
inline void delete_sampler(const GlFunctions& gl, GLuint name) { gl.DeleteSamplers(1, &name); }
inline void delete_vertex_array(const GlFunctions& gl, GLuint name) { gl.DeleteVertexArrays(1, &name); }
inline void delete_framebuffer(const GlFunctions& gl, GLuint name) { gl.DeleteFramebuffers(1, &name); }
inline void delete_program(const GlFunctions& gl, GLuint name) { gl.DeleteProgram(name); }
inline void delete_shader(const GlFunctions& gl, GLuint name) { gl.DeleteShader(name); }
}  // namespace detail

using GlBuffer = GlObject<detail::delete_buffer>;
using GlTexture = GlObject<detail::delete_texture>;
using GlSampler = GlObject<detail::delete_sampler>;
using GlVertexArray = GlObject<detail::delete_vertex_array>;
using GlFramebuffer = GlObject<detail::delete_framebuffer>;

[[nodiscard]] GlBuffer make_buffer(const GlFunctions& gl);
[[nodiscard]] GlVertexArray make_vertex_array(const GlFunctions& gl);
[[nodiscard]] GlFramebuffer make_framebuffer(const GlFunctions& gl);

/// How a texture is stored and sampled. GenerateMipmap makes the levels beyond the first.
struct TextureFormat {
  GLenum internal = GL_RGBA8;
  GLenum pixels = GL_RGBA;  // layout of the initial data
  GLenum type = GL_UNSIGNED_BYTE;
  bool mipmaps = false;
  bool linear = true;
  GLenum wrap = GL_CLAMP_TO_EDGE;
};
/// Leaves it bound to the active unit, with storage for mipmaps.
[[nodiscard]] GlTexture make_texture(const GlFunctions& gl, int width, int height, const TextureFormat& format,
                                     const void* data = nullptr);

/// A texture from levels of RGB floats, each half as large as the one before; stored in bytes unless `internal` says
/// otherwise. Repeats horizontally; sampled trilinearly.
[[nodiscard]] GlTexture make_level_texture(const GlFunctions& gl, int width, int height,
                                           std::span<const float* const> levels, GLenum internal = GL_RGBA8);

/// Samples a depth texture as a sampler2DShadow: the fraction of the four nearest texels that pass the comparison; of
/// the nearest level, if there are `mipmaps`.
[[nodiscard]] GlSampler make_comparing_sampler(const GlFunctions& gl, GLenum comparison, bool mipmaps = false);

/// Samples the nearest level of a texture.
[[nodiscard]] GlSampler make_level_sampler(const GlFunctions& gl);

/// A framebuffer with level 0 of these textures; null for none. Throws Error(kFailed) if it is incomplete.
[[nodiscard]] GlFramebuffer make_texture_target(const GlFunctions& gl, const GlTexture* color, const GlTexture* depth);
/// The same with several colour attachments, eight at most.
[[nodiscard]] GlFramebuffer make_colors_target(const GlFunctions& gl, std::span<const GlTexture* const> colors,
                                               const GlTexture& depth);

/// A linked program. set() needs it in use, and ignores uniforms that the compiler has removed.
class GlProgram {
 public:
  GlProgram() = default;
  /// Throws Error(kFailed) with `name` and the compiler's message.
  GlProgram(const GlFunctions& gl, const std::string& name, const std::string& vertex, const std::string& fragment);

  void use() const { gl_->UseProgram(program_.name()); }
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;
  void set(const char* name, const Eigen::Vector4f& value) const;
  void set(const char* name, const Eigen::Matrix4f& value) const;

 private:
  [[nodiscard]] GLint location(const char* name) const { return gl_->GetUniformLocation(program_.name(), name); }

  const GlFunctions* gl_ = nullptr;
  GlObject<detail::delete_program> program_;
};

/// Binds a texture to a unit, and a sampler that overrides its settings.
void bind_texture(const GlFunctions& gl, int unit, const GlTexture& texture, GLuint sampler = 0);

}  // namespace sprung
