#include "app/scene/resting_pose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sprung {
namespace {

constexpr double kTilt = 15;          // degrees
constexpr double kFinestTilt = 0.02;  // degrees
constexpr int kDirections = 16;       // in which a body is tilted
constexpr double kNeutral = 0.02;     // of the height of the centre of mass: a sphere does not count as falling
constexpr Eigen::Index kMaxPoints = 20000;

/// A body and the ground, in the frame of the body.
class BodyOnGround {
 public:
  BodyOnGround(const Points& points, const Vec3& centre) {
    const Eigen::Index stride = (points.rows() + kMaxPoints - 1) / kMaxPoints;
    spokes_.resize((points.rows() + stride - 1) / stride, 3);
    for (Eigen::Index row = 0; row < spokes_.rows(); ++row) {
      spokes_.row(row) = points.row(row * stride) - centre.transpose();
    }
  }

  /// Height of the centre of mass above ground that touches the body in the direction `down`.
  double height(const Vec3& down) const { return (spokes_ * down).maxCoeff(); }

  /// `down` tilted by an angle (degrees) to one of kDirections.
  static Vec3 tilted(const Vec3& down, double angle, int k) {
    const Vec3 u = down.unitOrthogonal();
    const double tilt = angle * std::numbers::pi / 180;
    const double turn = 2 * std::numbers::pi * k / kDirections;
    return std::cos(tilt) * down + std::sin(tilt) * (std::cos(turn) * u + std::sin(turn) * down.cross(u));
  }

  struct Lowest {
    Vec3 down;
    double height;
  };
  /// The lowest among the directions that are tilted by an angle (degrees).
  Lowest lowest_tilted(const Vec3& down, double angle) const {
    Lowest lowest{down, std::numeric_limits<double>::max()};
    for (int k = 0; k < kDirections; ++k) {
      const Vec3 direction = tilted(down, angle, k);
      const double found = height(direction);
      if (found < lowest.height) lowest = {direction.normalized(), found};
    }
    return lowest;
  }

 private:
  Points spokes_;  // from the centre of mass
};

const Vec3 kDown = -Vec3::UnitY();

}  // namespace

Vec3 centre_of_mass(const SurfaceMesh& mesh) {
  constexpr double kEmpty = 1e-4;  // of the bounding box: what encloses so little is a surface
  const Vec3 low = mesh.positions.colwise().minCoeff();
  const Vec3 sides = mesh.positions.colwise().maxCoeff().transpose() - low;
  double volume = 0;
  double area = 0;
  Vec3 volume_moment = Vec3::Zero();
  Vec3 area_moment = Vec3::Zero();
  for (Eigen::Index row = 0; row < mesh.triangles.rows(); ++row) {
    const Vec3 a = mesh.positions.row(mesh.triangles(row, 0)).transpose() - low;
    const Vec3 b = mesh.positions.row(mesh.triangles(row, 1)).transpose() - low;
    const Vec3 c = mesh.positions.row(mesh.triangles(row, 2)).transpose() - low;
    const double six_volumes = a.dot(b.cross(c));
    const double two_areas = (b - a).cross(c - a).norm();
    volume += six_volumes / 6;
    area += two_areas / 2;
    volume_moment += six_volumes / 24 * (a + b + c);
    area_moment += two_areas / 6 * (a + b + c);
  }
  if (std::abs(volume) > kEmpty * sides.prod()) return low + volume_moment / volume;
  return area > 0 ? Vec3(low + area_moment / area) : Vec3(low + sides / 2);
}

Mat3 rolled_to_rest(const Points& points, const Vec3& centre_of_mass) {
  const BodyOnGround body(points, centre_of_mass);
  Vec3 down = kDown;
  double height = body.height(down);
  const double rounding = 1e-9 * height;
  for (double tilt = kTilt; tilt > kFinestTilt;) {
    const BodyOnGround::Lowest next = body.lowest_tilted(down, tilt);
    if (next.height < height - rounding) {
      down = next.down;
      height = next.height;
    } else {
      tilt /= 2;
    }
  }
  if (height >= (1 - kNeutral) * body.height(kDown)) return Mat3::Identity();
  return Eigen::Quaterniond::FromTwoVectors(down, kDown).toRotationMatrix();
}

double tipping_rise(const Points& points, const Vec3& centre_of_mass) {
  constexpr double kStep = 5;       // degrees
  constexpr double kFarthest = 90;  // degrees
  const BodyOnGround body(points, centre_of_mass);
  double least = std::numeric_limits<double>::max();
  for (int k = 0; k < kDirections; ++k) {
    double highest = body.height(kDown);
    for (double tilt = kStep; tilt <= kFarthest; tilt += kStep) {
      highest = std::max(highest, body.height(BodyOnGround::tilted(kDown, tilt, k)));
    }
    least = std::min(least, highest);
  }
  return least - body.height(kDown);
}

}  // namespace sprung
