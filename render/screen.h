#pragma once
#include <optional>
#include <vector>

#include "render/backdrop.h"
#include "render/exposures.h"
#include "render/frame.h"
#include "render/gl/objects.h"
#include "render/light_maps.h"
#include "render/stage/environment.h"

namespace sprung {

/// An environment as textures and uniforms, for shaders with ENVIRONMENT defined.
class EnvironmentTexture {
 public:
  EnvironmentTexture(const GlFunctions& gl, const Environment& environment);
  /// Binds the texture to a unit and sets its uniforms.
  void bind(const GlProgram& program, int unit) const;

 private:
  const GlFunctions& gl_;
  std::array<Eigen::Vector3f, 9> irradiance_;
  float brightest_;
  GlTexture reflections_;
};

/// The contents of the pixels of a screen: colours; linear light; or, instead of red and green, the fraction of the key
/// light that reaches what is seen and the fraction of the sky that is open above it.
enum class ScreenOutput { kPicture, kLight, kShares };

/// The light that rays gather for the vertices of skins: none; the surrounding light; that, and light through
/// translucent bodies.
enum class Gathering { kNothing, kAround, kThrough };

/// Samples along each side of a pixel.
[[nodiscard]] constexpr int sample_side(int samples) { return samples == 16 ? 4 : samples == 4 ? 2 : 1; }

/// The number of turns in which the samples of an exposure are taken as bodies move.
inline constexpr int kTurns = 8;
inline constexpr int kAllTurns = -1;

/// The picture in the bound framebuffer.
[[nodiscard]] Image read_picture(const GlFunctions& gl, int width, int height, bool is_transparent);

/// Deferred shading of what a camera sees, given the light maps: first the skins' surface in every sample of every
/// pixel, then their light.
class Screen {
 public:
  /// Without an environment the studio lights it. Pictures with exposures hold light.
  Screen(const GlFunctions& gl, const RenderOptions& options, const Floor& floor,
         const std::optional<Environment>& environment, ScreenOutput output, Gathering gathering);
  void clear_surfaces() const;
  /// Draws in the samples of one turn, if the options ask for exposures, or in all.
  void draw_surfaces(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const View& view,
                     float min_opacity, int turn = kAllTurns) const;
  /// The picture, or one exposure of it.
  void draw_light(const LightMaps& maps, const View& view, DrawTimer& clock);
  /// For options that ask for exposures, whose parts add up to 1.
  void clear_exposures() const { exposures_.value().clear(); }
  void add_exposure(const LightMaps& maps, const View& view, double part) const;
  [[nodiscard]] Image read() const;
  /// Red, green, blue and opacity of every pixel, for outputs other than kPicture; colours are premultiplied.
  [[nodiscard]] std::vector<Eigen::Vector4f> read_numbers() const;
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] double aspect() const { return double(width_) / height_; }

 private:
  [[nodiscard]] GlTexture make_gathered(Gathering least) const;
  [[nodiscard]] GlFramebuffer make_surface() const;
  [[nodiscard]] GlProgram load(const char* fragment, const RenderOptions& options) const;
  void clear_picture(const Eigen::Vector4f& color) const;
  void show_backdrop(const View& view);
  void draw_floor(const LightMaps& maps, const View& view) const;
  void develop(const LightMaps& maps, const View& view, DrawTimer& clock) const;
  void cover(const GlProgram& program, const LightMaps& maps, const View& view) const;

  const GlFunctions& gl_;
  int width_;
  int height_;
  int side_;  // of a pixel, in samples
  bool is_transparent_;
  Gathering gathering_;
  ScreenOutput output_;
  GlTexture surface_color_;
  GlTexture surface_normal_;
  GlTexture surface_depth_;
  GlTexture surface_light_;    // if it is gathered
  GlTexture surface_through_;  // the same
  GlFramebuffer surface_;
  GlTexture picture_;  // top row first
  GlTexture kinds_;    // of pixels, as depths
  GlTexture circles_;  // of confusion, if pictures have exposures
  GlFramebuffer developed_;
  Backdrop backdrop_;
  std::optional<EnvironmentTexture> environment_;
  std::optional<Exposures> exposures_;
  GlFramebuffer circles_target_;
  GlSampler nearer_sampler_;
  GlVertexArray no_buffers_;
  SkinPrograms surface_programs_;
  GlProgram floor_program_;
  GlProgram kinds_program_;
  GlProgram circles_program_;
  GlProgram skins_program_;
};

}  // namespace sprung
