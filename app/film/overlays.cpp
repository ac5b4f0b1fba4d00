#include "app/film/overlays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "core/bricks/brick_topology.h"
#include "render/stage/camera.h"

namespace sprung {
namespace {

constexpr int kSides = 3;
constexpr int kRodVertices = 2 * kSides;
constexpr int kRodTriangles = 2 * kSides;

constexpr std::array<std::array<int, 3>, 8> kOctahedron{
    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};

/// A unit sphere: an octahedron, each of its triangles divided into 4 again and again.
RoundShape round_shape(int divisions) {
  RoundShape shape;
  for (int k = 0; k < 6; ++k) shape.positions.emplace_back((k % 2 == 0 ? 1 : -1) * Vec3::Unit(k / 2));
  shape.triangles.assign(kOctahedron.begin(), kOctahedron.end());
  for (int division = 0; division < divisions; ++division) {
    std::map<std::pair<int, int>, int> middles;
    const auto between = [&](int a, int b) {
      const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), isize(shape.positions));
      if (is_new) shape.positions.push_back((shape.positions[a] + shape.positions[b]).normalized());
      return found->second;
    };
    std::vector<std::array<int, 3>> parts;
    for (const auto& [a, b, c] : shape.triangles) {
      const int ab = between(a, b);
      const int bc = between(b, c);
      const int ca = between(c, a);
      parts.insert(parts.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    shape.triangles = std::move(parts);
  }
  return shape;
}

/// The finest subdivision at which that many balls are drawn quickly.
int divisions_of(std::size_t balls) {
  constexpr std::size_t kManyTriangles = 200'000;
  int divisions = 3;
  while (divisions > 1 && balls * (kOctahedron.size() << (2 * divisions)) > kManyTriangles) --divisions;
  return divisions;
}

void reserve(Skin& skin, Eigen::Index vertices, Eigen::Index triangles) {
  skin.positions = Points::Zero(vertices, 3);
  skin.normals = Points::Zero(vertices, 3);
  skin.triangles.resize(triangles, 3);
}

Eigen::VectorXf of_vertices(const Eigen::VectorXd& of_rods) {
  return of_rods.transpose().replicate<kRodVertices, 1>().reshaped().cast<float>();
}

}  // namespace

Rods::Rods(std::size_t count, double radius) : radius_(radius) {
  const Eigen::Index rods = count;
  reserve(skin_, kRodVertices * rods, kRodTriangles * rods);
  for (Eigen::Index rod = 0; rod < rods; ++rod) {
    const auto first = int(kRodVertices * rod);
    for (int side = 0; side < kSides; ++side) {
      const int next = (side + 1) % kSides;
      const Eigen::Index triangle = kRodTriangles * rod + 2 * side;
      skin_.triangles.row(triangle) << first + side, first + next, first + kSides + next;
      skin_.triangles.row(triangle + 1) << first + side, first + kSides + next, first + kSides + side;
    }
  }
}

SkinShape Rods::shape(const Points& from, const Points& to, const RodLooks& looks) const {
  SkinShape shape;
  shape.positions.resize(kRodVertices * from.rows(), 3);
  shape.normals.resize(kRodVertices * from.rows(), 3);
  shape.map_coordinates = of_vertices(looks.coordinates);
  shape.opacities = of_vertices(looks.opacities);
  for (Eigen::Index rod = 0; rod < from.rows(); ++rod) {
    Vec3 way = to.row(rod) - from.row(rod);
    if (way.isZero(0)) way = Vec3::UnitX();  // zero length: invisible, but finite
    const double radius = looks.widths.size() > 0 ? looks.widths[rod] * radius_ : radius_;
    const Vec3 across = way.unitOrthogonal();
    const Vec3 third = way.stableNormalized().cross(across);
    for (int vertex = 0; vertex < kRodVertices; ++vertex) {
      const double angle = 2 * std::numbers::pi * (vertex % kSides) / kSides;
      const Vec3 normal = std::cos(angle) * across + std::sin(angle) * third;
      const Eigen::Index row = kRodVertices * rod + vertex;
      const Vec3 end = vertex < kSides ? from.row(rod) : to.row(rod);
      shape.positions.row(row) = (end + radius * normal).cast<float>().transpose();
      shape.normals.row(row) = normal.cast<float>().transpose();
    }
  }
  return shape;
}

SkinShape Rods::between(const Points& points, const std::vector<std::array<int, 2>>& pairs,
                        const RodLooks& looks) const {
  Points from(pairs.size(), 3);
  Points to(pairs.size(), 3);
  for (Eigen::Index i = 0; i < from.rows(); ++i) {
    from.row(i) = points.row(pairs[i][0]);
    to.row(i) = points.row(pairs[i][1]);
  }
  return shape(from, to, looks);
}

std::vector<std::array<int, 2>> edges_of(const Triangles& triangles) {
  std::vector<std::array<int, 2>> edges;
  for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({triangles(i, k), triangles(i, (k + 1) % 3)});
      edges.push_back({low, high});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

Balls::Balls(std::size_t count, double radius) : radius_(radius), round_(round_shape(divisions_of(count))) {
  const Eigen::Index balls = count;
  const Eigen::Index vertices = round_.positions.size();
  reserve(skin_, vertices * balls, Eigen::Index(round_.triangles.size()) * balls);
  Eigen::Index triangle = 0;
  for (Eigen::Index ball = 0; ball < balls; ++ball) {
    const auto first = int(vertices * ball);
    for (const auto& corners : round_.triangles) {
      skin_.triangles.row(triangle++) << first + corners[0], first + corners[1], first + corners[2];
    }
  }
}

SkinShape Balls::shape(const Points& centers, const Vec3& idle) const {
  const std::vector<Vec3>& positions = round_.positions;
  const Eigen::Index vertices = positions.size();
  const Eigen::Index count = skin_.positions.rows() / vertices;
  SkinShape shape;
  shape.positions.resize(skin_.positions.rows(), 3);
  shape.normals.resize(skin_.positions.rows(), 3);
  for (Eigen::Index ball = 0; ball < count; ++ball) {
    const bool is_shown = ball < centers.rows();
    const Vec3 middle = is_shown ? Vec3(centers.row(ball).transpose()) : idle;
    for (Eigen::Index vertex = 0; vertex < vertices; ++vertex) {
      const Vec3& normal = positions[vertex];
      const Eigen::Index row = vertices * ball + vertex;
      shape.positions.row(row) = (middle + (is_shown ? radius_ : 0) * normal).cast<float>().transpose();
      shape.normals.row(row) = normal.cast<float>().transpose();
    }
  }
  return shape;
}

Eigen::VectorXd SpringSet::stretches(const Points& positions) const {
  Eigen::VectorXd values(rest.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const auto& [a, b] = nodes[i];
    values[i] = (positions.row(b) - positions.row(a)).norm() / rest[i] - 1;
  }
  return values;
}

SpringSet springs_of(const Body& body, const std::vector<bool>& shown) {
  SpringSet springs;
  const auto add = [&](const std::array<int, 8>& brick, const auto& pairs) {
    for (const auto& [from, to] : pairs) {
      const int a = brick[from];
      const int b = brick[to];
      springs.nodes.push_back({std::min(a, b), std::max(a, b)});
    }
  };
  for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
    if (!shown[brick]) continue;
    add(body.grid.nodes[brick], kEdges);
    if (body.law.face != 0 || body.model == Model::kCalibrated) add(body.grid.nodes[brick], kFaceDiagonals);
    if (body.law.inner != 0) add(body.grid.nodes[brick], kInnerDiagonals);
  }
  std::sort(springs.nodes.begin(), springs.nodes.end());
  springs.nodes.erase(std::unique(springs.nodes.begin(), springs.nodes.end()), springs.nodes.end());
  springs.rest.resize(springs.nodes.size());
  for (Eigen::Index i = 0; i < springs.rest.size(); ++i) {
    const auto& [a, b] = springs.nodes[i];
    springs.rest[i] = (body.rest_positions.row(b) - body.rest_positions.row(a)).norm();
  }
  return springs;
}

namespace {

constexpr double kNear = 0.08;  // of a brick: largest distance that counts as contact
constexpr double kCell = 0.5;   // of a brick

bool is_within(const AlignedBox& bounds, const Vec3& position, double margin) {
  return ((position - bounds.min()).array() > -margin).all() && ((bounds.max() - position).array() > -margin).all();
}

bool are_near(const AlignedBox& a, const AlignedBox& b, double margin) {
  return ((a.min() - b.max()).array() < margin).all() && ((b.min() - a.max()).array() < margin).all();
}

/// Points, at most one per cell.
class ThinnedPoints {
 public:
  void set_cell(double cell) { cell_ = cell; }
  void add(const Vec3& position) {
    const auto at = [&](int k) { return std::lround(std::floor(position[k] / cell_)); };
    if (cells_.insert({at(0), at(1), at(2)}).second) places_.push_back(position);
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

Contacts::Contacts(const Simulation& simulation)
    : simulation_(simulation), ground_(ground_height(simulation.world.obstacles)) {
  for (const StageObstacle& obstacle : simulation.obstacles) {
    if (obstacle.skin.triangles.rows() == 0) continue;
    solids_.push_back({&obstacle, NearestTriangle(obstacle.skin.positions, obstacle.skin.triangles)});
  }
}

Points Contacts::at(const std::vector<Points>& nodes, double time) const {
  std::vector<Points> skins;
  std::vector<AlignedBox> bounds;
  for (std::size_t body = 0; body < nodes.size(); ++body) {
    skins.push_back(simulation_.world.bodies[body].skin_positions(nodes[body]));
    bounds.push_back(bounding_box(skins.back()));
  }
  ThinnedPoints found;
  for (std::size_t body = 0; body < nodes.size(); ++body) {
    const double brick = simulation_.world.bodies[body].grid.brick_size;
    const double near = kNear * brick;
    found.set_cell(kCell * brick);
    for (const auto& vertex : skins[body].rowwise()) {
      if (ground_ && vertex.y() - *ground_ < near) found.add(vertex.transpose());
    }
    for (const Solid& solid : solids_) {
      const Pose pose = pose_at(*solid.obstacle, time);
      const AlignedBox room = bounding_box(solid.obstacle->skin.positions);
      for (const auto& vertex : skins[body].rowwise()) {
        const Vec3 position = pose.rotation.transpose() * (vertex.transpose() - pose.translation);
        if (is_within(room, position, near) && solid.surface.at(position).distance < near)
          found.add(vertex.transpose());
      }
    }
    for (std::size_t other = 0; other < nodes.size(); ++other) {
      if (other == body || !are_near(bounds[body], bounds[other], near)) continue;
      const NearestTriangle surface(skins[other], simulation_.world.bodies[other].drawn.skin.triangles);
      for (const auto& vertex : skins[body].rowwise()) {
        const Vec3 position = vertex.transpose();
        if (is_within(bounds[other], position, near) && surface.at(position).distance < near) found.add(position);
      }
    }
  }
  return found.points();
}

std::vector<bool> bricks_left(const BrickGrid& grid, const std::optional<HalfSpace>& cut) {
  std::vector<bool> left(grid.cells.size(), true);
  if (!cut) return left;
  Eigen::Array3d low = Eigen::Array3d::Constant(1e300);
  Eigen::Array3d high = -low;
  for (const Eigen::Vector3i& cell : grid.cells) {
    low = low.min(cell.cast<double>().array());
    high = high.max(cell.cast<double>().array() + 1);
  }
  const Vec3 point = low + cut->point.array() * (high - low);
  for (std::size_t brick = 0; brick < left.size(); ++brick) {
    const Vec3 middle = grid.cells[brick].cast<double>().array() + 0.5;
    left[brick] = (middle - point).dot(cut->normal) <= 0;
  }
  return left;
}

}  // namespace sprung
