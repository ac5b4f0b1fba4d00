#pragma once
#include <array>
#include <optional>
#include <vector>

#include "render/stage/stage.h"
#include "render/stage/stage_space.h"
#include "render/trace/body_region.h"
#include "render/trace/finish.h"
#include "render/trace/interior.h"
#include "render/trace/sampler.h"
#include "render/trace/stage_light.h"
#include "render/trace/traced_skins.h"

namespace sprung {

using Finishes = std::array<Finish, 5>;  // by look

enum class Seen { kBackground, kFloor, kSkin };

/// The result of one camera ray.
struct PathSample {
  Seen seen = Seen::kBackground;
  Reflected light{};                                      // of a skin
  Eigen::Vector3f floor_light = Eigen::Vector3f::Ones();  // over that without bodies
  Eigen::Vector3f backdrop = Eigen::Vector3f::Zero();     // of the floor without bodies, or the background
  Eigen::Vector3f position = Eigen::Vector3f::Zero();     // stage space
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();       // of a skin
  Eigen::Vector3f color = Eigen::Vector3f::Zero();        // of a skin, linear
};

/// Follows light backwards from the eye over skins and floor. At each surface it samples the key light, and continues
/// in a direction in which the surface reflects; the two are combined by multiple importance sampling
/// (E. Veach, 1997).
class LightPaths {
 public:
  /// Throws Error(kFailed) if this program was built without Embree.
  explicit LightPaths(const Stage& stage);
  /// With a different light, and different finishes of the looks, in their order.
  LightPaths(const Stage& stage, const StageLight& light, const Finishes& finishes);

  /// The shapes must not change until the next update.
  void update(const Motion& motion);
  [[nodiscard]] const StageSpace& space() const { return space_; }
  /// Returns whether ghosts, or anything else that is not opaque, is visible.
  [[nodiscard]] bool has_faint() const { return has_ghosts_ || has_faint_skins_; }
  /// Returns whether the floor looks different from pixel to pixel.
  [[nodiscard]] bool has_pattern() const { return pattern_ != nullptr; }

  /// Returns whether the ray certainly meets no body and nothing that one does to the floor.
  [[nodiscard]] bool sees_nothing(const Ray& from_eye) const;
  /// Returns whether it meets a skin, however faint.
  [[nodiscard]] bool sees_skin(const Ray& from_eye) const { return meet(from_eye, 0).seen == Seen::kSkin; }
  /// `opacity`: as for RayScene::first_hit(). May run on several threads.
  [[nodiscard]] PathSample sample(const Ray& from_eye, float opacity, Sampler& sampler) const;
  /// The light that arrives along a ray.
  [[nodiscard]] Eigen::Vector3f arriving(const Ray& ray, Sampler& sampler) const {
    return arriving({.ray = ray}, meet(ray), sampler);
  }

 private:
  struct Meeting {
    Seen seen = Seen::kBackground;
    SurfacePoint point{};
  };
  struct Surfaces {
    explicit Surfaces(const Finishes& finishes);
    Finishes opaque;
    Finishes coats;  // of translucent bodies
  };
  /// A path along which light may arrive.
  struct Way {
    Ray ray{};
    float density = 0;     // with which the ray was sampled, over the solid angle; 0: it does not see the key light
    bool is_matt = false;  // a matt surface, or scattering, is on the path from here to the eye
  };
  /// The light that a surface reflects towards a ray's origin, and the path along which to look for more of it.
  struct Scattering {
    Reflected from_key;  // light of the key light
    Reflected unhidden;  // of the key light, if nothing occluded it
    Way onward;
    Reflected factor;  // of the light that arrives along it
  };

  [[nodiscard]] std::optional<float> way_to_floor(const Ray& ray) const;
  [[nodiscard]] bool is_blocked(const Ray& ray) const { return region_.is_met_by(ray) && skins_.is_blocked(ray); }
  [[nodiscard]] Meeting meet(Ray ray, float opacity = 1) const;
  [[nodiscard]] Eigen::Vector3f floor_albedo(const Eigen::Vector3f& position) const;
  [[nodiscard]] const Finish& finish(const Meeting& meeting, bool is_matt) const;
  [[nodiscard]] Scattering scatter(const Way& way, const Meeting& meeting, Sampler& sampler) const;
  void pass_through(const Ray& ray, const SurfacePoint& entry, const Finish& coat, const Eigen::Vector2f& random,
                    Sampler& sampler, Scattering& result) const;
  [[nodiscard]] bool is_entered(const Meeting& meeting) const;
  /// The colour by which Reflected::base is to be multiplied.
  [[nodiscard]] Eigen::Vector3f base_color(const Meeting& meeting) const;
  [[nodiscard]] Eigen::Vector3f reaching(Ray ray) const;
  [[nodiscard]] Eigen::Vector3f beyond(const Way& way) const;
  [[nodiscard]] Eigen::Vector3f arriving(Way way, Meeting meeting, Sampler& sampler) const;
  [[nodiscard]] Reflected reflected(const Scattering& scattering, Sampler& sampler) const;
  [[nodiscard]] Eigen::Vector3f floor_light(const Ray& ray, const Meeting& meeting, Sampler& sampler) const;

  StageSpace space_;
  StageLight light_;
  TracedSkins skins_;
  Media media_;
  std::vector<Look> looks_;  // by skin
  Surfaces surfaces_;
  Surfaces blurred_;  // as they are seen via a matt surface
  Finish floor_finish_ = Finish::matt();
  std::shared_ptr<const FloorPattern> pattern_;
  bool has_ground_;
  bool has_ghosts_;
  bool has_faint_skins_ = false;
  float ground_height_;  // stage space
  BodyRegion region_;
};

}  // namespace sprung
