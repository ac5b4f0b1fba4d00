#pragma once
#include <array>
#include <optional>
#include <vector>

#include "render/stage/stage.h"
#include "render/stage/stage_space.h"
#include "render/stage/visible_sides.h"
#include "render/trace/ground_light.h"
#include "render/trace/interior.h"
#include "render/trace/irradiance_table.h"
#include "render/trace/light_probes.h"
#include "render/trace/ray_scene.h"
#include "render/trace/skin_paint.h"
#include "render/trace/stage_light.h"
#include "render/trace/vertex_light.h"

namespace sprung {

/// Gathers the light that reaches skins from their surroundings, other than the key light: from the sky, the floor, and
/// after one reflection from other skins and themselves. A fixed set of rays leaves each probe, so that nothing
/// flickers; results depend neither on the number of threads nor on earlier results.
class GatheredLight {
 public:
  /// `rays`: approximate number per probe, more if there are few probes. `max_probes`: of all skins. Throws
  /// Error(kFailed) if this program was built without Embree.
  GatheredLight(const Stage& stage, int rays, int max_probes);

  /// Gathers for all vertices of triangles that `eye` (stage space) may see; the light of others is meaningless.
  /// Results are kept as long as the shapes stay the same.
  void update(const std::vector<SkinShape>& shapes, const Eigen::Vector3f& eye, const GroundLight& ground);

  [[nodiscard]] const VertexLight& of_vertices(std::size_t skin) const { return skins_[skin].of_vertices; }
  /// None if has_through() is false.
  [[nodiscard]] const ThroughLight& through_to_vertices(std::size_t skin) const { return skins_[skin].through; }
  /// The light that bodies reflect onto that rectangle of the ground, in texels of its own, for the shapes of the last
  /// update.
  [[nodiscard]] const GroundGlow& onto_ground(const GroundLight& ground);
  /// Returns whether light enters any body, or a metal mirrors others.
  [[nodiscard]] bool has_through() const { return media_.any() || has_metals_; }

 private:
  static constexpr std::size_t kTurns = 8;  // of the set of rays; neighbouring probes use different ones

  struct Direction {
    Eigen::Vector3f towards;   // unit
    Eigen::Vector3f radiance;  // from there, if it meets nothing
  };
  /// The geometry of a probe.
  struct ProbePoint {
    Eigen::Vector3f origin;  // of its rays, stage space
    Eigen::Vector3f normal;  // unit
    std::size_t skin;
    std::size_t turn;
  };
  struct SkinLight {
    LightProbes probes;
    Sides sides;
    bool is_metal;
    float groove;                            // depth, stage space
    float lift;                              // of the points where rays start or end, off the surface; stage space
    Triangles triangles;                     // coarse, for the rays
    std::vector<int> sources;                // the skin's triangle, by coarse one
    std::vector<Eigen::Vector3f> colors;     // linear, by coarse triangle, if no map colours the skin
    Floats3 positions;                       // of vertices, stage space
    Floats3 normals;                         // unit
    std::vector<bool> is_needed;             // by probe
    std::vector<bool> is_known;              // by probe
    std::vector<Eigen::Vector4f> of_probes;  // light and openness
    std::vector<Eigen::Vector4f> through_to_probes;
    VertexLight of_vertices;
    ThroughLight through;
  };

  void set_triangles(SkinLight& light, const Skin& skin, double cell) const;
  void set_shapes(const std::vector<SkinShape>& shapes, const Eigen::Vector3f& eye);
  void find_needed(SkinLight& light, const Skin& skin, const Eigen::Vector3f& eye) const;
  [[nodiscard]] bool is_inside(const Ray& ray, const RayHit& hit) const;
  [[nodiscard]] std::optional<RayHit> first_hit(Ray ray, std::size_t own, bool is_outside) const;
  [[nodiscard]] Eigen::Vector4f gather(const ProbePoint& place, const GroundLight& ground) const;
  [[nodiscard]] Eigen::Vector4f from_bodies(const Eigen::Vector3f& origin, int set) const;
  [[nodiscard]] Eigen::Vector4f come_through(const ProbePoint& place, const GroundLight& ground) const;
  [[nodiscard]] Eigen::Vector4f mirror(const ProbePoint& place, const Eigen::Vector3f& eye) const;
  [[nodiscard]] Eigen::Vector3f from_key(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) const;
  [[nodiscard]] Eigen::Vector3f light_at_exit(const Ray& inside, const RayHit& exit,
                                              const Eigen::Vector3f& from_floor) const;
  [[nodiscard]] Eigen::Vector3f reflected(const Ray& ray, const RayHit& hit) const;
  [[nodiscard]] static VertexLight interpolated(const LightProbes& probes, const std::vector<Eigen::Vector4f>& light);

  StageSpace space_;
  StageLight stage_light_;
  IrradianceTable irradiance_;
  Media media_;
  bool has_metals_ = false;
  std::vector<const Skin*> stage_skins_;
  TexturePictures pictures_;
  std::vector<SkinPaint> paints_;
  std::array<std::vector<Direction>, kTurns> directions_;
  std::vector<SkinLight> skins_;
  std::optional<RayScene> rays_;
  std::vector<SkinShape> shapes_;                  // the last ones
  Eigen::Vector3f eye_ = Eigen::Vector3f::Zero();  // the last one
  std::optional<GroundGlow> glow_;                 // of these shapes
};

}  // namespace sprung
