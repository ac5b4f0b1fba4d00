#include "core/mesh/query/thickness.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/query/triangle_grid.h"

namespace sprung {
namespace {

constexpr double kMaxCells = 64;  // along the longest side
constexpr double kFewestCells = 4;
constexpr double kInside = 1e-7;  // cells: depth at which a ray starts, to clear the triangles around it

/// Twice the area vector, outward.
Vec3 area_vector(const Solid& solid, int t) {
  const Vec3 a = solid.points.row(solid.triangles(t, 0));
  return (solid.points.row(solid.triangles(t, 1)).transpose() - a)
      .cross(solid.points.row(solid.triangles(t, 2)).transpose() - a);
}

/// Cumulative areas of the triangles.
std::vector<double> running_areas(const Solid& solid) {
  std::vector<double> sums;
  sums.reserve(solid.triangles.rows());
  double sum = 0;
  for (int t = 0; t < solid.triangles.rows(); ++t) sums.push_back(sum += area_vector(solid, t).norm() / 2);
  return sums;
}

/// The i-th point of a sequence that fills a triangle evenly: the R2 sequence (Roberts 2018), folded.
Vec3 point_in(const Solid& solid, int t, int i) {
  constexpr double kPlastic = 1.32471795724474602596;
  double u = std::fmod(0.5 + i / kPlastic, 1.0);
  double v = std::fmod(0.5 + i / (kPlastic * kPlastic), 1.0);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const Vec3 a = solid.points.row(solid.triangles(t, 0));
  const Vec3 b = solid.points.row(solid.triangles(t, 1));
  const Vec3 c = solid.points.row(solid.triangles(t, 2));
  return a + u * (b - a) + v * (c - a);
}

}  // namespace

double surface_area(const Solid& solid) { return running_areas(solid).back(); }

std::vector<WallSample> sample_thickness(const Solid& solid, int count) {
  const std::vector<double> areas = running_areas(solid);
  const Vec3 low = solid.points.colwise().minCoeff();
  const Vec3 extent = solid.points.colwise().maxCoeff().transpose() - low;
  const double along = std::clamp(std::sqrt(double(solid.triangles.rows()) / 4), kFewestCells, kMaxCells);
  const double cell = extent.maxCoeff() / along;
  const Eigen::Vector3i counts = (extent / cell).array().ceil().max(1).cast<int>();
  const Points points = (solid.points.rowwise() - low.transpose()) / cell;
  const TriangleGrid triangles(points, solid.triangles, counts);

  std::vector<WallSample> samples;
  samples.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double at = areas.back() * (i + 0.5) / count;
    const auto found = std::lower_bound(areas.begin(), areas.end(), at);
    const auto t = int(found - areas.begin());
    const Vec3 outward = area_vector(solid, t).stableNormalized();
    const Vec3 position = point_in(solid, t, i);
    const double way = kInside + triangles.cast_ray((position - low) / cell - kInside * outward, -outward);
    const double thickness = solid.thickness > 0 ? solid.thickness : way * cell;
    if (std::isfinite(thickness)) samples.push_back({position, outward, thickness});
  }
  return samples;
}

std::vector<std::vector<WallSample>> sample_thickness(const std::vector<Solid>& solids, int count) {
  std::vector<double> areas;
  double sum = 0;
  for (const Solid& solid : solids) sum += areas.emplace_back(surface_area(solid));
  std::vector<std::vector<WallSample>> samples;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    samples.push_back(sample_thickness(solids[i], std::max(1, int(std::lround(count * areas[i] / sum)))));
  }
  return samples;
}

double thickness_quantile(const std::vector<std::vector<WallSample>>& walls, double share) {
  std::vector<double> sorted;
  for (const std::vector<WallSample>& samples : walls) {
    for (const WallSample& sample : samples) sorted.push_back(sample.thickness);
  }
  if (sorted.empty()) return 0;
  const auto rank = std::ptrdiff_t(share * double(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
  return sorted[rank];
}

}  // namespace sprung
