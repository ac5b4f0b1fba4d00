#include "core/simulation/skin_supports.h"

#include "core/bricks/embedding.h"
#include "core/simulation/drivers.h"
#include "core/simulation/skin_pieces.h"

namespace sprung {
namespace {

Vec3 normal_area(const Points& points, const Triangles& triangles, int row) {
  const Vec3 a = points.row(triangles(row, 0));
  const Vec3 b = points.row(triangles(row, 1));
  const Vec3 c = points.row(triangles(row, 2));
  return (b - a).cross(c - a) / 2;
}

/// One point for each triangle of which pieces are held: their centroid.
PinnedSkin skin_of(const std::vector<SkinPiece>& pieces, const Points& points, const SoftBody& body) {
  const Triangles& triangles = body.drawn.skin.triangles;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<double> areas;
  int last = -1;
  for (const SkinPiece& piece : pieces) {
    const Vec3 normal = normal_area(points, triangles, piece.triangle);
    const double area = normal.norm() * piece.share();
    if (!(area > 0)) continue;
    if (piece.triangle != last) {
      last = piece.triangle;
      positions.emplace_back(Vec3::Zero());
      normals.push_back(normal);
      areas.push_back(0);
    }
    const Vec3 at = piece.corners.rowwise().mean();
    for (int corner = 0; corner < 3; ++corner) {
      positions.back() += area * at[corner] * points.row(triangles(piece.triangle, corner)).transpose();
    }
    areas.back() += area;
  }
  Points middles(isize(positions), 3);
  Points outward(isize(positions), 3);
  for (int row = 0; row < isize(positions); ++row) {
    middles.row(row) = positions[row].transpose() / areas[row];
    outward.row(row) = normals[row].transpose();
  }
  return {.points = embed(body.grid, middles, outward),
          .areas = Eigen::Map<const Eigen::VectorXd>(areas.data(), isize(areas))};
}

/// Onto the directions that a pin holds.
Mat3 pinned_directions(const Pin& pin) {
  if (pin.normal) return pin.normal->normalized() * pin.normal->normalized().transpose();
  return Vec3(pin.axes.fixed[0], pin.axes.fixed[1], pin.axes.fixed[2]).asDiagonal();
}

}  // namespace

std::vector<PinnedSkin> find_pinned_skins(const std::vector<Pin>& pins, const Selector& selector, const SoftBody& body,
                                          std::size_t solid) {
  std::vector<PinnedSkin> skins;
  for (std::size_t pin = 0; pin < pins.size(); ++pin) {
    if (!pins[pin].on_surface) continue;
    const Points points = deform_points(body.grid, body.drawn.embedding, body.grid.rest_positions());
    const std::vector<SkinPiece> pieces = selector.skin_pieces(pins[pin], points, body.drawn.skin.triangles, solid);
    PinnedSkin skin = skin_of(pieces, points, body);
    if (skin.areas.size() == 0) continue;
    skin.pin = pin;
    skin.centre = selector.centre(pins[pin]);
    skins.push_back(std::move(skin));
  }
  return skins;
}

std::vector<SpringSupport> springs_of(const PinnedSkin& skin, const Pin& pin, const Body& body) {
  const Mat3 projection = pinned_directions(pin);
  std::vector<SpringSupport> springs(skin.points.brick.size());
  for (std::size_t row = 0; row < springs.size(); ++row) {
    const int brick = skin.points.brick[row];
    const double young = body.material.young * body.stiffness_scale[brick] / body.grid.fill[brick];
    springs[row].spring = {.brick = brick,
                           .weights = trilinear_weights(skin.points.local.row(Eigen::Index(row))),
                           .stiffness = kFoundation * young / body.grid.brick_size * skin.areas[row] * projection};
  }
  return springs;
}

void set_foundations(const Scene& scene, const Origin& origin, double time, bool small, SoftBody& body) {
  body.foundations.clear();
  for (const PinnedSkin& skin : origin.pinned_skins) {
    std::vector<SpringSupport>& springs = body.foundations.emplace_back();
    const Pin& pin = scene.bodies[origin.body].pins[skin.pin];
    if (pin.from > 0) continue;
    springs = springs_of(skin, pin, body);
    const Movement movement = movement_of(pin, scene);
    const Points rest = deform_points(body.grid, skin.points, body.rest_positions);
    for (std::size_t row = 0; row < springs.size(); ++row) {
      const Vec3 arm = rest.row(Eigen::Index(row)).transpose() - skin.centre;
      springs[row].displacement =
          small ? movement.small_placement(time).velocity(arm) : movement.placement(time).way(arm);
    }
  }
}

SkinReaction reaction_of(const PinnedSkin& skin, const std::vector<SpringSupport>& springs, const Vec3& centre,
                         const Body& body, bool small) {
  SkinReaction reaction;
  const Points rest = deform_points(body.grid, skin.points, body.rest_positions);
  const Points displaced = deform_points(body.grid, skin.points, body.positions - body.rest_positions);
  for (Eigen::Index row = 0; row < rest.rows(); ++row) {
    const double area = skin.areas[row];
    reaction.area += area;
    reaction.position += area * (rest.row(row) + displaced.row(row)).transpose();
    reaction.displacement += area * displaced.row(row).transpose();
  }
  for (std::size_t row = 0; row < springs.size(); ++row) {
    const Vec3 start = rest.row(Eigen::Index(row));
    const Vec3 moved = displaced.row(Eigen::Index(row));
    const Vec3 force = springs[row].spring.stiffness * (springs[row].displacement - moved);
    reaction.force += force;
    reaction.torque += ((small ? start : Vec3(start + moved)) - centre).cross(force);
  }
  return reaction;
}

}  // namespace sprung
