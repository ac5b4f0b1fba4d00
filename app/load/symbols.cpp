#include "app/load/symbols.h"

#include <cmath>
#include <numbers>

namespace sprung {
namespace {

constexpr int kSides = 24;
constexpr int kBallRings = 12;
constexpr double kShaft = 0.035;  // radius, of an arrow's length
constexpr double kHead = 0.10;    // radius of its head
constexpr double kHeadLength = 0.32;

}  // namespace

int Symbols::add_ring(const Vec3& centre, const Vec3& axis, double radius, double lean) {
  const int first = isize(points_);
  const Vec3 across = axis.unitOrthogonal();
  const Vec3 third = axis.cross(across);
  for (int side = 0; side < kSides; ++side) {
    const double angle = 2 * std::numbers::pi * side / kSides;
    const Vec3 out = std::cos(angle) * across + std::sin(angle) * third;
    points_.emplace_back(centre + radius * out);
    normals_.emplace_back((out + lean * axis).normalized());
  }
  return first;
}

void Symbols::add_band(int first, int second) {
  for (int side = 0; side < kSides; ++side) {
    const int next = (side + 1) % kSides;
    triangles_.emplace_back(first + side, first + next, second + next);
    triangles_.emplace_back(first + side, second + next, second + side);
  }
}

void Symbols::add_cone(const Vec3& base, const Vec3& along, double radius) {
  const Vec3 axis = along.normalized();
  const double lean = radius / along.norm();
  constexpr double kFlat = 1e6;  // the normals of the base point along the axis
  const int middle = add_ring(base, axis, 0, -kFlat);
  const int rim = add_ring(base, axis, radius, -kFlat);
  add_band(middle, rim);
  const int side = add_ring(base, axis, radius, lean);
  const int tip = add_ring(base + along, axis, 0, lean);
  add_band(side, tip);
}

void Symbols::add_arrow(const Vec3& tail, const Vec3& tip, int heads) {
  const Vec3 way = tip - tail;
  const double length = way.norm();
  const Vec3 axis = way.normalized();
  const Vec3 neck = tip - kHeadLength * heads * way;
  const int begin = add_ring(tail, axis, kShaft * length, 0);
  const int end = add_ring(neck, axis, kShaft * length, 0);
  add_band(begin, end);
  for (int head = 0; head < heads; ++head) {
    add_cone(tip - kHeadLength * (head + 1) * way, kHeadLength * way, kHead * length);
  }
}

void Symbols::add_ball(const Vec3& centre, double radius) {
  int last = -1;
  for (int ring = 0; ring <= kBallRings; ++ring) {
    const double angle = std::numbers::pi * ring / kBallRings;
    const double out = std::sin(angle);
    const double up = -std::cos(angle);
    const int now =
        add_ring(centre + radius * up * Vec3::UnitY(), Vec3::UnitY(), radius * out, up / std::max(out, 1e-6));
    if (last >= 0) add_band(last, now);
    last = now;
  }
}

Points Symbols::points() const {
  Points points(isize(points_), 3);
  for (int row = 0; row < isize(points_); ++row) points.row(row) = points_[row].transpose();
  return points;
}

Skin Symbols::skin() const {
  Skin skin;
  skin.positions = points();
  skin.normals.resize(isize(normals_), 3);
  for (int row = 0; row < isize(normals_); ++row) skin.normals.row(row) = normals_[row].transpose();
  skin.triangles.resize(isize(triangles_), 3);
  for (int row = 0; row < isize(triangles_); ++row) skin.triangles.row(row) = triangles_[row].transpose();
  return skin;
}

}  // namespace sprung
