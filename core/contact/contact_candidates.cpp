#include "core/contact/contact_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/body/body.h"

namespace sprung {
namespace {

AlignedBox box_of(const Body& body, int brick) {
  AlignedBox box;
  for (const int node : body.grid.nodes[brick]) box.extend(Vec3(body.positions.row(node)));
  return box;
}

}  // namespace

ContactCandidates::ContactCandidates(const std::vector<const ContactSurface*>& skins, std::size_t body,
                                     std::size_t other)
    : skins_(skins) {
  const auto add = [&](std::size_t which) {
    const std::size_t count = skins[which]->points.size();
    sides_.push_back({.body = which,
                      .positions = Points(count, 3),
                      .finds = std::vector<long>(count, 0),
                      .tracked = std::vector<int>(count, -1)});
  };
  add(body);
  if (other != body) add(other);
}

bool ContactCandidates::may_touch(const BrickBounds& a, const BrickBounds& b) const {
  const bool is_self = sides_.size() == 1;
  if (!is_self && a.side == b.side) return false;
  if (a.turn + b.turn > 0 && a.normal.dot(b.normal) > a.cosine * b.cosine - a.sine * b.sine) return false;
  if (!is_self) return true;
  const std::vector<int>& neighbours = skin_of(a).neighbours[a.row];
  return !std::binary_search(neighbours.begin(), neighbours.end(), b.row);
}

void ContactCandidates::add_bricks(const Group& group, std::size_t side, const AlignedBox& near) {
  const Body& body = *group[sides_[side].body];
  const ContactSurface& skin = skin_of(sides_[side]);
  const AlignedBox near_bricks = widened(near, body.grid.brick_size);  // skins may lie a little outside them
  for (std::size_t row = 0; row < skin.bricks.size(); ++row) {
    if (!near_bricks.intersects(box_of(body, skin.bricks[row]))) continue;
    BrickBounds bounds{.side = side, .row = row, .box = {}, .normal = {}, .turn = 0, .cosine = 0, .sine = 0};
    find(group, bounds);
    if (!near.intersects(bounds.box)) continue;
    bounds.normal = carried_normal(body, skin.bricks[row], skin.cones[row].axis);
    bounds.turn = (std::acos(kFacing) - kBent) / 2 - skin.cones[row].spread;
    bounds.cosine = std::cos(bounds.turn);
    bounds.sine = std::sin(bounds.turn);
    bounds_.push_back(bounds);
  }
}

void ContactCandidates::seek(const Group& group, double margin) {
  ++finds_;
  bounds_.clear();
  for (std::size_t side = 0; side < sides_.size(); ++side) {
    const Body& facing = *group[sides_[sides_.size() - 1 - side].body];
    add_bricks(group, side, widened(bounding_box(facing.positions), margin + facing.grid.brick_size));
  }
  std::vector<AlignedBox> boxes;
  boxes.reserve(bounds_.size());
  for (const BrickBounds& bounds : bounds_) boxes.push_back(widened(bounds.box, margin / 2));
  near_ = overlapping_boxes(boxes, [&](int a, int b) { return may_touch(bounds_[a], bounds_[b]); });
  keep_near_bricks();
}

void ContactCandidates::keep_near_bricks() {
  std::vector<int> row_of(bounds_.size(), -1);
  std::vector<BrickBounds> kept;
  const auto keep = [&](int& index) {
    int& row = row_of[index];
    if (row < 0) {
      row = isize(kept);
      kept.push_back(bounds_[index]);
    }
    index = row;
  };
  for (auto& [first, second] : near_) {
    keep(first);
    keep(second);
  }
  bounds_ = std::move(kept);
}

void ContactCandidates::find(const Group& group, BrickBounds& bounds) {
  const ContactSurface& skin = skin_of(bounds);
  Side& side = sides_[bounds.side];
  const Body& body = *group[side.body];
  bounds.box.setEmpty();
  const auto add = [&](int point) {
    long& found = side.finds[point];
    if (found != finds_) {
      side.positions.row(point) = carried(body, skin.points[point], body.positions).transpose();
    }
    found = finds_;
    bounds.box.extend(Vec3(side.positions.row(point)));
  };
  for (int i = skin.first_point[bounds.row]; i < skin.first_point[bounds.row + 1]; ++i) add(i);
  for (int i = skin.first_triangle[bounds.row]; i < skin.first_triangle[bounds.row + 1]; ++i) {
    for (const int corner : skin.triangles[i]) add(corner);
  }
}

RigidMotion ContactCandidates::rigid_motion(const Group& group) const {
  std::vector<MovingMass> masses;
  for (const Side& side : sides_) {
    const Body& body = *group[side.body];
    for (int node = 0; node < body.node_count(); ++node) {
      masses.push_back({body.masses[node], body.positions.row(node), body.velocities.row(node)});
    }
  }
  return rigid_motion_of(masses);
}

double ContactCandidates::fastest_of(const Group& group, std::size_t side, std::size_t row,
                                     const RigidMotion& rigid) const {
  const Body& body = *group[sides_[side].body];
  const ContactSurface& skin = skin_of(sides_[side]);
  double most = 0;
  for (int i = skin.first_point[row]; i < skin.first_point[row + 1]; ++i) {
    const ContactPoint& point = skin.points[i];
    const Vec3 velocity = carried(body, point, body.velocities);
    most = std::max(most, (velocity - rigid.at(carried(body, point, body.positions))).squaredNorm());
  }
  return std::sqrt(most);
}

double ContactCandidates::fastest(const Group& group) const {
  const RigidMotion rigid = rigid_motion(group);
  double most = 0;
  for (std::size_t side = 0; side < sides_.size(); ++side) {
    const std::size_t count = skin_of(sides_[side]).bricks.size();
    for (std::size_t row = 0; row < count; ++row) most = std::max(most, fastest_of(group, side, row, rigid));
  }
  return most;
}

double ContactCandidates::closing_speed(const Group& group, double dt) const {
  const auto velocity_of = [&](const BrickBounds& bounds) {
    const Body& body = *group[sides_[bounds.side].body];
    const int brick = skin_of(bounds).bricks[bounds.row];
    return carried(body, brick, CornerWeights::Constant(0.125), body.velocities);
  };
  double fastest = 0;
  for (const auto& [first, second] : near_) {
    const BrickBounds& a = bounds_[first];
    const BrickBounds& b = bounds_[second];
    const double brick = std::min(a.box.diagonal().norm(), b.box.diagonal().norm());
    const Vec3 way = b.box.center() - a.box.center();
    if (a.normal.dot(way) < -brick / 2 && b.normal.dot(way) > brick / 2) continue;  // back to back
    const Vec3 speed = velocity_of(b) - velocity_of(a);
    const double nearest = std::clamp(-way.dot(speed) / std::max(speed.squaredNorm(), 1e-300), 0.0, dt);
    const double reach = brick + (a.box.diagonal().norm() + b.box.diagonal().norm()) / 2;
    if ((way + nearest * speed).norm() < reach) fastest = std::max(fastest, speed.norm());
  }
  return fastest;
}

int ContactCandidates::tracked_row(const Group& group, std::size_t side, int point) {
  int& row = sides_[side].tracked[point];
  if (row < 0) {
    row = isize(tracked_);
    const std::size_t body = sides_[side].body;
    const ContactSurface& skin = *skins_[body];
    const int brick = skin.points[point].brick;
    tracked_.push_back({body, point, carried_normal(*group[body], brick, skin.normals.row(point))});
  }
  return row;
}

void ContactCandidates::pair_up(const Group& group, const ContactRange& reach, const BrickBounds& facing,
                                std::size_t side, int point) {
  const ContactSurface& across = skin_of(facing);
  const Points& corners = sides_[facing.side].positions;
  const Vec3 position = sides_[side].positions.row(point);
  const int brick = skin_of(sides_[side]).points[point].brick;
  const auto hangs_together = [&](int corner) {
    return share_a_node(*group[sides_[side].body], brick, across.points[corner].brick);
  };
  for (int t = across.first_triangle[facing.row]; t < across.first_triangle[facing.row + 1]; ++t) {
    const std::array<int, 3>& triangle = across.triangles[t];
    const Vec3 a = corners.row(triangle[0]);
    const Vec3 b = corners.row(triangle[1]);
    const Vec3 c = corners.row(triangle[2]);
    if (((a.cwiseMin(b).cwiseMin(c) - position).array() > reach.margin).any()) continue;
    if (((position - a.cwiseMax(b).cwiseMax(c)).array() > reach.margin).any()) continue;
    const Vec3 area = (b - a).cross(c - a);
    if (area.dot(position - a) < -(reach.deepest + reach.margin) * area.norm()) continue;
    const int row = tracked_row(group, side, point);
    if (tracked(row).normal.dot(area) > kFacing * area.norm()) continue;
    if (side == facing.side && std::any_of(triangle.begin(), triangle.end(), hangs_together)) continue;
    CandidatePair pair{row, {}};
    for (std::size_t i = 0; i < 3; ++i) pair.corners[i] = tracked_row(group, facing.side, triangle[i]);
    pairs_.push_back(pair);
  }
}

void ContactCandidates::pair_up(const Group& group, const BrickBounds& bounds, const BrickBounds& facing,
                                const ContactRange& reach) {
  const ContactSurface& skin = skin_of(bounds);
  const AlignedBox around = widened(facing.box, reach.margin);
  for (int point = skin.first_point[bounds.row]; point < skin.first_point[bounds.row + 1]; ++point) {
    if (!around.contains(Vec3(sides_[bounds.side].positions.row(point)))) continue;
    pair_up(group, reach, facing, bounds.side, point);
  }
}

void ContactCandidates::look(const Group& group, const ContactRange& reach) {
  tracked_.clear();
  pairs_.clear();
  for (Side& side : sides_) std::fill(side.tracked.begin(), side.tracked.end(), -1);
  ++finds_;
  for (BrickBounds& bounds : bounds_) find(group, bounds);
  for (const auto& [brick, other] : near_) {
    const BrickBounds& a = bounds_[brick];
    const BrickBounds& b = bounds_[other];
    const double distance = a.box.exteriorDistance(b.box);
    if (distance > reach.margin) continue;
    pair_up(group, a, b, reach);
    pair_up(group, b, a, reach);
  }
  const auto order = [&](const CandidatePair& pair) {
    const TrackedPoint& point = tracked(pair.point);
    return std::tuple(point.body, point.point, tracked(pair.corners[0]).body, pair.corners);
  };
  std::sort(pairs_.begin(), pairs_.end(),
            [&](const CandidatePair& a, const CandidatePair& b) { return order(a) < order(b); });
}

void ContactCandidates::follow(const Group& group) {
  for (TrackedPoint& tracked : tracked_) {
    const ContactPoint& point = skins_[tracked.body]->points[tracked.point];
    const Body& body = *group[tracked.body];
    tracked.position = carried(body, point, body.positions);
  }
}

}  // namespace sprung
