#include "core/simulation/body_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "core/error.h"
#include "core/world/load_forces.h"

namespace sprung {
namespace {

/// Per node, m^3.
Eigen::VectorXd volumes_of(const std::vector<int>& bricks, const BrickGrid& grid) {
  Eigen::VectorXd volumes = Eigen::VectorXd::Zero(grid.node_count());
  for (const int brick : bricks) {
    const std::size_t row = brick;
    for (const int node : grid.nodes[row]) volumes[node] += grid.fill[row] * grid.brick_volume() / 8;
  }
  return volumes;
}

/// A face of the body.
bool is_flat(const Selection& selection) {
  return selection.box && (selection.box->min.array() == selection.box->max.array()).any();
}

bool acts_on_skin(const BodyForce& force) {
  return force.traction || force.moment || (force.total && (force.on_surface || is_flat(force)));
}

/// A surface that carries loads, and the part of it that a force acts on.
struct SelectedSkin {
  Points points;  // m, in the frame of the grid
  const Embedding& embedding;
  const Triangles& triangles;
  std::vector<SkinPiece> pieces;
};

SelectedSkin select_skin(const Embedding& embedding, const Triangles& triangles, const Selection& selection,
                         const Selector& selector, const SoftBody& body, std::size_t solid) {
  SelectedSkin skin{.points = deform_points(body.grid, embedding, body.grid.rest_positions()),
                    .embedding = embedding,
                    .triangles = triangles,
                    .pieces = {}};
  skin.pieces = selector.skin_pieces(selection, skin.points, triangles, solid);
  return skin;
}

double area_of(const Mat3& corners) {
  return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm() / 2;
}

/// The nodal shares of a force spread evenly over the pieces. Exact: quadratic in each.
void spread(const SelectedSkin& skin, const BrickGrid& grid, ForcedPart& part) {
  part.shares = Eigen::VectorXd::Zero(grid.node_count());
  part.arms = Points::Zero(grid.node_count(), 3);
  for (const SkinPiece& piece : skin.pieces) {
    Mat3 corners;
    for (int corner = 0; corner < 3; ++corner) {
      corners.col(corner) = skin.points.row(skin.triangles(piece.triangle, corner)).transpose();
    }
    const double area = area_of(corners) * piece.share() / 3;  // of each middle of an edge
    for (int edge = 0; edge < 3; ++edge) {
      const Vec3 at = (piece.corners.col(edge) + piece.corners.col((edge + 1) % 3)) / 2;
      const Vec3 position = corners * at;
      part.second += area * position * position.transpose();
      for (int corner = 0; corner < 3; ++corner) {
        const int point = skin.triangles(piece.triangle, corner);
        const CornerWeights weights = trilinear_weights(skin.embedding.local.row(point));
        const auto& nodes = grid.nodes[skin.embedding.brick[point]];
        for (int brick_corner = 0; brick_corner < 8; ++brick_corner) {
          const double share = area * at[corner] * weights[brick_corner];
          part.shares[nodes[brick_corner]] += share;
          part.arms.row(nodes[brick_corner]) += share * position.transpose();
        }
      }
    }
  }
}

/// The pieces by triangle.
SkinPart part_of(const std::vector<SkinPiece>& pieces) {
  SkinPart part;
  std::vector<Vec3> weights;
  for (const SkinPiece& piece : pieces) {
    if (part.triangles.empty() || part.triangles.back() != piece.triangle) {
      part.triangles.push_back(piece.triangle);
      weights.emplace_back(Vec3::Zero());
    }
    weights.back() += piece.share() * piece.corners.rowwise().mean();
  }
  part.weights.resize(isize(weights), 3);
  for (int row = 0; row < isize(weights); ++row) part.weights.row(row) = weights[row].transpose();
  return part;
}

}  // namespace

std::vector<ForcedPart> place_forces(const std::vector<BodyForce>& forces, const Selector& selector,
                                     const SoftBody& body, std::size_t solid) {
  std::vector<ForcedPart> parts;
  for (std::size_t row = 0; row < forces.size(); ++row) {
    const BodyForce& force = forces[row];
    ForcedPart part{.force = row};
    if (force.pressure) {
      const LoadedSkin loaded = loaded_skin(body);
      part.skin = std::make_shared<const SkinPart>(
          part_of(select_skin(loaded.points, loaded.triangles, force, selector, body, solid).pieces));
      if (part.skin->triangles.empty()) continue;
    } else {
      if (acts_on_skin(force)) {
        spread(select_skin(body.drawn.embedding, body.drawn.skin.triangles, force, selector, body, solid), body.grid,
               part);
      } else {
        part.shares = volumes_of(selector.touched_bricks(force, body.grid, solid), body.grid);
      }
      if (part.shares.isZero(0)) continue;
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

void place(ForcedPart& part, const Mat3& rotation, const Vec3& translation) {
  if (part.arms.rows() == 0) return;
  const Vec3 arm = rotation * part.arms.colwise().sum().transpose();
  part.second = rotation * part.second * rotation.transpose() + arm * translation.transpose() +
                translation * arm.transpose() + part.shares.sum() * translation * translation.transpose();
  part.arms = part.arms * rotation.transpose() + part.shares * translation.transpose();
}

std::vector<MusclePart> place_muscles(const std::vector<BodyMuscle>& muscles, const Selector& selector,
                                      const SoftBody& body, std::size_t solid, const Mat3& bricks_from_rest) {
  std::vector<MusclePart> parts;
  for (std::size_t muscle = 0; muscle < muscles.size(); ++muscle) {
    std::vector<int> bricks = selector.touched_bricks(muscles[muscle], body.grid, solid);
    if (bricks.empty()) continue;
    parts.push_back({.muscle = muscle,
                     .full = {.bricks = std::move(bricks),
                              .direction = bricks_from_rest * muscles[muscle].direction.normalized(),
                              .contraction = muscles[muscle].contraction}});
  }
  return parts;
}

void check_loads(const Scene& scene, std::size_t body, const std::vector<Origin>& origins) {
  std::vector<bool> pushed(scene.bodies[body].forces.size());
  std::vector<bool> pulled(scene.bodies[body].muscles.size());
  for (const Origin& origin : origins) {
    if (origin.body != body) continue;
    for (const ForcedPart& part : origin.forces) pushed[part.force] = true;
    for (const MusclePart& part : origin.muscles) pulled[part.muscle] = true;
  }
  const auto check = [&](const std::vector<bool>& reached, std::string_view what) {
    const auto missed = std::find(reached.begin(), reached.end(), false);
    if (missed == reached.end()) return;
    throw Error(ErrorKind::kBadInput,
                fmt::format("body {}: its {} {} reaches no brick and no triangle; make the part it selects at least "
                            "a brick large, or let its flat box lie in a face of the body",
                            body + 1, what, missed - reached.begin() + 1));
  };
  check(pushed, "force");
  check(pulled, "muscle");
}

std::vector<std::vector<ForcedWhole>> forced_wholes(const Scene& scene, const std::vector<Origin>& origins) {
  std::map<std::pair<std::size_t, int>, std::vector<ForcedWhole>> by_copy;
  for (const Origin& origin : origins) {
    std::vector<ForcedWhole>& wholes = by_copy[{origin.body, origin.copy}];
    wholes.resize(scene.bodies[origin.body].forces.size());
    for (const ForcedPart& part : origin.forces) {
      ForcedWhole& whole = wholes[part.force];
      whole.size += part.shares.sum();
      if (part.arms.rows() > 0) whole.arm += part.arms.colwise().sum().transpose();
      whole.second += part.second;
    }
  }
  std::vector<std::vector<ForcedWhole>> wholes;
  for (const Origin& origin : origins) wholes.push_back(by_copy[{origin.body, origin.copy}]);
  return wholes;
}

namespace {

/// Tractions turn x arm about the centroid of the whole that have that moment (N m) and no resultant; `turn` in Pa/m.
Points moment_forces(const Vec3& moment, const ForcedPart& part, const ForcedWhole& whole) {
  const Vec3 centroid = whole.arm / whole.size;
  const Mat3 second = whole.second - whole.size * centroid * centroid.transpose();
  const Vec3 turn = (second.trace() * Mat3::Identity() - second).ldlt().solve(moment);
  const Points arms = part.arms - part.shares * centroid.transpose();
  Points forces(arms.rows(), 3);
  for (Eigen::Index node = 0; node < arms.rows(); ++node) {
    forces.row(node) = turn.cross(arms.row(node).transpose()).transpose();
  }
  return forces;
}

/// N, per node.
Points dead_forces(const BodyForce& force, const ForcedPart& part, const ForcedWhole& whole) {
  if (force.moment) return moment_forces(*force.moment, part, whole);
  if (force.traction) return part.shares * force.traction->transpose();
  if (force.per_volume) return part.shares * force.per_volume->transpose();
  return part.shares * (force.total.value() / whole.size).transpose();
}

}  // namespace

void add_load(const BodyForce& force, const ForcedPart& part, const ForcedWhole& whole, double strength, Loads& loads) {
  if (force.pressure) {
    loads.pressures.push_back({.part = part.skin, .pressure = strength * *force.pressure});
    return;
  }
  if (loads.forces.rows() == 0) loads.forces = Points::Zero(part.shares.size(), 3);
  loads.forces += strength * dead_forces(force, part, whole);
}

Loads loads_and_weight(const Scene& scene, const Simulation& simulation, std::size_t row,
                       const std::vector<ForcedWhole>& wholes) {
  const Origin& origin = simulation.origins[row];
  Loads loads;
  loads.forces = simulation.world.bodies[row].masses * simulation.world.gravity.transpose();
  for (const ForcedPart& part : origin.forces) {
    add_load(scene.bodies[origin.body].forces[part.force], part, wholes[part.force], 1, loads);
  }
  return loads;
}

}  // namespace sprung
