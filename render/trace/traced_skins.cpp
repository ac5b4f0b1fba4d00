#include "render/trace/traced_skins.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr float kOff = 1e-5F;    // the surface: where rays start
constexpr float kFlat = 1e-24F;  // square of twice the area of a triangle that has no normal

Floats3 in_stage_space(const Floats3& positions, const StageSpace& space) {
  return (float(space.scale) * (positions.rowwise() - space.center.cast<float>().transpose())).eval();
}

Floats3 unit(const Floats3& vectors) {
  return vectors.array().colwise() / vectors.rowwise().norm().array().max(1e-12F);
}

/// Rows of two times, mixed.
Vector3f row_between(const Floats3& before, const Floats3& after, float share, int row) {
  return (before.row(row) + share * (after.row(row) - before.row(row))).transpose();
}

}  // namespace

TracedSkins::TracedSkins(const Stage& stage, const StageSpace& space)
    : space_(space), skins_(stage.skins), rays_(stage.skins, stage.ghosts) {
  for (std::size_t i = 0; i < skins_.size(); ++i) {
    paints_.emplace_back(*skins_[i], stage.default_colors[i], stage.color_map, pictures_);
  }
}

void TracedSkins::update(const Motion& motion) {
  motion_ = motion;
  positions_.clear();
  normals_.clear();
  for (const std::vector<SkinShape>* const at_time : motion) {
    std::vector<Floats3>& positions = positions_.emplace_back();
    std::vector<Floats3>& normals = normals_.emplace_back();
    for (const SkinShape& shape : *at_time) {
      positions.push_back(in_stage_space(shape.positions, space_));
      normals.push_back(unit(shape.normals));
    }
  }
  rays_.update(positions_);
}

std::optional<SurfacePoint> TracedSkins::first_hit(const Ray& ray, bool sees_ghosts) const {
  const std::optional<RayHit> hit = rays_.first_hit(ray, sees_ghosts);
  return hit ? std::optional(surface(ray, *hit)) : std::nullopt;
}

SurfacePoint TracedSkins::surface(const Ray& ray, const RayHit& hit) const {
  const float time = ray.time * float(motion_.size() - 1);
  const std::size_t step = std::min(std::size_t(time), motion_.size() - 1);
  const std::size_t next = std::min(step + 1, motion_.size() - 1);
  const float share = time - float(step);
  const SkinShape& shape = (*motion_[step])[hit.skin];
  const Eigen::Vector3i corners = skins_[hit.skin]->triangles.row(hit.triangle);
  const Vector3f weights(1 - hit.u - hit.v, hit.u, hit.v);
  Eigen::Matrix3f points;
  Eigen::Matrix3f normals;
  for (int k = 0; k < 3; ++k) {
    points.col(k) = row_between(positions_[step][hit.skin], positions_[next][hit.skin], share, corners[k]);
    normals.col(k) = row_between(normals_[step][hit.skin], normals_[next][hit.skin], share, corners[k]);
  }
  SurfacePoint point;
  point.skin = hit.skin;
  point.distance = hit.distance;
  point.color = paints_[hit.skin].color(hit.triangle, weights, shape.map_coordinates);
  const Vector3f smooth = normals * weights;
  Vector3f outward = (hit.normal.squaredNorm() > kFlat ? hit.normal : smooth).normalized();
  if (outward.dot(smooth) < 0) outward = -outward;
  point.is_inside = outward.dot(ray.direction) > 0;
  const float side = point.is_inside ? -1.0F : 1.0F;
  point.face_normal = side * outward;
  point.normal = smooth.squaredNorm() > 1e-6F ? (side * smooth.normalized()).eval() : point.face_normal;
  point.position = points * weights;
  point.behind = point.position - kOff * point.face_normal;
  // Onto the curved surface that the normals tell of, so that light which grazes the triangle is not blocked by its
  // neighbours: J. Hanika, "Hacking the Shadow Terminator" (2021).
  Vector3f lift = Vector3f::Zero();
  for (int k = 0; k < 3; ++k) {
    const float below = side * normals.col(k).dot(point.position - points.col(k));
    if (below < 0) lift -= weights[k] * below * side * normals.col(k);
  }
  point.position += lift + kOff * point.face_normal;
  return point;
}

}  // namespace sprung
