#include "render/trace/traced_skins.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/unit_rows.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr float kOff = 1e-5F;    // the surface: where rays start
constexpr float kFlat = 1e-24F;  // square of twice the area of a triangle that has no normal

std::vector<const Triangles*> triangles_of(const std::vector<const Skin*>& skins) {
  std::vector<const Triangles*> triangles;
  triangles.reserve(skins.size());
  for (const Skin* skin : skins) triangles.push_back(&skin->triangles);
  return triangles;
}

}  // namespace

Floats3 in_stage_space(const Floats3& positions, const StageSpace& space) {
  return (float(space.scale) * (positions.rowwise() - space.center.cast<float>().transpose())).eval();
}

TracedSkins::Corners TracedSkins::mix(const Corners& a, const Corners& b, float share) {
  return {a.positions + share * (b.positions - a.positions), a.normals + share * (b.normals - a.normals)};
}

TracedSkins::TracedSkins(const Stage& stage, const StageSpace& space)
    : space_(space), skins_(stage.skins), rays_(triangles_of(stage.skins), stage.ghosts) {
  for (std::size_t i = 0; i < skins_.size(); ++i) {
    paints_.emplace_back(*skins_[i], stage.default_colors[i], stage.color_map, pictures_);
  }
}

void TracedSkins::update(const Motion& motion) {
  motion_ = motion;
  std::vector<std::vector<Floats3>> positions;
  corners_.assign(motion.size(), {});
  for (std::size_t time = 0; time < motion.size(); ++time) {
    std::vector<Floats3>& at_time = positions.emplace_back();
    for (std::size_t i = 0; i < skins_.size(); ++i) {
      const SkinShape& shape = (*motion[time])[i];
      const Floats3& points = at_time.emplace_back(in_stage_space(shape.positions, space_));
      const Floats3 normals = unit_rows(shape.normals);
      std::vector<Corners>& corners = corners_[time].emplace_back(std::size_t(skins_[i]->triangles.rows()));
      for (std::size_t t = 0; t < corners.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
          const int vertex = skins_[i]->triangles(Eigen::Index(t), k);
          corners[t].positions.col(k) = points.row(vertex);
          corners[t].normals.col(k) = normals.row(vertex);
        }
      }
    }
  }
  std::vector<std::vector<float>> opacities(skins_.size());
  for (std::size_t i = 0; i < skins_.size(); ++i) {
    const SkinShape& shape = (*motion.front())[i];
    const Triangles& triangles = skins_[i]->triangles;
    for (Eigen::Index t = 0; shape.is_faint() && t < triangles.rows(); ++t) {
      opacities[i].push_back(shape.opacities[triangles(t, 0)]);
    }
  }
  rays_.update(positions, std::move(opacities));
}

std::optional<SurfacePoint> TracedSkins::first_hit(const Ray& ray, float opacity) const {
  const std::optional<RayHit> hit = rays_.first_hit(ray, opacity);
  return hit ? std::optional(surface(ray, *hit)) : std::nullopt;
}

SurfacePoint TracedSkins::surface(const Ray& ray, const RayHit& hit) const {
  const float place = ray.time * float(motion_.size() - 1);
  const std::size_t step = std::min(std::size_t(place), motion_.size() - 1);
  const auto at = [&](std::size_t i) -> const Corners& {
    return corners_[i][std::size_t(hit.skin)][std::size_t(hit.triangle)];
  };
  Corners between;
  const bool is_between = place > float(step);
  if (is_between) between = mix(at(step), at(step + 1), place - float(step));
  const auto& [points, normals] = is_between ? between : at(step);
  const SkinShape& shape = (*motion_[step])[hit.skin];
  const Vector3f weights(1 - hit.u - hit.v, hit.u, hit.v);
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
  // Onto the curved surface that the normals imply, so that light which grazes the triangle is not blocked by its
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
