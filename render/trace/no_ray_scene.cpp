#include "core/error.h"
#include "render/trace/ray_scene.h"

// Replaces ray_scene.cpp if Embree is missing.
namespace sprung {

struct RayScene::Embree {};

bool RayScene::is_available() { return false; }

RayScene::RayScene(const std::vector<const Triangles*>& /*triangles*/, const std::vector<bool>& /*is_ghost*/) {
  throw Error(ErrorKind::kFailed,
              "final quality: this program was built without Embree; install libembree-dev and build it again, or take "
              "high quality");
}

RayScene::~RayScene() = default;
void RayScene::update(const std::vector<std::vector<Floats3>>& /*positions*/,
                      std::vector<std::vector<float>> /*opacities*/) {}
std::optional<RayHit> RayScene::first_hit(const Ray& /*ray*/, float /*opacity*/) const { return std::nullopt; }
bool RayScene::is_blocked(const Ray& /*ray*/) const { return false; }

}  // namespace sprung
