#include "render/trace/ray_scene.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "core/error.h"
#include "render/stage/stage.h"

namespace sprung {
namespace {

struct Corner {
  float x, y, z;
};

RTCRay embree_ray(const Ray& ray) {
  RTCRay result{};
  result.org_x = ray.origin.x();
  result.org_y = ray.origin.y();
  result.org_z = ray.origin.z();
  result.dir_x = ray.direction.x();
  result.dir_y = ray.direction.y();
  result.dir_z = ray.direction.z();
  result.tfar = ray.far;
  result.time = ray.time;
  result.mask = ~0U;
  return result;
}

/// A search for what is more opaque than that.
struct Search : RTCIntersectContext {
  float opacity;

  explicit Search(float least) : RTCIntersectContext(), opacity(least) { rtcInitIntersectContext(this); }
};

/// Lets rays through triangles that their search does not see.
void pass_faint(const RTCFilterFunctionNArguments* found) {
  const auto& opacities = *static_cast<const std::vector<float>*>(found->geometryUserPtr);
  const float opacity = opacities[RTCHitN_primID(found->hit, 1, 0)];
  if (opacity <= static_cast<const Search*>(found->context)->opacity) found->valid[0] = 0;
}

}  // namespace

struct RayScene::Embree {
  RTCDevice device;
  RTCScene bodies;
  RTCScene ghosts;
  std::vector<RTCGeometry> geometries;        // by skin
  std::vector<std::vector<Corner*>> corners;  // by skin and time
  std::vector<std::vector<float>> opacities;  // by skin and triangle; none: opaque

  /// Without Embree's robust flag, with which tracing takes a tenth longer: of a million rays one or two slip between
  /// triangles.
  Embree() : device(rtcNewDevice(nullptr)), bodies(rtcNewScene(device)), ghosts(rtcNewScene(device)) {}
  ~Embree() {
    for (const RTCGeometry geometry : geometries) rtcReleaseGeometry(geometry);
    for (const RTCScene scene : {bodies, ghosts}) rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  void add(const Triangles& triangles, bool is_ghost) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    geometries.push_back(geometry);
    void* const indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(int),
                                                  std::size_t(triangles.rows()));
    std::memcpy(indices, triangles.data(), std::size_t(triangles.size()) * sizeof(int));
    rtcAttachGeometryByID(is_ghost ? ghosts : bodies, geometry, unsigned(geometries.size() - 1));
  }

  void make_room(const std::vector<std::vector<Floats3>>& positions) {
    corners.clear();
    for (std::size_t i = 0; i < geometries.size(); ++i) {
      rtcSetGeometryTimeStepCount(geometries[i], unsigned(positions.size()));
      std::vector<Corner*>& of_skin = corners.emplace_back();
      for (std::size_t time = 0; time < positions.size(); ++time) {
        of_skin.push_back(static_cast<Corner*>(
            rtcSetNewGeometryBuffer(geometries[i], RTC_BUFFER_TYPE_VERTEX, unsigned(time), RTC_FORMAT_FLOAT3,
                                    sizeof(Corner), std::size_t(positions[time][i].rows()))));
      }
    }
  }
};

bool RayScene::is_available() { return true; }

RayScene::RayScene(const std::vector<const Triangles*>& triangles, const std::vector<bool>& is_ghost)
    : embree_(std::make_unique<Embree>()) {
  for (std::size_t i = 0; i < triangles.size(); ++i) embree_->add(*triangles[i], !is_ghost.empty() && is_ghost[i]);
}

RayScene::~RayScene() = default;

void RayScene::update(const std::vector<std::vector<Floats3>>& positions, std::vector<std::vector<float>> opacities) {
  const bool fits = !embree_->corners.empty() && embree_->corners.front().size() == positions.size();
  if (!fits) embree_->make_room(positions);
  embree_->opacities = std::move(opacities);
  embree_->opacities.resize(embree_->geometries.size());
  for (std::size_t i = 0; i < embree_->opacities.size(); ++i) {
    const bool is_faint = !embree_->opacities[i].empty();
    rtcSetGeometryUserData(embree_->geometries[i], &embree_->opacities[i]);
    rtcSetGeometryIntersectFilterFunction(embree_->geometries[i], is_faint ? pass_faint : nullptr);
    rtcSetGeometryOccludedFilterFunction(embree_->geometries[i], is_faint ? pass_faint : nullptr);
  }
  for (std::size_t i = 0; i < embree_->geometries.size(); ++i) {
    for (std::size_t time = 0; time < positions.size(); ++time) {
      const Floats3& from = positions[time][i];
      static_assert(sizeof(Corner) == 3 * sizeof(float));
      std::memcpy(embree_->corners[i][time], from.data(), std::size_t(from.size()) * sizeof(float));
      rtcUpdateGeometryBuffer(embree_->geometries[i], RTC_BUFFER_TYPE_VERTEX, unsigned(time));
    }
    rtcCommitGeometry(embree_->geometries[i]);
  }
  // Built by one thread: the order of triangles in the tree, and so which of two at the same distance is found, is then
  // always the same.
  tbb::task_arena(1).execute([this] {
    for (const RTCScene scene : {embree_->bodies, embree_->ghosts}) rtcJoinCommitScene(scene);
  });
  if (rtcGetDeviceError(embree_->device) != RTC_ERROR_NONE) {
    throw Error(ErrorKind::kFailed, "Embree cannot build its tree over the skins: out of memory?");
  }
}

namespace {

/// Embree crashes otherwise.
bool is_finite(const Ray& ray) { return ray.origin.allFinite() && ray.direction.allFinite(); }

}  // namespace

std::optional<RayHit> RayScene::first_hit(const Ray& ray, float opacity) const {
  if (!is_finite(ray)) return std::nullopt;
  Search search(opacity);
  RTCRayHit found{embree_ray(ray), {}};
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->bodies, &search, &found);
  if (opacity < float(kGhostOpacity)) rtcIntersect1(embree_->ghosts, &search, &found);
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return RayHit{int(found.hit.geomID), int(found.hit.primID), found.hit.u,
                found.hit.v,           found.ray.tfar,        {found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z}};
}

bool RayScene::is_blocked(const Ray& ray) const {
  if (!is_finite(ray)) return false;
  Search search(1);
  RTCRay shadow = embree_ray(ray);
  rtcOccluded1(embree_->bodies, &search, &shadow);
  return shadow.tfar < 0;
}

}  // namespace sprung
