#include "render/gl/objects.h"

#include <array>

#include "core/error.h"

namespace sprung {

GlBuffer make_buffer(const GlFunctions& gl) {
  GLuint name = 0;
  gl.GenBuffers(1, &name);
  return {gl, name};
}

GlVertexArray make_vertex_array(const GlFunctions& gl) {
  GLuint name = 0;
  gl.GenVertexArrays(1, &name);
  return {gl, name};
}

GlFramebuffer make_framebuffer(const GlFunctions& gl) {
  GLuint name = 0;
  gl.GenFramebuffers(1, &name);
  return {gl, name};
}

GlTexture make_texture(const GlFunctions& gl, int width, int height, const TextureFormat& format, const void* data) {
  GLuint name = 0;
  gl.GenTextures(1, &name);
  GlTexture texture(gl, name);
  gl.BindTexture(GL_TEXTURE_2D, name);
  gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal), width, height, 0, format.pixels, format.type,
                data);
  const auto set = [&gl](GLenum key, GLint value) { gl.TexParameteri(GL_TEXTURE_2D, key, value); };
  const GLint near = format.linear ? GL_LINEAR : GL_NEAREST;
  set(GL_TEXTURE_MAG_FILTER, near);
  set(GL_TEXTURE_MIN_FILTER, format.mipmaps ? GL_LINEAR_MIPMAP_NEAREST : near);
  set(GL_TEXTURE_WRAP_S, static_cast<GLint>(format.wrap));
  set(GL_TEXTURE_WRAP_T, static_cast<GLint>(format.wrap));
  if (format.mipmaps) gl.GenerateMipmap(GL_TEXTURE_2D);
  return texture;
}

GlTexture make_level_texture(const GlFunctions& gl, int width, int height, std::span<const float* const> levels,
                             GLenum internal) {
  GLuint name = 0;
  gl.GenTextures(1, &name);
  GlTexture texture(gl, name);
  gl.BindTexture(GL_TEXTURE_2D, name);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    gl.TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), static_cast<GLint>(internal), width >> i, height >> i, 0,
                  GL_RGB, GL_FLOAT, levels[i]);
  }
  const auto set = [&gl](GLenum key, GLint value) { gl.TexParameteri(GL_TEXTURE_2D, key, value); };
  set(GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(levels.size()) - 1);
  set(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  set(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  set(GL_TEXTURE_WRAP_S, GL_REPEAT);
  set(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

namespace {

void set(const GlFunctions& gl, const GlSampler& sampler, GLenum key, GLenum value) {
  gl.SamplerParameteri(sampler.name(), key, static_cast<GLint>(value));
}

GlSampler make_sampler(const GlFunctions& gl, GLenum smaller) {
  GLuint name = 0;
  gl.GenSamplers(1, &name);
  GlSampler sampler(gl, name);
  set(gl, sampler, GL_TEXTURE_MIN_FILTER, smaller);
  set(gl, sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum side : {GLenum{GL_TEXTURE_WRAP_S}, GLenum{GL_TEXTURE_WRAP_T}}) {
    set(gl, sampler, side, GL_CLAMP_TO_EDGE);
  }
  return sampler;
}

}  // namespace

GlSampler make_level_sampler(const GlFunctions& gl) { return make_sampler(gl, GL_LINEAR_MIPMAP_NEAREST); }

GlSampler make_comparing_sampler(const GlFunctions& gl, GLenum comparison, bool mipmaps) {
  GlSampler sampler = make_sampler(gl, mipmaps ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR);
  set(gl, sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  set(gl, sampler, GL_TEXTURE_COMPARE_FUNC, comparison);
  return sampler;
}

namespace {

void check_framebuffer(const GlFunctions& gl, const char* what) {
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  throw Error(ErrorKind::kFailed, std::string("OpenGL: no memory or no support for ") + what);
}

}  // namespace

GlFramebuffer make_texture_target(const GlFunctions& gl, const GlTexture* color, const GlTexture* depth) {
  GlFramebuffer target = make_framebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.name());
  if (color != nullptr) {
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color->name(), 0);
  } else {
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
  }
  if (depth != nullptr) gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth->name(), 0);
  check_framebuffer(gl, "a light map");
  return target;
}

GlFramebuffer make_colors_target(const GlFunctions& gl, std::span<const GlTexture* const> colors,
                                 const GlTexture& depth) {
  GlFramebuffer target = make_framebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.name());
  std::vector<GLenum> outputs;
  for (const GlTexture* color : colors) {
    outputs.push_back(GL_COLOR_ATTACHMENT0 + GLenum(outputs.size()));
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, outputs.back(), GL_TEXTURE_2D, color->name(), 0);
  }
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth.name(), 0);
  gl.DrawBuffers(GLsizei(outputs.size()), outputs.data());
  check_framebuffer(gl, "a picture of this size");
  return target;
}

namespace {

using GlShader = GlObject<detail::delete_shader>;

GlShader compile(const GlFunctions& gl, const std::string& name, GLenum stage, const std::string& source) {
  GlShader shader(gl, gl.CreateShader(stage));
  const char* text = source.c_str();
  gl.ShaderSource(shader.name(), 1, &text, nullptr);
  gl.CompileShader(shader.name());
  GLint done = 0;
  gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &done);
  if (done != 0) return shader;
  std::array<char, 2048> log{};
  gl.GetShaderInfoLog(shader.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw Error(ErrorKind::kFailed, "shader " + name + ": " + log.data());
}

}  // namespace

GlProgram::GlProgram(const GlFunctions& gl, const std::string& name, const std::string& vertex,
                     const std::string& fragment)
    : gl_(&gl), program_(gl, gl.CreateProgram()) {
  const GlShader vertex_shader = compile(gl, name + " (vertex)", GL_VERTEX_SHADER, vertex);
  const GlShader fragment_shader = compile(gl, name + " (fragment)", GL_FRAGMENT_SHADER, fragment);
  gl.AttachShader(program_.name(), vertex_shader.name());
  gl.AttachShader(program_.name(), fragment_shader.name());
  gl.LinkProgram(program_.name());
  GLint done = 0;
  gl.GetProgramiv(program_.name(), GL_LINK_STATUS, &done);
  if (done != 0) return;
  std::array<char, 2048> log{};
  gl.GetProgramInfoLog(program_.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw Error(ErrorKind::kFailed, "shader " + name + ": " + log.data());
}

void GlProgram::set(const char* name, int value) const { gl_->Uniform1i(location(name), value); }
void GlProgram::set(const char* name, float value) const { gl_->Uniform1f(location(name), value); }
void GlProgram::set(const char* name, const Eigen::Vector2f& value) const {
  gl_->Uniform2f(location(name), value.x(), value.y());
}
void GlProgram::set(const char* name, const Eigen::Vector3f& value) const {
  gl_->Uniform3f(location(name), value.x(), value.y(), value.z());
}
void GlProgram::set(const char* name, const Eigen::Vector4f& value) const {
  gl_->Uniform4f(location(name), value.x(), value.y(), value.z(), value.w());
}
void GlProgram::set(const char* name, const Eigen::Matrix4f& value) const {
  gl_->UniformMatrix4fv(location(name), 1, GL_FALSE, value.data());
}

void bind_texture(const GlFunctions& gl, int unit, const GlTexture& texture, GLuint sampler) {
  gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.BindSampler(static_cast<GLuint>(unit), sampler);
}

}  // namespace sprung
