#include "render/trace/body_region.h"

#include <algorithm>
#include <limits>

namespace sprung {
namespace {

// Distances from a body on the floor, in its radii.
constexpr float kWhole = 0.6F;  // up to here everything is shown,
constexpr float kReach = 1.6F;  // from here on nothing
constexpr float kMargin = 0.05F;
constexpr float kSmallest = 1e-6F;  // radius

AlignedBox box_of(const Motion& motion, std::size_t skin, const StageSpace& space) {
  AlignedBox box;
  for (const std::vector<SkinShape>* const shapes : motion) {
    const AlignedBox at_time = bounding_box((*shapes)[skin].positions.cast<double>().eval());
    if (at_time.isEmpty()) continue;
    box.extend(space.from_world(at_time.min()));
    box.extend(space.from_world(at_time.max()));
  }
  return box;
}

}  // namespace

BodyRegion::BodyRegion(const Motion& motion, const StageSpace& space, double height, const Vec3& to_key) {
  const Vec3& light = to_key;
  for (std::size_t skin = 0; skin < motion.front()->size(); ++skin) {
    const AlignedBox box = box_of(motion, skin, space);
    if (box.isEmpty()) continue;
    Felt felt{{}, std::max(float(0.5 * box.diagonal().norm()), kSmallest)};
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 point = box.corner(static_cast<AlignedBox::CornerType>(corner));
      const Vec3 shadow = point - light * (std::max(point.y() - height, 0.0) / light.y());
      for (const Vec3& at : {point, shadow})
        felt.rectangle.extend(Eigen::Vector2d(at.x(), at.z()).cast<float>().eval());
    }
    felt_.push_back(felt);
    const Eigen::Vector3f margin = Eigen::Vector3f::Constant(kMargin * felt.radius);
    bodies_.extend((box.min().cast<float>() - margin).eval());
    bodies_.extend((box.max().cast<float>() + margin).eval());
  }
}

float BodyRegion::distance_on_floor(const Eigen::Vector3f& point) const {
  float nearest = std::numeric_limits<float>::infinity();
  for (const Felt& felt : felt_) {
    nearest = std::min(nearest, felt.rectangle.exteriorDistance(Eigen::Vector2f(point.x(), point.z())) / felt.radius);
  }
  return nearest;
}

float BodyRegion::weight_on_floor(const Eigen::Vector3f& point) const {
  const float share = std::clamp((kReach - distance_on_floor(point)) / (kReach - kWhole), 0.0F, 1.0F);
  return share * share * (3 - 2 * share);
}

bool BodyRegion::is_met_by(const Ray& ray) const {
  float in = 0;
  float out = ray.far;
  for (int k = 0; k < 3; ++k) {
    const float rate = 1 / ray.direction[k];  // may be infinite
    const float low = (bodies_.min()[k] - ray.origin[k]) * rate;
    const float high = (bodies_.max()[k] - ray.origin[k]) * rate;
    in = std::max(in, std::min(low, high));
    out = std::min(out, std::max(low, high));
  }
  return in <= out;
}

}  // namespace sprung
