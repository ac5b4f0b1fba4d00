#include "app/film/matte_names.h"

#include <fmt/format.h>

#include <map>

namespace sprung {
namespace {

std::string name_of(const SceneBody& body) {
  if (!body.mesh.empty()) return body.mesh.stem().string();
  if (body.box) return "box";
  if (body.sphere) return "sphere";
  if (body.cylinder) return "cylinder";
  return body.torus ? "torus" : "body";
}

std::string name_of(const SceneObstacle& obstacle) {
  if (!obstacle.mesh.empty()) return obstacle.mesh.stem().string();
  if (obstacle.box) return "box";
  if (obstacle.sphere) return "sphere";
  if (obstacle.capsule) return "capsule";
  return obstacle.cylinder ? "cylinder" : "obstacle";
}

}  // namespace

std::vector<std::string> matte_names(const Film& film, const Simulation& simulation) {
  std::vector<std::string> names{"ground"};
  std::map<std::string, int> counts{{"ground", 1}};
  const auto add = [&](const std::string& name) {
    const int count = ++counts[name];
    names.push_back(count == 1 ? name : fmt::format("{}.{:03}", name, count));
  };
  for (const Origin& origin : simulation.origins) add(name_of(film.bodies[origin.body]));
  for (std::size_t row = 0; row < simulation.obstacles.size(); ++row) {
    if (simulation.obstacles[row].skin.positions.rows() > 0) add(name_of(film.obstacles[row]));
  }
  return names;
}

}  // namespace sprung
