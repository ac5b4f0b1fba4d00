#include "assets/models/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace sprung::models {
namespace {

/// Smaller of two values, rounded where they differ by less than `blend`: the cubic of Quilez, "smooth minimum".
double smooth_min(double a, double b, double blend) {
  if (blend <= 0) return std::min(a, b);
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * h * blend / 6;
}

/// Enough that the nearest sample of a curve is near its nearest point, for curves that turn a few times.
constexpr int kSamples = 72;

/// The place of the smallest distance within one sample of `start`, by Newton's method on finite differences; clamped
/// to the ends of an open curve.
double refine_nearest(const Curve& curve, const Vec3& p, double start, bool closed) {
  constexpr double kStep = 1e-4;
  const auto at = [&](double t) { return curve(closed ? t - std::floor(t) : t); };
  const double low = closed ? start - 1.0 / kSamples : std::max(start - 1.0 / kSamples, 0.0);
  const double high = closed ? start + 1.0 / kSamples : std::min(start + 1.0 / kSamples, 1.0);
  double t = start;
  for (int i = 0; i < 8; ++i) {
    const Vec3 here = at(t);
    const Vec3 after = at(t + kStep);
    const Vec3 before = at(t - kStep);
    const Vec3 velocity = (after - before) / (2 * kStep);
    const Vec3 bend = (after - 2 * here + before) / (kStep * kStep);
    const double slope = (here - p).dot(velocity);
    const double growth = std::max(velocity.squaredNorm() + (here - p).dot(bend), 0.1 * velocity.squaredNorm());
    const double next = std::clamp(t - slope / growth, low, high);
    const bool settled = std::abs(next - t) < 1e-8;
    t = next;
    if (settled) break;
  }
  return closed ? t - std::floor(t) : t;
}

std::vector<Vec3> sample(const Curve& curve) {
  std::vector<Vec3> samples;
  for (int i = 0; i <= kSamples; ++i) samples.push_back(curve(double(i) / kSamples));
  return samples;
}

double place_of_nearest(const std::vector<Vec3>& samples, const Vec3& p) {
  const auto nearer = [&](const Vec3& a, const Vec3& b) { return (a - p).squaredNorm() < (b - p).squaredNorm(); };
  return double(std::min_element(samples.begin(), samples.end(), nearer) - samples.begin()) / kSamples;
}

}  // namespace

Shape ball(const Vec3& center, double radius) {
  return [=](const Vec3& p) { return (p - center).norm() - radius; };
}

Shape ellipsoid(const Vec3& center, const Vec3& radii) {
  return [=](const Vec3& p) {
    const Vec3 q = (p - center).cwiseQuotient(radii);
    const double slope = q.cwiseQuotient(radii).norm();
    const double k = q.norm();
    return slope < 1e-12 ? -radii.minCoeff() : k * (k - 1) / slope;
  };
}

Shape limb(const Vec3& from, double from_radius, const Vec3& to, double to_radius) {
  const Vec3 axis = to - from;
  const double slope = from_radius - to_radius;
  return [=](const Vec3& p) {
    // Nearest place on the axis, leant by the cone's opening so that the distance is exact on its flank.
    const double along = (p - from).dot(axis);
    const double across = std::sqrt(std::max((p - from).squaredNorm() * axis.squaredNorm() - along * along, 0.0));
    const double lean = slope / std::sqrt(axis.squaredNorm() - slope * slope);
    const double t = std::clamp((along - across * lean) / axis.squaredNorm(), 0.0, 1.0);
    return (p - from - t * axis).norm() - (from_radius - t * slope);
  };
}

Place nearest_place(Curve curve, bool closed) {
  std::vector<Vec3> samples = sample(curve);
  return [closed, curve = std::move(curve), samples = std::move(samples)](const Vec3& p) {
    return refine_nearest(curve, p, place_of_nearest(samples, p), closed);
  };
}

Shape tube(Curve curve, Width radius, bool closed) {
  constexpr double kFar = 3;  // cm from the ball about the curve; the distance to that will do there
  Place nearest = nearest_place(curve, closed);
  const std::vector<Vec3> samples = sample(curve);
  const Vec3 middle = std::accumulate(samples.begin(), samples.end(), Vec3(Vec3::Zero())) / (kSamples + 1);
  double reach = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const auto at = std::size_t(i);
    reach = std::max(reach, (samples[at] - middle).norm() + radius(double(i) / kSamples));
  }
  return [=, curve = std::move(curve), radius = std::move(radius), nearest = std::move(nearest)](const Vec3& p) {
    if (const double rough = (p - middle).norm() - reach; rough > kFar) return rough;
    const double t = nearest(p);
    return (p - curve(t)).norm() - radius(t);
  };
}

Shape above(double height) {
  return [=](const Vec3& p) { return height - p.y(); };
}

Shape flipped(Shape shape, const Vec3& center, const Vec3& axis, double degrees) {
  const Mat3 back = Eigen::AngleAxisd(-degrees * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
  return [=, shape = std::move(shape)](const Vec3& p) { return shape(center + back * (p - center)); };
}

Shape mirrored(Shape shape) {
  return [shape = std::move(shape)](const Vec3& p) { return shape(Vec3(std::abs(p.x()), p.y(), p.z())); };
}

Shape join(Shape a, Shape b, double blend) {
  return [=, a = std::move(a), b = std::move(b)](const Vec3& p) { return smooth_min(a(p), b(p), blend); };
}

Shape carve(Shape a, Shape b, double blend) {
  return [=, a = std::move(a), b = std::move(b)](const Vec3& p) { return -smooth_min(-a(p), b(p), blend); };
}

Shape meet(Shape a, Shape b, double blend) {
  return [=, a = std::move(a), b = std::move(b)](const Vec3& p) { return -smooth_min(-a(p), -b(p), blend); };
}

Shape grown(Shape shape, double distance) {
  return [=, shape = std::move(shape)](const Vec3& p) { return shape(p) - distance; };
}

Curve bezier(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return [=](double t) -> Vec3 {
    const double s = 1 - t;
    return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
  };
}

Vec3 gradient(const Shape& shape, const Vec3& p, double step) {
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 offset = step * Vec3::Unit(axis);
    result[axis] = (shape(p + offset) - shape(p - offset)) / (2 * step);
  }
  return result;
}

}  // namespace sprung::models
