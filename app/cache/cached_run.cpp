#include "app/cache/cached_run.h"

#include "app/cache/run_cache.h"
#include "core/error.h"

namespace sprung {
namespace {

Color color_of(const CachedColor& bytes) { return {.red = bytes[0], .green = bytes[1], .blue = bytes[2]}; }

Body cached_body(const CachedActor& cached, const SceneBody& scene_body) {
  Body body = make_body(cached.grid, scene_body.model, scene_body.material);
  body.masses = cached.masses;
  body.rest_positions = cached.rest_positions;
  body.positions = cached.rest_positions;
  if (body.stiffness_scale == cached.stiffness_scale) return body;
  body.stiffness_scale = cached.stiffness_scale;
  build_tiles(body);
  return body;
}

}  // namespace

Production cached_production(const CacheHeader& header, const Scene& scene) {
  Production production;
  production.size = header.size;
  production.meshes = header.meshes;
  production.world.gravity = scene.gravity;
  for (const CachedActor& cached : header.actors) {
    const std::size_t row = cached.body;
    if (row >= scene.bodies.size()) throw Error(ErrorKind::kBadInput, "the cache is damaged: a body that no scene has");
    production.world.actors.push_back({.body = cached_body(cached, scene.bodies[row]), .contacts = {}, .pinned = {}});
    production.skins.push_back({.skin = cached.skin, .embedding = cached.embedding, .color = color_of(cached.color)});
    production.carried.push_back({.vertices = cached.carried, .embedding = cached.carried_embedding});
    Origin& origin = production.origins.emplace_back();
    origin.body = row;
    origin.copy = cached.copy;
    origin.regions = cached.regions;
    if (!cached.pinned.empty()) origin.pins.push_back({.pin = 0, .nodes = cached.pinned});
  }
  for (std::size_t i = 0; i < header.obstacles.size(); ++i) {
    const SceneObstacle& obstacle = scene.obstacles.at(i);
    StageObstacle& staged = production.obstacles.emplace_back();
    // Nothing meets them any more: it only matters which of them is level ground.
    staged.shape = obstacle.plane ? Shape(SolidHalfSpace{}) : Shape(SolidBall{});
    staged.start = header.obstacles[i].start;
    staged.movement = {obstacle.keyframes, obstacle.interpolation};
    staged.skin = header.obstacles[i].skin;
    staged.color = color_of(header.obstacles[i].color);
    production.world.obstacles.push_back(obstacle_between(staged, obstacle, 0, 0));
  }
  return production;
}

std::vector<Floats3> cached_nodes(const CacheReader& cache, std::size_t frame) {
  std::vector<Floats3> nodes;
  for (const Points& positions : cache.positions(frame)) nodes.emplace_back(positions.cast<float>());
  return nodes;
}

Recording cached_recording(const CacheReader& cache) {
  Recording recording;
  recording.progress_name = cache.header().progress_name;
  for (const std::string& name : cache.header().probes) recording.probes.push_back({.name = name, .samples = {}});
  for (std::size_t frame = 0; frame < cache.frame_count(); ++frame) {
    recording.frames.push_back(cached_nodes(cache, frame));
    const CachedFrame cached = cache.frame(frame);
    recording.progress.push_back(cached.progress);
    for (std::size_t probe = 0; probe < recording.probes.size(); ++probe) {
      recording.probes[probe].samples.push_back(sample_of(cached, probe));
    }
  }
  return recording;
}

}  // namespace sprung
