#pragma once
#include <optional>
#include <vector>

#include "render/stage/stage.h"
#include "render/stage/stage_space.h"
#include "render/trace/ray_scene.h"
#include "render/trace/skin_paint.h"

namespace sprung {

/// A point of a skin that a ray has met, in stage space.
struct SurfacePoint {
  int skin = 0;
  float distance = 0;                                  // from the ray's origin
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  // a little off the surface, towards where the ray came from
  Eigen::Vector3f behind = Eigen::Vector3f::Zero();    // a little behind it, for rays that continue
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();    // unit, smooth
  Eigen::Vector3f face_normal =
      Eigen::Vector3f::Zero();                      // unit, of the triangle; both point to where the ray came from
  Eigen::Vector3f color = Eigen::Vector3f::Zero();  // linear, 0 to 1
  bool is_inside = false;  // the ray came from the side that the skin's normals point away from
};

/// n x 3, m -> stage space.
[[nodiscard]] Floats3 in_stage_space(const Floats3& positions, const StageSpace& space);

/// The skins of a stage as rays see them.
class TracedSkins {
 public:
  TracedSkins(const Stage& stage, const StageSpace& space);

  /// The shapes must not change until the next update.
  void update(const Motion& motion);

  /// Like RayScene::first_hit().
  [[nodiscard]] std::optional<SurfacePoint> first_hit(const Ray& ray, float opacity = 1) const;
  [[nodiscard]] bool is_blocked(const Ray& ray) const { return rays_.is_blocked(ray); }

 private:
  struct Corners {
    Eigen::Matrix3f positions;  // columns, stage space
    Eigen::Matrix3f normals;    // columns, unit
  };
  [[nodiscard]] static Corners mix(const Corners& a, const Corners& b, float share);
  [[nodiscard]] SurfacePoint surface(const Ray& ray, const RayHit& hit) const;

  StageSpace space_;
  std::vector<const Skin*> skins_;
  TexturePictures pictures_;
  std::vector<SkinPaint> paints_;
  RayScene rays_;
  Motion motion_;
  std::vector<std::vector<std::vector<Corners>>> corners_;  // by time, skin and triangle
};

}  // namespace sprung
