#include "render/trace/gathered_light.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/unit_rows.h"
#include "render/stage/coarse_triangles.h"
#include "render/trace/layer.h"
#include "render/trace/traced_skins.h"

namespace sprung {
namespace {

using Eigen::Vector3f;
using Eigen::Vector4f;

constexpr double kLift = 0.004;         // of the skin's radius
constexpr double kGroove = 2;           // depth of grooves over the sides of coarse triangles
constexpr float kLittle = 1e-3F;        // of a groove, by which rays continue behind it
constexpr double kChord = 0.1;          // lift over the sides of coarse triangles
constexpr float kTurned = 0.1F;         // sine of an angle by which triangles may be turned away
constexpr std::size_t kFewProbes = 5;   // times fewer than the most: each then gets more rays
constexpr int kMaxRays = 8;             // times as many from a probe, if there are few probes
constexpr double kMirrorSpacing = 0.5;  // of the probes of metals, over that of others
constexpr int kMirrorRays = 8;
constexpr float kMirrorBlur = 0.06F;     // tangent of an angle: about that of steel's roughness
constexpr float kSteep = 0.2F;           // cosine to the normal
constexpr std::size_t kInwardRays = 16;  // from a probe of a translucent body
constexpr float kHitOpenness = 0.7F;     // of the places that rays hit, as a guess

/// Evenly over the sphere: the points of a Fibonacci lattice.
std::vector<Vector3f> even_directions(int count) {
  std::vector<Vector3f> directions;
  for (int i = 0; i < count; ++i) {
    const float y = 1 - (2 * float(i) + 1) / float(count);
    const float turn = 2 * std::numbers::pi_v<float> * float(std::fmod(i / std::numbers::phi, 1.0));
    const float radius = std::sqrt(1 - y * y);
    directions.emplace_back(radius * std::cos(turn), y, radius * std::sin(turn));
  }
  return directions;
}

/// The i-th of some rotations that are far from each other.
Eigen::Matrix3f rotation(std::size_t i) {
  const auto part = [i](double step) { return 2 * std::numbers::pi * std::fmod(double(i) * step, 1.0); };
  return Eigen::AngleAxisd(part(0.7548776662), Vec3(1, 2, 3).normalized()).toRotationMatrix().cast<float>() *
         Eigen::AngleAxisd(part(0.5698402910), Vec3(-2, 3, 1).normalized()).toRotationMatrix().cast<float>();
}

}  // namespace

GatheredLight::GatheredLight(const Stage& stage, int rays, int max_probes)
    : space_(stage.bounds),
      stage_light_(stage),
      irradiance_(stage_light_),
      media_(stage, space_),
      stage_skins_(stage.skins) {
  const std::vector<double> spacings = probe_spacings(stage_skins_, max_probes);
  for (std::size_t i = 0; i < stage_skins_.size(); ++i) {
    const Skin& skin = *stage_skins_[i];
    paints_.emplace_back(skin, stage.default_colors[i], stage.color_map, pictures_);
    SkinLight& light = skins_.emplace_back();
    light.is_metal = !stage.looks.empty() && stage.looks[i] == Look::kSteel;
    has_metals_ = has_metals_ || light.is_metal;
    light.probes = place_probes(skin, light.is_metal ? kMirrorSpacing * spacings[i] : spacings[i]);
    light.sides = visible_sides(skin);
    light.of_vertices.setZero(skin.positions.rows(), 4);
    light.through.setZero(skin.positions.rows(), 4);
    set_triangles(light, skin, spacings[i]);
    light.groove = float(space_.scale * kGroove * spacings[i]);
    light.lift = float(space_.scale * std::max(kLift * skin_radius(skin), kChord * spacings[i]));
  }
  std::vector<const Triangles*> triangles;
  for (const SkinLight& light : skins_) triangles.push_back(&light.triangles);
  rays_.emplace(triangles, stage.ghosts);
  std::size_t probes = 1;
  for (const SkinLight& light : skins_) probes += light.probes.vertices.size();
  const int few =
      std::clamp(int(std::size_t(rays) * std::size_t(max_probes) / (kFewProbes * probes)), rays, kMaxRays * rays);
  // A sphere of directions, half of which are above any surface.
  const std::vector<Vector3f> directions = even_directions(2 * few);
  for (std::size_t turn = 0; turn < kTurns; ++turn) {
    const Eigen::Matrix3f turned = rotation(turn);
    for (const Vector3f& direction : directions) {
      const Vector3f towards = turned * direction;
      directions_[turn].push_back({towards, stage_light_.around(towards)});
    }
  }
}

/// Rays need no triangles finer than the spacing of probes.
void GatheredLight::set_triangles(SkinLight& light, const Skin& skin, double cell) const {
  CoarseTriangles coarse = coarse_or_all_triangles(skin, cell);
  for (int t = 0; t < skin.triangles.rows(); ++t) {
    const bool is_left = coarse.first[std::size_t(t)] < coarse.first[std::size_t(t) + 1];
    if (is_left) light.sources.push_back(t);
  }
  for (const int source : light.sources) {
    light.colors.push_back(paints_.back().color(source, Vector3f::Constant(1.0F / 3), {}));
  }
  light.triangles = std::move(coarse.triangles);
}

/// Forgets what has changed.
void GatheredLight::set_shapes(const std::vector<SkinShape>& shapes, const Vector3f& eye) {
  for (SkinLight& light : skins_) {
    const bool depends_on_eye = light.sides == Sides::kBoth || light.is_metal;
    if (depends_on_eye && eye != eye_) light.is_known.assign(light.is_known.size(), false);
  }
  eye_ = eye;
  const auto same = [](const SkinShape& a, const SkinShape& b) {
    return a.positions == b.positions && a.normals == b.normals && a.map_coordinates == b.map_coordinates;
  };
  if (std::equal(shapes.begin(), shapes.end(), shapes_.begin(), shapes_.end(), same)) return;
  shapes_ = shapes;
  glow_.reset();
  std::vector<Floats3> positions;
  std::vector<std::vector<float>> opacities(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    SkinLight& light = skins_[i];
    light.positions = in_stage_space(shapes[i].positions, space_);
    light.normals = unit_rows(shapes[i].normals);
    light.is_known.assign(light.probes.vertices.size(), false);
    light.of_probes.assign(light.probes.vertices.size(), Vector4f::Zero());
    light.through_to_probes = light.of_probes;
    positions.push_back(light.positions);
    if (shapes[i].is_faint()) opacities[i].assign(std::size_t(light.triangles.rows()), 1);
  }
  rays_->update({positions}, std::move(opacities));
}

/// Probes of vertices of triangles that face the eye or, as bodies move while the shutter is open, nearly do.
void GatheredLight::find_needed(SkinLight& light, const Skin& skin, const Vector3f& eye) const {
  std::vector<bool> is_seen(std::size_t(skin.positions.rows()), light.sides == Sides::kBoth);
  const float side = light.sides == Sides::kBack ? -1.0F : 1.0F;
  for (Eigen::Index t = 0; t < skin.triangles.rows() && light.sides != Sides::kBoth; ++t) {
    const Eigen::Vector3i corners = skin.triangles.row(t);
    const Vector3f a = light.positions.row(corners[0]);
    const Vector3f b = light.positions.row(corners[1]).transpose() - a;
    const Vector3f c = light.positions.row(corners[2]).transpose() - a;
    const Vector3f way = eye - a;
    const Vector3f across = b.cross(c);
    if (side * across.dot(way) <= -kTurned * across.norm() * way.norm()) continue;
    for (const int corner : corners) is_seen[std::size_t(corner)] = true;
  }
  light.is_needed.assign(light.probes.vertices.size(), false);
  for (std::size_t vertex = 0; vertex < is_seen.size(); ++vertex) {
    if (!is_seen[vertex]) continue;
    for (int k = light.probes.first[vertex]; k < light.probes.first[vertex + 1]; ++k) {
      light.is_needed[std::size_t(light.probes.probes[std::size_t(k)])] = true;
    }
  }
}

void GatheredLight::update(const std::vector<SkinShape>& shapes, const Vector3f& eye, const GroundLight& ground) {
  set_shapes(shapes, eye);
  struct Task {
    std::size_t skin;
    std::size_t probe;
  };
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < skins_.size(); ++i) {
    SkinLight& light = skins_[i];
    find_needed(light, *stage_skins_[i], eye);
    for (std::size_t k = 0; k < light.is_needed.size(); ++k) {
      if (!light.is_needed[k] || light.is_known[k]) continue;
      tasks.push_back({i, k});
      light.is_known[k] = true;
    }
  }
  if (tasks.empty()) return;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tasks.size(), 32), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      SkinLight& light = skins_[tasks[i].skin];
      const int vertex = light.probes.vertices[tasks[i].probe];
      const Vector3f position = light.positions.row(vertex);
      Vector3f normal = light.normals.row(vertex);
      const bool is_flipped =
          light.sides == Sides::kBoth ? normal.dot(eye - position) < 0 : light.sides == Sides::kBack;
      if (is_flipped) normal = -normal;
      ProbePoint place{position + light.lift * normal, normal, tasks[i].skin, tasks[i].probe % kTurns};
      light.of_probes[tasks[i].probe] = gather(place, ground);
      if (light.is_metal) light.through_to_probes[tasks[i].probe] = mirror(place, eye);
      if (!media_.is_entered(int(tasks[i].skin))) continue;
      place.origin = position - light.lift * normal;
      light.through_to_probes[tasks[i].probe] = come_through(place, ground);
    }
  });
  tbb::parallel_for(std::size_t(0), skins_.size(), [&](std::size_t i) {
    SkinLight& light = skins_[i];
    light.of_vertices = interpolated(light.probes, light.of_probes);
    const bool has_more = light.is_metal || media_.is_entered(int(i));
    if (has_more) light.through = interpolated(light.probes, light.through_to_probes);
  });
}

namespace {

constexpr int kGroundSize = 48;  // texels along each side
constexpr int kPeriod = 4;       // of the sets of rays that texels use, along both sides

/// Means along x or z in which all sets of rays have the same weight: no texel shows its own.
std::vector<Vector4f> smoothed(const std::vector<Vector4f>& texels, bool along_x) {
  constexpr std::array<float, kPeriod + 1> kWeights{1 / 8.0F, 2 / 8.0F, 2 / 8.0F, 2 / 8.0F, 1 / 8.0F};
  std::vector<Vector4f> means(texels.size(), Vector4f::Zero());
  for (int i = 0; i < kGroundSize * kGroundSize; ++i) {
    for (int k = -kPeriod / 2; k <= kPeriod / 2; ++k) {
      const int x = std::clamp(i % kGroundSize + (along_x ? k : 0), 0, kGroundSize - 1);
      const int z = std::clamp(i / kGroundSize + (along_x ? 0 : k), 0, kGroundSize - 1);
      means[std::size_t(i)] += kWeights[std::size_t(k + kPeriod / 2)] * texels[std::size_t(z * kGroundSize + x)];
    }
  }
  return means;
}

}  // namespace

const GroundGlow& GatheredLight::onto_ground(const GroundLight& ground) {
  const bool is_same = glow_ && glow_->low == ground.low && glow_->sides == ground.sides;
  if (is_same) return *glow_;
  std::vector<Vector4f> texels(std::size_t(kGroundSize) * kGroundSize);
  tbb::parallel_for(tbb::blocked_range<int>(0, kGroundSize * kGroundSize, 32), [&](const auto& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      const Eigen::Array2i at(i % kGroundSize, i / kGroundSize);
      const Eigen::Array2f place = ground.low.array() + ground.sides.array() * (at.cast<float>() + 0.5F) / kGroundSize;
      const int set = at.x() % kPeriod + kPeriod * (at.y() % kPeriod);
      texels[std::size_t(i)] = from_bodies({place.x(), float(ground.height), place.y()}, set);
    }
  });
  glow_ = GroundGlow{ground.low, ground.sides, kGroundSize, smoothed(smoothed(texels, true), false)};
  return *glow_;
}

/// Irradiance over pi of level ground there, and the fraction of the light from above that bodies occlude.
/// `set`: which of twice kTurns sets of rays; the second half of them are the first ones turned about the vertical.
Vector4f GatheredLight::from_bodies(const Vector3f& origin, int set) const {
  const float side = std::size_t(set) < kTurns ? 1 : -1;
  Ray ray;
  ray.origin = origin;
  Vector3f reflections = Vector3f::Zero();
  float weights = 0;
  float hidden = 0;
  for (const Direction& direction : directions_[std::size_t(set) % kTurns]) {
    const float cosine = direction.towards.y();
    if (cosine <= 0) continue;
    weights += cosine;
    ray.direction = direction.towards.cwiseProduct(Vector3f(side, 1, side));
    const std::optional<RayHit> hit = rays_->first_hit(ray);
    if (!hit) continue;
    hidden += cosine;
    reflections += cosine * reflected(ray, *hit);
  }
  return Vector4f(reflections.x(), reflections.y(), reflections.z(), hidden) / weights;
}

bool GatheredLight::is_inside(const Ray& ray, const RayHit& hit) const {
  const Sides sides = skins_[std::size_t(hit.skin)].sides;
  const float along = hit.normal.dot(ray.direction);
  return sides != Sides::kBoth && (sides == Sides::kBack ? along < 0 : along > 0);
}

/// Ignores the skin if the ray begins on its wrong side: in a groove a probe may lie beneath the coarse triangles, on a
/// ridge above them.
std::optional<RayHit> GatheredLight::first_hit(Ray ray, std::size_t own, bool is_outside) const {
  std::optional<RayHit> hit = rays_->first_hit(ray);
  const float reach = skins_[own].groove;
  if (!hit || std::size_t(hit->skin) != own || hit->distance > reach || is_inside(ray, *hit) != is_outside) return hit;
  const float passed = hit->distance + kLittle * reach;
  ray.origin += passed * ray.direction;
  ray.far -= passed;
  if (ray.far <= 0) return std::nullopt;
  hit = rays_->first_hit(ray);
  if (hit) hit->distance += passed;
  return hit;
}

/// The rays measure the occluded fraction of the surrounding light: without occluders the result is exact.
Vector4f GatheredLight::gather(const ProbePoint& place, const GroundLight& ground) const {
  Ray ray;
  ray.origin = place.origin;
  const float height = std::max(ray.origin.y() - float(ground.height), 0.0F);
  Vector3f around = Vector3f::Zero();
  Vector3f arriving = Vector3f::Zero();  // of that
  Vector3f reflections = Vector3f::Zero();
  float open = 0;
  float weights = 0;
  for (const Direction& direction : directions_[place.turn]) {
    const float cosine = place.normal.dot(direction.towards);
    if (cosine <= 0) continue;
    weights += cosine;
    around += cosine * direction.radiance;
    ray.direction = direction.towards;
    const bool is_down = direction.towards.y() < 0;
    ray.far = is_down ? height / -direction.towards.y() : std::numeric_limits<float>::infinity();
    const std::optional<RayHit> hit = first_hit(ray, place.skin, true);
    if (hit) {
      reflections += cosine * reflected(ray, *hit);
      continue;
    }
    open += cosine;
    if (is_down) {
      const Vector3f floor = ray.origin + ray.far * ray.direction;
      arriving += cosine * stage_light_.floor_albedo().cwiseProduct(ground.at(floor.x(), floor.z()));
    } else {
      arriving += cosine * direction.radiance;
    }
  }
  if (weights == 0) return Vector4f::Zero();
  const Vector3f light =
      irradiance_.on(place.normal).cwiseProduct(arriving).cwiseQuotient(around.cwiseMax(1e-6F)) + reflections / weights;
  return {light.x(), light.y(), light.z(), open / weights};
}

/// Follows rays inwards: what arrives where they leave the body.
Vector4f GatheredLight::come_through(const ProbePoint& place, const GroundLight& ground) const {
  const std::vector<Direction>& directions = directions_[place.turn];
  const std::size_t step = std::max(directions.size() / (2 * kInwardRays), std::size_t(1));
  const float attenuation = 0.5F * media_.scattering(int(place.skin));
  Ray ray;
  ray.origin = place.origin;
  Vector3f sum = Vector3f::Zero();
  float kept = 0;
  float weights = 0;
  for (std::size_t i = 0; i < directions.size(); i += step) {
    const float cosine = -place.normal.dot(directions[i].towards);
    if (cosine <= 0) continue;
    ray.direction = directions[i].towards;
    const std::optional<RayHit> hit = first_hit(ray, place.skin, false);
    if (!hit || std::size_t(hit->skin) != place.skin || !is_inside(ray, *hit)) continue;
    weights += cosine;
    const float way = hit->distance + skins_[place.skin].lift / std::max(cosine, kSteep);  // from the surface on
    const float share = cosine * std::exp(-attenuation * way);
    const Vector3f exit = ray.origin + hit->distance * ray.direction;
    const Vector3f floor = stage_light_.floor_albedo().cwiseProduct(ground.at(exit.x(), exit.z()));
    sum += share * light_at_exit(ray, *hit, floor);
    kept += share;
  }
  if (kept <= 0) return Vector4f::Zero();
  sum /= kept;
  return {sum.x(), sum.y(), sum.z(), kept / weights};
}

/// Averages the directions of the place around the mirrored one, as a rough mirror does.
Vector4f GatheredLight::mirror(const ProbePoint& place, const Vector3f& eye) const {
  const Vector3f from_eye = (place.origin - eye).normalized();
  const Vector3f mirrored = from_eye - 2 * from_eye.dot(place.normal) * place.normal;
  const std::vector<Direction>& directions = directions_[place.turn];
  Ray ray;
  ray.origin = place.origin;
  Vector4f sum = Vector4f::Zero();
  for (int i = 0; i < kMirrorRays; ++i) {
    const Vector3f aside = directions[std::size_t(i) * directions.size() / kMirrorRays].towards;
    ray.direction = (mirrored + kMirrorBlur * aside).normalized();
    if (ray.direction.dot(place.normal) <= 0) continue;
    const std::optional<RayHit> hit = first_hit(ray, place.skin, true);
    if (hit) sum += reflected(ray, *hit).homogeneous();
  }
  return sum / kMirrorRays;
}

/// Irradiance over pi.
Vector3f GatheredLight::from_key(const Vector3f& position, const Vector3f& normal) const {
  const float facing = normal.dot(stage_light_.to_key());
  if (facing <= 0) return Vector3f::Zero();
  Ray shadow;
  shadow.origin = position;
  shadow.direction = stage_light_.to_key();
  return rays_->is_blocked(shadow) ? Vector3f::Zero().eval() : (facing * stage_light_.on_facing_key()).eval();
}

/// Irradiance over pi of a body from outside, where a ray in it meets its skin.
Vector3f GatheredLight::light_at_exit(const Ray& inside, const RayHit& exit, const Vector3f& from_floor) const {
  Vector3f normal = exit.normal.normalized();
  if (normal.dot(inside.direction) < 0) normal = -normal;
  const float lift = skins_[std::size_t(exit.skin)].lift;
  return (0.5F + 0.5F * normal.y()) * stage_light_.sky_on_ground() + (0.5F - 0.5F * normal.y()) * from_floor +
         from_key(inside.origin + exit.distance * inside.direction + lift * normal, normal);
}

/// Radiance of what a ray has met.
Vector3f GatheredLight::reflected(const Ray& ray, const RayHit& hit) const {
  const SkinLight& skin = skins_[std::size_t(hit.skin)];
  if (is_inside(ray, hit)) return Vector3f::Zero();
  Vector3f normal = hit.normal.normalized();
  if (normal.dot(ray.direction) > 0) normal = -normal;
  const Eigen::VectorXf& map_coordinates = shapes_[std::size_t(hit.skin)].map_coordinates;
  const Vector3f color = map_coordinates.size() == 0
                             ? skin.colors[std::size_t(hit.triangle)]
                             : paints_[std::size_t(hit.skin)].color(skin.sources[std::size_t(hit.triangle)],
                                                                    Vector3f::Constant(1.0F / 3), map_coordinates);
  const Vector3f floor = stage_light_.around(-Vector3f::UnitY());
  const Vector3f position = ray.origin + hit.distance * ray.direction;
  Vector3f light = kHitOpenness * (0.5F + 0.5F * normal.y()) * stage_light_.sky_on_ground();
  light += kHitOpenness * (0.5F - 0.5F * normal.y()) * floor;
  light += from_key(position + skin.lift * normal, normal);
  if (!media_.is_entered(hit.skin)) return color.cwiseProduct(light);
  Ray inside;
  inside.origin = position - skin.lift * normal;
  inside.direction = ray.direction;
  const std::optional<RayHit> exit = rays_->first_hit(inside);
  if (!exit || exit->skin != hit.skin || !is_inside(inside, *exit)) return color.cwiseProduct(light);
  const Layer layer(color, Layer::kScattering * media_.scattering(hit.skin) * (exit->distance + skin.lift));
  return layer.reflected.cwiseProduct(light) + layer.let_through.cwiseProduct(light_at_exit(inside, *exit, floor));
}

VertexLight GatheredLight::interpolated(const LightProbes& probes, const std::vector<Vector4f>& light) {
  VertexLight result(Eigen::Index(probes.first.size()) - 1, 4);
  for (Eigen::Index vertex = 0; vertex < result.rows(); ++vertex) {
    const auto from = std::size_t(probes.first[std::size_t(vertex)]);
    const auto to = std::size_t(probes.first[std::size_t(vertex) + 1]);
    Vector4f sum = Vector4f::Zero();
    for (std::size_t k = from; k < to; ++k) sum += probes.weights[k] * light[std::size_t(probes.probes[k])];
    sum.head<3>() = (sum.head<3>() / kBrightestVertexLight).cwiseSqrt();
    result.row(vertex) = (65535 * sum.cwiseMin(1.0F)).array().round().cast<std::uint16_t>();
  }
  return result;
}

}  // namespace sprung
