#pragma once
#include <Eigen/Core>
#include <array>

#include "core/appearance.h"

namespace sprung {

/// How a surface reflects light from one direction: factors of its radiance, with the cosine and, if the direction was
/// sampled, one over its density.
struct Reflected {
  Eigen::Vector3f base = Eigen::Vector3f::Zero();  // by the base, as if it were white
  Eigen::Vector3f specular = Eigen::Vector3f::Zero();
};

/// The response of a surface to light from one direction.
struct Response {
  Reflected reflected{};
  float density = 0;  // of Finish::sample() over the solid angle
};

/// How surfaces of a look scatter light: a rough specular layer (GGX with Smith's shadowing, Schlick's Fresnel term)
/// over a Lambert base, which receives what the layer does not reflect (C. Kelemen and L. Szirmay-Kalos, "A Microfacet
/// Based Coupled Specular-Matte BRDF Model with Importance Sampling", 2001). A metal has no base; light that its facets
/// reflect more than once is added by E. Turquin, "Practical multiple scattering compensation for microfacet models"
/// (2019). Reciprocal up to that; a white surface absorbs nothing. Directions are unit vectors in a frame whose z axis
/// is the normal, away from the surface.
class Finish {
 public:
  /// Without a specular layer if the roughness is 1 or more.
  struct Properties {
    float roughness;  // the square root of GGX's alpha
    bool is_metal = false;
    float glow = 0;  // the fraction of the colour that the surface shows in any light
  };
  explicit Finish(const Properties& properties);
  [[nodiscard]] static Properties properties(Look look);
  [[nodiscard]] static Finish of(Look look) { return Finish(properties(look)); }
  [[nodiscard]] static Finish matt() { return Finish({.roughness = 1}); }

  /// The same with at least that roughness.
  [[nodiscard]] Finish no_sharper_than(float roughness) const;
  /// The specular layer alone, for a translucent body: transmitted light emerges elsewhere.
  [[nodiscard]] Finish without_base() const;

  /// `color`: of a metal.
  [[nodiscard]] Response respond(const Eigen::Vector3f& to_eye, const Eigen::Vector3f& to_light,
                                 const Eigen::Vector3f& color) const;
  /// A direction in which to continue; it may lie below the surface, where nothing is reflected.
  [[nodiscard]] Eigen::Vector3f sample(const Eigen::Vector3f& to_eye, const Eigen::Vector2f& random,
                                       float choice) const;
  /// Returns whether that choice selects the base.
  [[nodiscard]] bool picks_base(float choice) const { return choice >= specular_choice_; }
  /// Returns whether light that meets a surface without a base enters; otherwise sample() says where it goes.
  [[nodiscard]] bool is_transmitted(float choice) const { return !has_base_ && choice >= specular_choice_; }
  /// The normal of a facet that light enters through, and the fraction of light that enters over the probability of
  /// is_transmitted().
  [[nodiscard]] Eigen::Vector3f facet(const Eigen::Vector3f& to_eye, const Eigen::Vector2f& random) const {
    return half_vector(to_eye, random);
  }
  [[nodiscard]] float transmit_in(float cosine) const { return left_to_base(cosine) / (1 - specular_choice_); }
  /// The factor of the radiance of light that emerges isotropically, in a direction with that cosine to the normal.
  [[nodiscard]] float transmit_out(float cosine) const { return left_to_base(cosine) / mean_left_to_base_; }
  [[nodiscard]] float glow() const { return glow_; }

 private:
  static constexpr int kAngles = 64;
  /// The fraction of light that the specular layer reflects: scale times its reflectance at right angles plus bias.
  struct Share {
    float scale = 0;
    float bias = 0;
  };

  [[nodiscard]] Share share(float cosine) const;
  [[nodiscard]] float left_to_base(float cosine) const;
  [[nodiscard]] Eigen::Vector3f half_vector(const Eigen::Vector3f& to_eye, const Eigen::Vector2f& random) const;
  [[nodiscard]] float distribution(float cosine) const;

  [[nodiscard]] bool is_matt() const { return specular_choice_ == 0; }

  float alpha_;
  bool is_metal_;
  bool has_base_;
  float specular_choice_;  // probability to sample the specular layer
  float glow_;
  std::array<Share, kAngles + 1> shares_{};  // by cosine
  float mean_left_to_base_ = 1;
};

}  // namespace sprung
