#include "core/contact/pairs/closest_features.h"

#include <algorithm>
#include <array>
#include <limits>

namespace sprung {
namespace {

constexpr double kParallel = 1e-12;  // squared sine between edges, up to which they count as parallel

/// The same where the triangle has no area: to the nearest of its sides.
FeatureDistance point_to_line(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<Vec3, 3> corners{a, b, c};
  FeatureDistance nearest{Vec3::Constant(std::numeric_limits<double>::infinity()), {}};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const FeatureDistance side = edge_to_edge(point, point, corners[i], corners[j]);
    if (!(side.apart.squaredNorm() < nearest.apart.squaredNorm())) continue;
    nearest = {side.apart, {1, 0, 0, 0}};
    nearest.weights[1 + i] = side.weights[2];
    nearest.weights[1 + j] = side.weights[3];
  }
  return nearest;
}

}  // namespace

FeatureDistance point_to_triangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  if (ab.cross(ac).squaredNorm() <= kParallel * std::max(ab.squaredNorm(), ac.squaredNorm()) * ac.squaredNorm()) {
    return point_to_line(point, a, b, c);
  }
  const Vec3 ap = point - a;
  const auto at = [&](double u, double v) { return FeatureDistance{ap - u * ab - v * ac, {1, u + v - 1, -u, -v}}; };
  const double ab_ap = ab.dot(ap);
  const double ac_ap = ac.dot(ap);
  if (ab_ap <= 0 && ac_ap <= 0) return at(0, 0);
  const Vec3 bp = point - b;
  const double ab_bp = ab.dot(bp);
  const double ac_bp = ac.dot(bp);
  if (ab_bp >= 0 && ac_bp <= ab_bp) return at(1, 0);
  const double area_c = ab_ap * ac_bp - ab_bp * ac_ap;
  if (area_c <= 0 && ab_ap >= 0 && ab_bp <= 0) return at(ab_ap / (ab_ap - ab_bp), 0);
  const Vec3 cp = point - c;
  const double ab_cp = ab.dot(cp);
  const double ac_cp = ac.dot(cp);
  if (ac_cp >= 0 && ab_cp <= ac_cp) return at(0, 1);
  const double area_b = ab_cp * ac_ap - ab_ap * ac_cp;
  if (area_b <= 0 && ac_ap >= 0 && ac_cp <= 0) return at(0, ac_ap / (ac_ap - ac_cp));
  const double area_a = ab_bp * ac_cp - ab_cp * ac_bp;
  const double to_c = ac_bp - ab_bp;
  const double to_b = ab_cp - ac_cp;
  if (area_a <= 0 && to_c >= 0 && to_b >= 0) {
    const double v = to_c / (to_c + to_b);
    return at(1 - v, v);
  }
  const double all = area_a + area_b + area_c;
  return at(area_b / all, area_c / all);
}

FeatureDistance edge_to_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a;
  const Vec3 cd = d - c;
  const Vec3 ca = a - c;
  const double ab_ab = ab.squaredNorm();
  const double cd_cd = cd.squaredNorm();
  const double ab_cd = ab.dot(cd);
  const double ab_ca = ab.dot(ca);
  const double cd_ca = cd.dot(ca);
  const auto share = [](double part, double all) { return all > 0 ? std::clamp(part / all, 0.0, 1.0) : 0.0; };
  const double sine = ab_ab * cd_cd - ab_cd * ab_cd;
  double s = sine > kParallel * ab_ab * cd_cd ? share(ab_cd * cd_ca - ab_ca * cd_cd, sine) : 0.5;
  const double t = share(ab_cd * s + cd_ca, cd_cd);
  s = share(ab_cd * t - ab_ca, ab_ab);
  return {ca + s * ab - t * cd, {1 - s, s, t - 1, -t}};
}

}  // namespace sprung
