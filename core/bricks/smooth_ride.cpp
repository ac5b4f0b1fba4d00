#include "core/bricks/smooth_ride.h"

#include <tbb/parallel_for.h>

namespace sprung {
namespace {

Vec3 corner_place(int corner) {
  return {on_high_side(corner, 0) ? 1.0 : 0.0, on_high_side(corner, 1) ? 1.0 : 0.0,
          on_high_side(corner, 2) ? 1.0 : 0.0};
}

}  // namespace

SmoothRide::SmoothRide(const BrickGrid& grid, const Points& nodes)
    : grid_(grid), nodes_(nodes), gradients_(static_cast<std::size_t>(grid.node_count()), Mat3::Zero()) {
  std::vector<int> counts(gradients_.size(), 0);
  for (const auto& brick : grid.nodes) {
    Eigen::Matrix<double, 3, 8> corners;
    for (int corner = 0; corner < 8; ++corner) {
      corners.col(corner) = nodes.row(brick[static_cast<std::size_t>(corner)]).transpose();
    }
    for (int corner = 0; corner < 8; ++corner) {
      const auto node = static_cast<std::size_t>(brick[static_cast<std::size_t>(corner)]);
      gradients_[node] += corners * trilinear_gradients(corner_place(corner)) / grid.brick_size;
      ++counts[node];
    }
  }
  for (std::size_t node = 0; node < counts.size(); ++node) gradients_[node] /= std::max(counts[node], 1);
}

SmoothRide::Place SmoothRide::place(int brick, const Vec3& local) const {
  const Vec3 inside = local.cwiseMax(0.0).cwiseMin(1.0);
  const Vec3 step = inside.array().square() * (3 - 2 * inside.array());
  const Vec3 slope = 6 * inside.array() * (1 - inside.array()) / grid_.brick_size;
  const Eigen::Matrix<double, 8, 1> weights = trilinear_weights(step);
  const Eigen::Matrix<double, 8, 3> weight_gradients = trilinear_gradients(step) * slope.asDiagonal();
  Place place{Vec3::Zero(), Mat3::Zero()};
  for (int corner = 0; corner < 8; ++corner) {
    const int node = grid_.nodes[static_cast<std::size_t>(brick)][static_cast<std::size_t>(corner)];
    const Mat3& gradient = gradients_[static_cast<std::size_t>(node)];
    const Vec3 there = nodes_.row(node).transpose() + grid_.brick_size * (gradient * (local - corner_place(corner)));
    place.position += weights[corner] * there;
    place.gradient += weights[corner] * gradient + there * weight_gradients.row(corner);
  }
  return place;
}

Points SmoothRide::points(const Embedding& embedding) const {
  Points deformed(embedding.local.rows(), 3);
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, deformed.rows(), 1024), [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      deformed.row(i) =
          place(embedding.brick[static_cast<std::size_t>(i)], embedding.local.row(i)).position.transpose();
    }
  });
  return deformed;
}

Points SmoothRide::normals(const Embedding& embedding, const Points& at_rest) const {
  Points deformed(at_rest.rows(), 3);
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, deformed.rows(), 1024), [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      const Mat3 f = place(embedding.brick[static_cast<std::size_t>(i)], embedding.local.row(i)).gradient;
      Mat3 cofactors;
      cofactors << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
      deformed.row(i) = cofactors * at_rest.row(i).transpose();
    }
  });
  return deformed;
}

}  // namespace sprung
