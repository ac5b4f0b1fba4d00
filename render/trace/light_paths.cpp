#include "render/trace/light_paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/trace/body_walk.h"
#include "render/trace/directions.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr int kMaxBounces = 64;
/// Least roughness with which a surface is seen via a matt one. Sharper reflections of the key light there, which are
/// caustics, would be sampled too rarely: A. Kaplanyan and C. Dachsbacher, "Path Space Regularization for Holistic and
/// Robust Light Transport" (2013).
constexpr float kBlurred = 0.6F;
constexpr int kSureBounces = 1;      // before Russian roulette may end a path
constexpr float kMinFacing = 1e-2F;  // cosine between a smooth normal and the direction to the eye

Reflected times(const Reflected& reflected, const Vector3f& light) {
  return {reflected.base.cwiseProduct(light), reflected.specular.cwiseProduct(light)};
}

Reflected sum(const Reflected& a, const Reflected& b) { return {a.base + b.base, a.specular + b.specular}; }

/// The divisor of light out of a translucent body, so that smoothing it does not blur the paint. Not too dark: where
/// colours meet within a pixel, light of the darker one is multiplied by more than that.
Vector3f divisor(const Vector3f& color) { return color.cwiseMax(0.25F); }

/// The weight of a density that found the light against another that could have (balance heuristic).
float balance(float density, float other) { return density / (density + other); }

/// A smooth normal that the eye sees from above, however it grazes the surface.
Vector3f facing(const Vector3f& normal, const Vector3f& to_eye) {
  const float cosine = normal.dot(to_eye);
  return cosine >= kMinFacing ? normal : (normal + (kMinFacing - cosine) * to_eye).normalized();
}

Finishes blurred(Finishes finishes) {
  for (Finish& finish : finishes) finish = finish.no_sharper_than(kBlurred);
  return finishes;
}

}  // namespace

LightPaths::Surfaces::Surfaces(const Finishes& finishes) : opaque(finishes), coats(finishes) {
  for (Finish& coat : coats) coat = coat.without_base();
}

LightPaths::LightPaths(const Stage& stage)
    : LightPaths(stage, StageLight(stage),
                 {Finish::of(Look::kPlastic), Finish::of(Look::kGelatin), Finish::of(Look::kRubber),
                  Finish::of(Look::kSteel), Finish::of(Look::kChart)}) {}

LightPaths::LightPaths(const Stage& stage, const StageLight& light, const Finishes& finishes)
    : space_(stage.bounds),
      light_(light),
      skins_(stage, space_),
      media_(stage, space_),
      looks_(stage.looks),
      surfaces_(finishes),
      blurred_(blurred(finishes)),
      pattern_(stage.floor.pattern),
      has_ground_(stage.has_ground),
      has_ghosts_(std::find(stage.ghosts.begin(), stage.ghosts.end(), true) != stage.ghosts.end()),
      ground_height_(float((stage.ground.height - space_.center.y()) * space_.scale)) {
  looks_.resize(stage.skins.size(), Look::kPlastic);
}

void LightPaths::update(const Motion& motion) {
  skins_.update(motion);
  const std::vector<SkinShape>& shapes = *motion.front();
  has_faint_skins_ = std::any_of(shapes.begin(), shapes.end(), [](const SkinShape& s) { return s.is_faint(); });
  region_ = BodyRegion(motion, space_, ground_height_, light_.to_key().cast<double>());
}

/// None if the ray does not come from above.
std::optional<float> LightPaths::way_to_floor(const Ray& ray) const {
  if (!has_ground_ || ray.direction.y() >= 0 || ray.origin.y() <= ground_height_) return std::nullopt;
  return (ground_height_ - ray.origin.y()) / ray.direction.y();
}

LightPaths::Meeting LightPaths::meet(Ray ray, float opacity) const {
  Meeting meeting;
  if (const std::optional<float> way = way_to_floor(ray)) {
    ray.far = *way;
    meeting.seen = Seen::kFloor;
  }
  if (region_.is_met_by(ray)) {
    if (const std::optional<SurfacePoint> point = skins_.first_hit(ray, opacity)) return {Seen::kSkin, *point};
  }
  if (meeting.seen == Seen::kBackground) return meeting;
  meeting.point.position = ray.origin + ray.far * ray.direction;
  meeting.point.position.y() = ground_height_ + 1e-5F;
  meeting.point.normal = meeting.point.face_normal = Vector3f::UnitY();
  meeting.point.color = floor_albedo(meeting.point.position);
  return meeting;
}

Vector3f LightPaths::floor_albedo(const Vector3f& position) const {
  if (!pattern_) return light_.floor_albedo();
  const Vec3 place = space_.to_world(position.cast<double>());
  return pattern_->albedo(place.x(), place.z());
}

const Finish& LightPaths::finish(const Meeting& meeting, bool is_matt) const {
  if (meeting.seen == Seen::kFloor) return floor_finish_;
  const auto look = std::size_t(looks_[std::size_t(meeting.point.skin)]);
  const Surfaces& surfaces = is_matt ? blurred_ : surfaces_;
  return is_entered(meeting) ? surfaces.coats[look] : surfaces.opaque[look];
}

/// Whether light enters the body there.
bool LightPaths::is_entered(const Meeting& meeting) const {
  return meeting.seen == Seen::kSkin && !meeting.point.is_inside && media_.is_entered(meeting.point.skin);
}

Vector3f LightPaths::base_color(const Meeting& meeting) const {
  return is_entered(meeting) ? divisor(meeting.point.color) : meeting.point.color;
}

/// The fraction of light along a ray that is not occluded; it passes straight through translucent bodies.
Vector3f LightPaths::reaching(Ray ray) const {
  constexpr int kMaxSkins = 32;
  if (!is_blocked(ray)) return Vector3f::Ones();
  Vector3f share = Vector3f::Ones();
  Interior interior(media_);
  for (int i = 0; media_.any() && i < kMaxSkins; ++i) {
    const std::optional<SurfacePoint> met = skins_.first_hit(ray);
    if (!met) return share;
    if (!media_.is_entered(met->skin)) break;
    const bool was_outside = interior.is_empty();
    if (was_outside && met->is_inside) interior.enter(*met);  // where the ray started
    if (!interior.is_empty()) share = share.cwiseProduct(interior.medium().transmitted(met->distance));
    if (met->is_inside) {
      interior.leave(met->skin);
    } else {
      interior.enter(*met);
    }
    if (was_outside || interior.is_empty()) {
      const float cosine = std::clamp(-ray.direction.dot(met->normal), 1e-3F, 1.0F);
      share *= 1 - fresnel(cosine, Medium::kIndex);
    }
    ray.origin = met->behind;
  }
  return Vector3f::Zero();
}

LightPaths::Scattering LightPaths::scatter(const Way& way, const Meeting& meeting, Sampler& sampler) const {
  const SurfacePoint& point = meeting.point;
  const Finish& surface = finish(meeting, way.is_matt);
  const TangentFrame frame(facing(point.normal, -way.ray.direction));
  const Vector3f to_eye = frame.to_local(-way.ray.direction);
  Scattering result;
  Ray& onward = result.onward.ray;
  onward.origin = point.position;
  onward.time = way.ray.time;
  result.onward.is_matt = way.is_matt;

  const Vector3f to_key = light_.towards_key(sampler.pair());
  const Vector3f local_key = frame.to_local(to_key);
  if (local_key.z() > 0) {
    const Response response = surface.respond(to_eye, local_key, point.color);
    const float share = balance(light_.key_density(), response.density) / light_.key_density();
    result.unhidden = times(response.reflected, share * light_.key_radiance());
    Ray to_light = onward;
    to_light.direction = to_key;
    result.from_key = times(result.unhidden, reaching(to_light));
  }

  const Eigen::Vector2f random = sampler.pair();
  const float choice = sampler.number();
  if (surface.is_transmitted(choice)) {
    pass_through(way.ray, point, surface, random, sampler, result);
    return result;
  }
  const Vector3f next = surface.sample(to_eye, random, choice);
  const Response response = surface.respond(to_eye, next, point.color);
  if (response.density <= 0) return result;
  result.onward.density = response.density;
  if (surface.picks_base(choice)) result.onward.is_matt = true;
  result.factor = times(response.reflected, Vector3f::Constant(1 / response.density));
  onward.direction = frame.to_world(next).normalized();
  // Above the smooth surface but below the triangle: mirrored, so that no light is lost.
  const float below = onward.direction.dot(point.face_normal);
  if (below < 0) onward.direction -= 2 * below * point.face_normal;
  return result;
}

/// Light that enters a translucent body and leaves it elsewhere. It counts as light of the base, which has the colour.
void LightPaths::pass_through(const Ray& ray, const SurfacePoint& entry, const Finish& coat,
                              const Eigen::Vector2f& random, Sampler& sampler, Scattering& result) const {
  const TangentFrame frame(facing(entry.normal, -ray.direction));
  const Vector3f to_eye = frame.to_local(-ray.direction);
  const std::optional<Vector3f> direction = refracted(-to_eye, coat.facet(to_eye, random), Medium::kIndex);
  if (!direction) return;
  Ray inside = ray;
  inside.origin = entry.behind;
  inside.direction = frame.to_world(*direction).normalized();
  const std::optional<Emergence> out = walk_through_body(skins_, media_, entry, inside, sampler);
  if (!out) return;
  const Vector3f share = (coat.transmit_in(to_eye.z()) * out->share).cwiseQuotient(divisor(entry.color));
  Ray& onward = result.onward.ray;
  onward.origin = out->point.position;
  if (!out->is_scattered) {
    onward.direction = out->direction;
    result.factor.base = share;
    return;
  }
  const TangentFrame there(out->point.normal);
  const Vector3f to_key = light_.towards_key(sampler.pair());
  const float facing_key = to_key.dot(there.normal);
  constexpr float kPi = std::numbers::pi_v<float>;
  if (facing_key > 0) {
    Ray to_light = onward;
    to_light.direction = to_key;
    const float seen = balance(light_.key_density(), facing_key / kPi) / light_.key_density() *
                       coat.transmit_out(facing_key) * facing_key / kPi;
    result.from_key.base += seen * share.cwiseProduct(reaching(to_light)).cwiseProduct(light_.key_radiance());
  }
  const Vector3f local = on_cosine_hemisphere(sampler.pair());
  onward.direction = there.to_world(local).normalized();
  result.factor.base = coat.transmit_out(local.z()) * share;
  result.onward.density = local.z() / kPi;
  result.onward.is_matt = true;
}

/// Light from beyond all surfaces.
Vector3f LightPaths::beyond(const Way& way) const {
  Vector3f light = light_.around(way.ray.direction);
  if (way.density > 0 && light_.is_key(way.ray.direction)) {
    light += balance(way.density, light_.key_density()) * light_.key_radiance();
  }
  return light;
}

Vector3f LightPaths::arriving(Way way, Meeting meeting, Sampler& sampler) const {
  Vector3f light = Vector3f::Zero();
  Vector3f factor = Vector3f::Ones();
  for (int bounce = 0; bounce < kMaxBounces; ++bounce) {
    if (meeting.seen == Seen::kBackground) return light + factor.cwiseProduct(beyond(way));
    const Vector3f color = base_color(meeting);
    if (meeting.seen == Seen::kFloor && region_.weight_on_floor(meeting.point.position) == 0) {
      return light + factor.cwiseProduct(color).cwiseProduct(light_.on_open_floor());
    }
    const Scattering scattering = scatter(way, meeting, sampler);
    const float glow = finish(meeting, way.is_matt).glow();
    const auto whole = [&](const Reflected& parts) -> Vector3f {
      return (1 - glow) * (color.cwiseProduct(parts.base) + parts.specular);
    };
    light += factor.cwiseProduct(whole(scattering.from_key) + glow * color);
    factor = factor.cwiseProduct(whole(scattering.factor));
    const float stay = std::min(factor.maxCoeff(), 1.0F);
    if (bounce >= kSureBounces && stay < 1) {
      if (!(sampler.number() < stay)) return light;
      factor /= stay;
    }
    if (!(factor.maxCoeff() > 0)) return light;
    way = scattering.onward;
    meeting = meet(way.ray);
  }
  return light;
}

Reflected LightPaths::reflected(const Scattering& scattering, Sampler& sampler) const {
  const Reflected& factor = scattering.factor;
  if (factor.base.isZero(0) && factor.specular.isZero(0)) return scattering.from_key;
  return sum(scattering.from_key, times(factor, arriving(scattering.onward, meet(scattering.onward.ray), sampler)));
}

/// Relative to that without bodies. What the same rays would have found there is subtracted, so that a floor without
/// bodies has no noise.
Vector3f LightPaths::floor_light(const Ray& ray, const Meeting& meeting, Sampler& sampler) const {
  const float weight = region_.weight_on_floor(meeting.point.position);
  if (weight == 0) return Vector3f::Ones();
  const Scattering scattering = scatter({.ray = ray}, meeting, sampler);
  Vector3f change = scattering.from_key.base - scattering.unhidden.base;
  const Way& onward = scattering.onward;
  const Meeting next = meet(onward.ray);
  if (next.seen != Seen::kBackground) {
    change += scattering.factor.base.cwiseProduct(arriving(onward, next, sampler) - beyond(onward));
  }
  return Vector3f::Ones() + weight * change.cwiseQuotient(light_.on_open_floor());
}

bool LightPaths::sees_nothing(const Ray& from_eye) const {
  if (region_.is_met_by(from_eye)) return false;
  const std::optional<float> way = way_to_floor(from_eye);
  return !way || region_.weight_on_floor(from_eye.origin + *way * from_eye.direction) == 0;
}

PathSample LightPaths::sample(const Ray& from_eye, float opacity, Sampler& sampler) const {
  const Meeting meeting = meet(from_eye, opacity);
  PathSample sample{.seen = meeting.seen};
  sample.position = meeting.point.position;
  if (meeting.seen != Seen::kSkin) {
    if (meeting.seen == Seen::kFloor) {
      sample.backdrop = light_.floor(from_eye.direction, meeting.point.color);
      sample.floor_light = floor_light(from_eye, meeting, sampler);
    } else {
      sample.backdrop = light_.background(from_eye.direction);
    }
    return sample;
  }
  const Scattering scattering = scatter({.ray = from_eye}, meeting, sampler);
  const float glow = finish(meeting, false).glow();
  sample.light = times(reflected(scattering, sampler), Vector3f::Constant(1 - glow));
  sample.light.base.array() += glow;
  sample.normal = meeting.point.normal;
  sample.color = base_color(meeting);
  return sample;
}

}  // namespace sprung
