#include "app/manifest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>
#include <set>

#include "app/file_hash.h"
#include "app/json_text.h"
#include "app/scene/scene_file.h"

namespace sprung {
namespace {

std::string mesh_hashes(const Scene& scene) {
  std::set<std::string> files;
  for (const SceneBody& body : scene.bodies) files.insert(body.mesh.string());
  for (const SceneObstacle& obstacle : scene.obstacles) files.insert(obstacle.mesh.string());
  files.erase("");
  std::vector<std::string> lines;
  lines.reserve(files.size());
  for (const std::string& file : files) {
    lines.push_back(fmt::format("{}: \"{}\"", json_text(std::string_view(file)), file_hash(file)));
  }
  return fmt::format("{{{}}}", fmt::join(lines, ", "));
}

}  // namespace

std::string manifest_json(const Scene& scene, const Recording& recording) {
  const double total = std::accumulate(recording.seconds.begin(), recording.seconds.end(), 0.0);
  return fmt::format(
      "{{\n  \"version\": \"{}\",\n  \"build\": \"{}\",\n  \"scene\": {},\n  \"mesh_hashes\": {},\n  \"frames\": {},\n"
      "  \"state_hash\": \"{:016x}\",\n  \"seconds\": {:.3f},\n  \"seconds_of_frames\": [{:.4f}]\n}}\n",
      SPRUNG_VERSION, build_of_this_program(), json_text(std::string_view(print_scene(with_defaults(scene)))),
      mesh_hashes(scene), recording.progress.size(), recording.state_hash, total, fmt::join(recording.seconds, ", "));
}

}  // namespace sprung
