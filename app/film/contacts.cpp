#include "app/film/contacts.h"

#include <array>
#include <cmath>
#include <set>

#include "app/drawn_shapes.h"
#include "render/camera.h"

namespace sprung {
namespace {

constexpr double kNear = 0.08;  // of a brick: what is no further apart touches
constexpr double kCell = 0.5;   // of a brick

Bounds bounds_of(const Points& points) {
  Bounds bounds;
  bounds.include(points);
  return bounds;
}

bool is_within(const Bounds& bounds, const Vec3& place, double margin) {
  return ((place - bounds.low).array() > -margin).all() && ((bounds.high - place).array() > -margin).all();
}

bool are_near(const Bounds& a, const Bounds& b, double margin) {
  return ((a.low - b.high).array() < margin).all() && ((b.low - a.high).array() < margin).all();
}

/// Places, one at most in each cell.
class Thinned {
 public:
  void set_cell(double cell) { cell_ = cell; }
  void add(const Vec3& place) {
    const auto at = [&](int k) { return std::lround(std::floor(place[k] / cell_)); };
    if (cells_.insert({at(0), at(1), at(2)}).second) places_.push_back(place);
  }
  [[nodiscard]] Points points() const {
    Points points(places_.size(), 3);
    for (std::size_t i = 0; i < places_.size(); ++i) points.row(i) = places_[i].transpose();
    return points;
  }

 private:
  double cell_ = 1;  // m
  std::set<std::array<long, 3>> cells_;
  std::vector<Vec3> places_;
};

}  // namespace

Contacts::Contacts(const Production& production)
    : production_(production), ground_(ground_height(production.world.obstacles)) {
  for (const StageObstacle& obstacle : production.obstacles) {
    if (obstacle.skin.triangles.rows() == 0) continue;
    solids_.push_back({&obstacle, NearestTriangle(obstacle.skin.positions, obstacle.skin.triangles)});
  }
}

Points Contacts::at(const std::vector<Points>& nodes, double time) const {
  std::vector<Points> skins;
  std::vector<Bounds> bounds;
  for (std::size_t actor = 0; actor < nodes.size(); ++actor) {
    skins.push_back(skin_positions(production_, actor, nodes[actor]));
    bounds.push_back(bounds_of(skins.back()));
  }
  Thinned found;
  for (std::size_t actor = 0; actor < nodes.size(); ++actor) {
    const double brick = production_.world.actors[actor].body.grid.brick_size;
    const double near = kNear * brick;
    found.set_cell(kCell * brick);
    for (const auto& vertex : skins[actor].rowwise()) {
      if (ground_ && vertex.y() - *ground_ < near) found.add(vertex.transpose());
    }
    for (const Solid& solid : solids_) {
      const Pose pose = pose_at(*solid.obstacle, time);
      const Bounds room = bounds_of(solid.obstacle->skin.positions);
      for (const auto& vertex : skins[actor].rowwise()) {
        const Vec3 place = pose.rotation.transpose() * (vertex.transpose() - pose.translation);
        if (is_within(room, place, near) && solid.surface.at(place).distance < near) found.add(vertex.transpose());
      }
    }
    for (std::size_t other = 0; other < nodes.size(); ++other) {
      if (other == actor || !are_near(bounds[actor], bounds[other], near)) continue;
      const NearestTriangle surface(skins[other], production_.skins[other].skin.triangles);
      for (const auto& vertex : skins[actor].rowwise()) {
        const Vec3 place = vertex.transpose();
        if (is_within(bounds[other], place, near) && surface.at(place).distance < near) found.add(place);
      }
    }
  }
  return found.points();
}

}  // namespace sprung
