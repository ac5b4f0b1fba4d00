#include "app/film/rods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace sprung {
namespace {

constexpr int kSides = 3;
constexpr int kRodVertices = 2 * kSides;
constexpr int kRodTriangles = 2 * kSides;

constexpr std::array<std::array<int, 3>, 8> kOctahedron{
    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};

/// An octahedron with each face cut in four, pushed out onto the unit ball.
struct RoundShape {
  std::vector<Vec3> places;
  std::vector<std::array<int, 3>> triangles;

  RoundShape() {
    for (int k = 0; k < 6; ++k) places.emplace_back((k % 2 == 0 ? 1 : -1) * Vec3::Unit(k / 2));
    for (const auto& [a, b, c] : kOctahedron) {
      const int ab = between(a, b);
      const int bc = between(b, c);
      const int ca = between(c, a);
      for (const std::array<int, 3>& part : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
        triangles.push_back(part);
      }
    }
  }

 private:
  std::map<std::pair<int, int>, int> middles_;

  int between(int a, int b) {
    const auto [found, is_new] = middles_.try_emplace(std::minmax(a, b), isize(places));
    if (is_new) places.push_back((places[a] + places[b]).normalized());
    return found->second;
  }
};

const RoundShape& round_shape() {
  static const RoundShape shape;
  return shape;
}

void reserve(Skin& skin, Eigen::Index vertices, Eigen::Index triangles) {
  skin.positions = Points::Zero(vertices, 3);
  skin.normals = Points::Zero(vertices, 3);
  skin.triangles.resize(triangles, 3);
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

SkinShape Rods::shape(const Points& from, const Points& to, const Eigen::VectorXd& shares) const {
  SkinShape shape;
  shape.positions.resize(kRodVertices * from.rows(), 3);
  shape.normals.resize(kRodVertices * from.rows(), 3);
  if (shares.size() > 0) shape.shares.resize(kRodVertices * from.rows());
  for (Eigen::Index rod = 0; rod < from.rows(); ++rod) {
    const Vec3 way = to.row(rod) - from.row(rod);
    const Vec3 across = way.unitOrthogonal();
    const Vec3 third = way.stableNormalized().cross(across);
    for (int vertex = 0; vertex < kRodVertices; ++vertex) {
      const double angle = 2 * std::numbers::pi * (vertex % kSides) / kSides;
      const Vec3 normal = std::cos(angle) * across + std::sin(angle) * third;
      const Eigen::Index row = kRodVertices * rod + vertex;
      const Vec3 end = vertex < kSides ? from.row(rod) : to.row(rod);
      shape.positions.row(row) = (end + radius_ * normal).cast<float>().transpose();
      shape.normals.row(row) = normal.cast<float>().transpose();
      if (shares.size() > 0) shape.shares[row] = float(shares[rod]);
    }
  }
  return shape;
}

Balls::Balls(std::size_t count, double radius) : radius_(radius) {
  const Eigen::Index balls = count;
  const RoundShape& round = round_shape();
  const Eigen::Index vertices = round.places.size();
  reserve(skin_, vertices * balls, Eigen::Index(round.triangles.size()) * balls);
  Eigen::Index triangle = 0;
  for (Eigen::Index ball = 0; ball < balls; ++ball) {
    const auto first = int(vertices * ball);
    for (const auto& corners : round.triangles) {
      skin_.triangles.row(triangle++) << first + corners[0], first + corners[1], first + corners[2];
    }
  }
}

SkinShape Balls::shape(const Points& middles, const Vec3& idle) const {
  const std::vector<Vec3>& places = round_shape().places;
  const Eigen::Index vertices = places.size();
  const Eigen::Index count = skin_.positions.rows() / vertices;
  SkinShape shape;
  shape.positions.resize(skin_.positions.rows(), 3);
  shape.normals.resize(skin_.positions.rows(), 3);
  for (Eigen::Index ball = 0; ball < count; ++ball) {
    const bool is_shown = ball < middles.rows();
    const Vec3 middle = is_shown ? Vec3(middles.row(ball).transpose()) : idle;
    for (Eigen::Index vertex = 0; vertex < vertices; ++vertex) {
      const Vec3& normal = places[vertex];
      const Eigen::Index row = vertices * ball + vertex;
      shape.positions.row(row) = (middle + (is_shown ? radius_ : 0) * normal).cast<float>().transpose();
      shape.normals.row(row) = normal.cast<float>().transpose();
    }
  }
  return shape;
}

}  // namespace sprung
