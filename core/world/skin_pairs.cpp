#include "core/world/skin_pairs.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/body/brick_columns.h"

namespace sprung {
namespace {

constexpr double kFacing = 0.2;  // cosine between the normals of what touches, at most
constexpr double kBent = 0.5;    // rad, that a brick's normals may turn, against each other and until it is looked at

/// A normal of the skin at rest carried along by its brick, unit.
Vec3 carried_normal(const Body& body, int brick, const Vec3& normal) {
  const auto& nodes = body.grid.nodes[static_cast<std::size_t>(brick)];
  const Vec3 along = mean_axes_of(columns_of(nodes, body.rest_positions)).transpose() * normal;
  return (areas_of(mean_axes_of(columns_of(nodes, body.positions))) * along).normalized();
}

bool hang_together(const Body& body, int a, int b) {
  const auto brick_a = static_cast<std::size_t>(a);
  const auto brick_b = static_cast<std::size_t>(b);
  if ((body.grid.cells[brick_a] - body.grid.cells[brick_b]).cwiseAbs().maxCoeff() > 1) return false;
  const auto& nodes = body.grid.nodes[brick_b];
  return std::any_of(body.grid.nodes[brick_a].begin(), body.grid.nodes[brick_a].end(),
                     [&](int node) { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); });
}

/// Whether a brick hangs together with both: the skins of such bricks cannot meet without a fold within a brick or two.
bool are_neighbours(const Body& body, int a, int b) {
  const Eigen::Vector3i& cell = body.grid.cells[static_cast<std::size_t>(b)];
  if ((body.grid.cells[static_cast<std::size_t>(a)] - cell).cwiseAbs().maxCoeff() > 2) return false;
  for (const int node : body.grid.nodes[static_cast<std::size_t>(a)]) {
    const auto row = static_cast<std::size_t>(node);
    for (int i = body.first_corner[row]; i < body.first_corner[row + 1]; ++i) {
      if (hang_together(body, body.corners[static_cast<std::size_t>(i)] / 8, b)) return true;
    }
  }
  return false;
}

Points positions_of(const ContactSkin& skin, const Body& body) {
  Points all(static_cast<Eigen::Index>(skin.points.size()), 3);
  for (std::size_t i = 0; i < skin.points.size(); ++i) {
    all.row(static_cast<Eigen::Index>(i)) = carried(body, skin.points[i], body.positions).transpose();
  }
  return all;
}

/// Of the points and triangles of a skin's brick.
AlignedBox box_of(const ContactSkin& skin, std::size_t row, const Points& positions) {
  AlignedBox box;
  for (int i = skin.first_point[row]; i < skin.first_point[row + 1]; ++i) box.extend(Vec3(positions.row(i)));
  for (int i = skin.first_triangle[row]; i < skin.first_triangle[row + 1]; ++i) {
    for (const int corner : skin.triangles[static_cast<std::size_t>(i)]) box.extend(Vec3(positions.row(corner)));
  }
  return box;
}

AlignedBox widened(const AlignedBox& box, double by) {
  return {box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by)};
}

}  // namespace

bool SkinPairs::may_touch(const Group& group, const Place& a, const Place& b) const {
  if (!self_ && a.actor == b.actor) return false;
  const double spread = skins_[a.actor]->cones[a.row].spread + skins_[b.actor]->cones[b.row].spread;
  const double angle = std::acos(std::clamp(a.normal.dot(b.normal), -1.0, 1.0));
  if (angle + spread + kBent < std::acos(kFacing)) return false;
  if (!self_) return true;
  const std::vector<int>& bricks = skins_[a.actor]->bricks;
  return !are_neighbours(group[a.actor]->body, bricks[a.row], bricks[b.row]);
}

std::vector<std::size_t> SkinPairs::near_actors(const Group& group, double margin) const {
  if (self_) return {*self_};
  std::vector<AlignedBox> boxes;
  for (const Actor* actor : group) {
    const Points& x = actor->body.positions;
    const AlignedBox box(Vec3(x.colwise().minCoeff()), Vec3(x.colwise().maxCoeff()));
    boxes.push_back(widened(box, margin + actor->body.grid.brick_size));  // skins may lie a little outside the bricks
  }
  std::vector<std::size_t> near;
  for (const auto& [a, b] : overlapping_boxes(boxes)) {
    near.push_back(static_cast<std::size_t>(a));
    near.push_back(static_cast<std::size_t>(b));
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

void SkinPairs::seek(const Group& group, double margin) {
  positions_.resize(group.size());
  places_.clear();
  std::vector<AlignedBox> boxes;
  for (const std::size_t actor : near_actors(group, margin)) {
    const Body& body = group[actor]->body;
    const ContactSkin& skin = *skins_[actor];
    positions_[actor] = positions_of(skin, body);
    for (std::size_t row = 0; row < skin.bricks.size(); ++row) {
      const AlignedBox box = box_of(skin, row, positions_[actor]);
      places_.push_back({actor, row, box, carried_normal(body, skin.bricks[row], skin.cones[row].axis)});
      boxes.push_back(widened(box, margin / 2));
    }
  }
  near_ = overlapping_boxes(boxes);
  std::erase_if(near_, [&](const std::pair<int, int>& pair) {
    return !may_touch(group, places_[static_cast<std::size_t>(pair.first)],
                      places_[static_cast<std::size_t>(pair.second)]);
  });
  keep_near_places();
}

void SkinPairs::keep_near_places() {
  std::vector<int> row_of(places_.size(), -1);
  std::vector<Place> kept;
  const auto keep = [&](int& place) {
    int& row = row_of[static_cast<std::size_t>(place)];
    if (row < 0) {
      row = static_cast<int>(kept.size());
      kept.push_back(places_[static_cast<std::size_t>(place)]);
    }
    place = row;
  };
  for (auto& [first, second] : near_) {
    keep(first);
    keep(second);
  }
  places_ = std::move(kept);
}

void SkinPairs::find_places(const Group& group) {
  ++look_;
  found_in_.resize(group.size());
  for (Place& place : places_) {
    const ContactSkin& skin = *skins_[place.actor];
    const Body& body = group[place.actor]->body;
    Points& positions = positions_[place.actor];
    found_in_[place.actor].resize(skin.points.size(), 0);
    place.box.setEmpty();
    const auto add = [&](int point) {
      long& found = found_in_[place.actor][static_cast<std::size_t>(point)];
      if (found != look_) {
        positions.row(point) = carried(body, skin.points[static_cast<std::size_t>(point)], body.positions).transpose();
      }
      found = look_;
      place.box.extend(Vec3(positions.row(point)));
    };
    for (int i = skin.first_point[place.row]; i < skin.first_point[place.row + 1]; ++i) add(i);
    for (int i = skin.first_triangle[place.row]; i < skin.first_triangle[place.row + 1]; ++i) {
      for (const int corner : skin.triangles[static_cast<std::size_t>(i)]) add(corner);
    }
  }
}

int SkinPairs::watched_row(const Group& group, std::size_t actor, int point) {
  int& row = rows_[actor][static_cast<std::size_t>(point)];
  if (row < 0) {
    row = static_cast<int>(watched_.size());
    const ContactSkin& skin = *skins_[actor];
    const int brick = skin.points[static_cast<std::size_t>(point)].brick;
    watched_.push_back({actor, point, carried_normal(group[actor]->body, brick, skin.normals.row(point))});
  }
  return row;
}

void SkinPairs::pair_up(const Group& group, const SkinReach& reach, const Place& facing, std::size_t actor, int point) {
  const ContactSkin& across = *skins_[facing.actor];
  const Points& corners = positions_[facing.actor];
  const Vec3 place = positions_[actor].row(point);
  const int brick = skins_[actor]->points[static_cast<std::size_t>(point)].brick;
  const auto hangs_together = [&](int corner) {
    return hang_together(group[actor]->body, brick, across.points[static_cast<std::size_t>(corner)].brick);
  };
  for (int t = across.first_triangle[facing.row]; t < across.first_triangle[facing.row + 1]; ++t) {
    const std::array<int, 3>& triangle = across.triangles[static_cast<std::size_t>(t)];
    const Vec3 a = corners.row(triangle[0]);
    const Vec3 b = corners.row(triangle[1]);
    const Vec3 c = corners.row(triangle[2]);
    if (((a.cwiseMin(b).cwiseMin(c) - place).array() > reach.margin).any()) continue;
    if (((place - a.cwiseMax(b).cwiseMax(c)).array() > reach.margin).any()) continue;
    const Vec3 area = (b - a).cross(c - a);
    if (area.dot(place - a) < -(reach.deepest + reach.margin) * area.norm()) continue;
    const int row = watched_row(group, actor, point);
    if (watched(row).normal.dot(area) > kFacing * area.norm()) continue;
    if (actor == facing.actor && std::any_of(triangle.begin(), triangle.end(), hangs_together)) continue;
    SkinPair pair{row, {}};
    for (std::size_t i = 0; i < 3; ++i) pair.corners[i] = watched_row(group, facing.actor, triangle[i]);
    pairs_.push_back(pair);
  }
}

void SkinPairs::pair_up(const Group& group, const Place& place, const Place& facing, const SkinReach& reach) {
  const ContactSkin& skin = *skins_[place.actor];
  const AlignedBox around = widened(facing.box, reach.margin);
  for (int point = skin.first_point[place.row]; point < skin.first_point[place.row + 1]; ++point) {
    if (!around.contains(Vec3(positions_[place.actor].row(point)))) continue;
    pair_up(group, reach, facing, place.actor, point);
  }
}

void SkinPairs::look(const Group& group, const SkinReach& reach) {
  watched_.clear();
  pairs_.clear();
  if (near_.empty()) return;
  rows_.resize(group.size());
  for (std::size_t actor = 0; actor < group.size(); ++actor) rows_[actor].assign(skins_[actor]->points.size(), -1);
  find_places(group);
  for (const auto& [brick, other] : near_) {
    const Place& a = places_[static_cast<std::size_t>(brick)];
    const Place& b = places_[static_cast<std::size_t>(other)];
    if (a.box.squaredExteriorDistance(b.box) > reach.margin * reach.margin) continue;
    pair_up(group, a, b, reach);
    pair_up(group, b, a, reach);
  }
  const auto order = [&](const SkinPair& pair) {
    const WatchedPoint& point = watched(pair.point);
    return std::tuple(point.actor, point.point, watched(pair.corners[0]).actor, pair.corners);
  };
  std::sort(pairs_.begin(), pairs_.end(), [&](const SkinPair& a, const SkinPair& b) { return order(a) < order(b); });
}

void SkinPairs::follow(const Group& group) {
  for (WatchedPoint& watched : watched_) {
    const ContactPoint& point = skins_[watched.actor]->points[static_cast<std::size_t>(watched.point)];
    const Body& body = group[watched.actor]->body;
    watched.place = carried(body, point, body.positions);
    watched.velocity = carried(body, point, body.velocities);
  }
}

}  // namespace sprung
