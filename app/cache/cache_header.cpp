#include "app/cache/cache_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "app/file_hash.h"
#include "app/scene/scene_file.h"

namespace sprung {
namespace {

CachedColor bytes_of(const Color& color) { return {color.red, color.green, color.blue}; }

/// What may be changed without any frame being another one.
Scene without_freedom(Scene scene, const Scene& other) {
  scene.camera = other.camera;
  scene.render = other.render;
  const bool has_even_pins = std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const SceneBody& body) {
    return std::any_of(body.pins.begin(), body.pins.end(), [](const Pin& pin) { return pin.translate || pin.rotate; });
  });
  if (is_motion(scene) && !has_even_pins) scene.duration = other.duration;
  return scene;
}

/// "[[body]] young = 2 in the cache, young = 3 here" of the first line that differs.
std::string difference_of_texts(const std::string& cached, const std::string& now) {
  std::istringstream old_text(cached);
  std::istringstream new_text(now);
  std::string section;
  std::string old_line;
  std::string new_line;
  while (true) {
    const bool has_old = static_cast<bool>(std::getline(old_text, old_line));
    const bool has_new = static_cast<bool>(std::getline(new_text, new_line));
    if (!has_old && !has_new) return "";
    if (!has_old) old_line = "nothing";
    if (!has_new) new_line = "nothing";
    if (old_line != new_line) {
      return fmt::format("the scene: {}{} in the cache, {} here", section, old_line, new_line);
    }
    if (old_line.starts_with('[')) section = old_line + " ";
  }
}

std::string difference_of_actors(const CachedActor& cached, const CachedActor& now) {
  if (cached.grid.cells.size() != now.grid.cells.size()) {
    return fmt::format("{} bricks in the cache, {} here", cached.grid.cells.size(), now.grid.cells.size());
  }
  if (cached.grid.cells != now.grid.cells || cached.grid.nodes != now.grid.nodes || cached.masses != now.masses ||
      cached.stiffness_scale != now.stiffness_scale || cached.rest_positions != now.rest_positions) {
    return "as many bricks, but others";
  }
  if (cached.skin.positions.rows() != now.skin.positions.rows() || cached.skin.positions != now.skin.positions ||
      cached.skin.triangles != now.skin.triangles) {
    return "another skin";
  }
  return "";
}

}  // namespace

CacheHeader cache_header(const Scene& scene, const Production& production, std::string progress_name) {
  CacheHeader header;
  header.version = SPRUNG_VERSION;
  header.build = build_of_this_program();
  header.scene = print_scene(with_defaults(scene));
  header.progress_name = std::move(progress_name);
  header.size = production.size;
  header.meshes = production.meshes;
  for (const Probe& probe : scene.probes) header.probes.push_back(probe.name);
  for (std::size_t i = 0; i < production.skins.size(); ++i) {
    const Body& body = production.world.actors[i].body;
    const DrawnSkin& drawn = production.skins[i];
    CachedActor& actor = header.actors.emplace_back();
    actor.body = int(production.origins[i].body);
    actor.color = bytes_of(drawn.color);
    actor.grid = body.grid;
    actor.stiffness_scale = body.stiffness_scale;
    actor.regions = production.origins[i].regions;
    actor.masses = body.masses;
    actor.rest_positions = body.rest_positions;
    actor.pinned = pinned_nodes(production.origins[i]);
    actor.skin = drawn.skin;
    actor.embedding = drawn.embedding;
    actor.copy = production.origins[i].copy;
    actor.carried = production.carried[i].vertices;
    actor.carried_embedding = production.carried[i].embedding;
  }
  for (const StageObstacle& obstacle : production.obstacles) {
    header.obstacles.push_back({.color = bytes_of(obstacle.color), .start = obstacle.start, .skin = obstacle.skin});
  }
  return header;
}

std::string position_accuracy(const CacheHeader& header) {
  if (header.position_error == 0) return "to the last bit";
  return fmt::format("to within {:.6g} m", header.position_error);
}

Scene cached_scene(const CacheHeader& header) {
  return parse_scene(header.scene, "/cache.toml", SceneFiles::kAnywhere);
}

std::string difference(const CacheHeader& cached, const CacheHeader& now) {
  if (cached.version != now.version) {
    return fmt::format("it was made by sprung {}, this is sprung {}", cached.version, now.version);
  }
  if (cached.build != now.build) {
    return fmt::format("it was made by another build of sprung {} ({}; this one is {}), whose last digits may differ",
                       now.version, cached.build, now.build);
  }
  if (cached.position_error != now.position_error) {
    return fmt::format("its positions are kept {}, here it is {}", position_accuracy(cached), position_accuracy(now));
  }
  const Scene scene = cached_scene(now);
  const std::string old_scene = print_scene(without_freedom(cached_scene(cached), scene));
  if (std::string text = difference_of_texts(old_scene, print_scene(scene)); !text.empty()) return text;
  if (cached.actors.size() != now.actors.size()) {
    return fmt::format("{} solids in the cache, {} here: the meshes have changed", cached.actors.size(),
                       now.actors.size());
  }
  for (std::size_t i = 0; i < now.actors.size(); ++i) {
    const std::string text = difference_of_actors(cached.actors[i], now.actors[i]);
    if (text.empty()) continue;
    return fmt::format("the mesh of body {} has changed: {}", now.actors[i].body + 1, text);
  }
  return "";
}

}  // namespace sprung
