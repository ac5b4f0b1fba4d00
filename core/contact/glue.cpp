#include "core/contact/glue.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/contact/search/contact_surface.h"
#include "core/types.h"
#include "core/world/obstacle.h"

namespace sprung {
namespace {

/// The pose of an undeformed body's grid in the world.
Pose pose_of(const Body& body) {
  Pose pose;
  const auto& nodes = body.grid.nodes[0];
  const Vec3 corner = body.positions.row(nodes[0]);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 next = body.positions.row(nodes[std::size_t{1} << axis]);
    pose.rotation.col(axis) = (next - corner) / body.grid.brick_size;
  }
  pose.translation = corner - pose.rotation * Vec3(body.grid.rest_positions().row(nodes[0]));
  return pose;
}

/// Of the points within the distance of a surface, the nearest at each corner of a brick, by its row.
std::vector<int> nearest_points(const SoftBody& body, const Points& positions, const MeshDistance& surface,
                                double distance) {
  struct Candidate {
    int row;
    double gap;
  };
  std::map<std::pair<int, int>, Candidate> nearest;
  for (int row = 0; row < positions.rows(); ++row) {
    const double gap = std::abs(surface.nearest(positions.row(row)).distance);
    if (gap > distance) continue;
    int corner = 0;
    trilinear_weights(body.contact.points.local.row(row)).maxCoeff(&corner);
    const auto key = std::pair(body.contact.points.brick[row], corner);
    const auto [place, is_new] = nearest.try_emplace(key, Candidate{row, gap});
    if (!is_new && gap < place->second.gap) place->second = {row, gap};
  }
  std::vector<int> rows;
  rows.reserve(nearest.size());
  for (const auto& [key, candidate] : nearest) rows.push_back(candidate.row);
  return rows;
}

}  // namespace

std::vector<GluedPoint> glue_between(const World& world, std::size_t a, std::size_t b, double distance) {
  if (world.bodies[b].grid.brick_size < world.bodies[a].grid.brick_size) std::swap(a, b);
  const SoftBody& one = world.bodies[a];
  const SoftBody& other = world.bodies[b];
  if (other.contact.triangles.rows() == 0) return {};
  const MeshDistance surface(deform_points(other.grid, other.contact.points, other.positions), other.contact.triangles);
  const Points positions = deform_points(one.grid, one.contact.points, one.positions);
  const std::vector<int> rows = nearest_points(one, positions, surface, distance);
  const Pose pose = pose_of(other);
  const Points there = (positions(rows, Eigen::all).rowwise() - pose.translation.transpose()) * pose.rotation;
  const Embedding embedding = embed(other.grid, there);
  std::vector<GluedPoint> glue;
  glue.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    glue.push_back({.bodies = {a, b},
                    .bricks = {one.contact.points.brick[rows[i]], embedding.brick[i]},
                    .weights = {trilinear_weights(one.contact.points.local.row(rows[i])),
                                trilinear_weights(embedding.local.row(i))}});
  }
  return glue;
}

std::vector<GluedPoint> glue_within(const World& world, std::span<const std::size_t> bodies) {
  std::vector<GluedPoint> within;
  for (GluedPoint point : world.glue) {
    const auto first = std::find(bodies.begin(), bodies.end(), point.bodies[0]);
    if (first == bodies.end()) continue;  // glued bodies are in one group
    const auto second = std::find(bodies.begin(), bodies.end(), point.bodies[1]);
    point.bodies[0] = std::size_t(first - bodies.begin());
    point.bodies[1] = std::size_t(second - bodies.begin());
    within.push_back(point);
  }
  return within;
}

}  // namespace sprung
