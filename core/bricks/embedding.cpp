#include "core/bricks/embedding.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "core/bricks/brick_grid.h"
#include "core/bricks/solid_samples.h"

namespace sprung {
namespace {

using Cell = Eigen::Vector3i;

constexpr double kRounding = 1e-9;  // bricks

/// Finds the brick that contains a point, or the nearest one.
class BrickFinder {
 public:
  explicit BrickFinder(const BrickGrid& grid) : grid_(grid), index_(grid) {}

  /// `position` in lattice units. -1: no brick contains it.
  [[nodiscard]] int holding(const Vec3& position) const {
    const Cell cell = position.array().floor().cast<int>();
    if (const int brick = index_.at(cell); brick >= 0) return brick;
    // A point on a face, an edge or a corner belongs to the cells on both sides.
    for (int side = 1; side < 8; ++side) {
      Cell neighbour = cell;
      bool on_border = true;
      for (int axis = 0; axis < 3; ++axis) {
        if (((side >> axis) & 1) == 0) continue;
        const double rounded = std::round(position[axis]);
        on_border = on_border && std::abs(position[axis] - rounded) < kRounding;
        neighbour[axis] = rounded > position[axis] ? cell[axis] + 1 : cell[axis] - 1;
      }
      if (const int brick = on_border ? index_.at(neighbour) : -1; brick >= 0) return brick;
    }
    return -1;
  }

  [[nodiscard]] int nearest(const Vec3& position) const {
    const Cell centre = position.array().floor().cast<int>();
    constexpr int kRings = 3;
    int best = -1;
    double best_distance = std::numeric_limits<double>::infinity();
    const auto consider = [&](int brick) {
      const double distance = distance_squared(position, grid_.cells[brick]);
      if (distance < best_distance) {
        best = brick;
        best_distance = distance;
      }
    };
    for (int z = -kRings; z <= kRings; ++z) {
      for (int y = -kRings; y <= kRings; ++y) {
        for (int x = -kRings; x <= kRings; ++x) {
          if (const int brick = index_.at(centre + Cell(x, y, z)); brick >= 0) consider(brick);
        }
      }
    }
    if (best >= 0) return best;
    for (int brick = 0; brick < grid_.brick_count(); ++brick) consider(brick);
    return best;
  }

 private:
  static double distance_squared(const Vec3& position, const Cell& cell) {
    const Vec3 low = cell.cast<double>();
    return (position - position.cwiseMax(low).cwiseMin(low + Vec3::Ones())).squaredNorm();
  }

  const BrickGrid& grid_;
  CellIndex index_;
};

/// The distance of a point from its brick, in bricks; 0 inside.
double distance_from_brick(const Vec3& local) {
  return (local - local.cwiseMax(Vec3::Zero()).cwiseMin(Vec3::Ones())).norm();
}

Eigen::Matrix<double, 3, 8> corner_positions(const BrickGrid& grid, int brick, const Points& node_positions) {
  Eigen::Matrix<double, 3, 8> corners;
  const auto& nodes = grid.nodes[brick];
  for (int corner = 0; corner < 8; ++corner) {
    corners.col(corner) = node_positions.row(nodes[corner]).transpose();
  }
  return corners;
}

}  // namespace

CornerWeights trilinear_weights(const Vec3& local) {
  CornerWeights weights;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= on_high_side(corner, axis) ? local[axis] : 1 - local[axis];
    weights[corner] = weight;
  }
  return weights;
}

Eigen::Matrix<double, 8, 3> trilinear_gradients(const Vec3& local) {
  Eigen::Matrix<double, 8, 3> gradients;
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      double value = 1;
      for (int k = 0; k < 3; ++k) {
        const bool high = on_high_side(corner, k);
        value *= k == axis ? (high ? 1.0 : -1.0) : (high ? local[k] : 1 - local[k]);
      }
      gradients(corner, axis) = value;
    }
  }
  return gradients;
}

Embedding embed(const BrickGrid& grid, const Points& points, const Points& outward) {
  const BrickFinder finder(grid);
  const SolidFinder solid(grid);
  Embedding embedding;
  embedding.brick.resize(points.rows());
  embedding.local.resize(points.rows(), 3);
  for (int i = 0; i < points.rows(); ++i) {
    const Vec3 position = (points.row(i).transpose() - grid.origin) / grid.brick_size;
    const Vec3 inward = outward.rows() == 0 ? Vec3::Zero() : Vec3(-outward.row(i).transpose().stableNormalized());
    int brick = solid.under(position, inward);
    const bool is_beyond = brick < 0;
    if (brick < 0) brick = finder.holding(position);
    if (brick < 0) brick = finder.nearest(position);
    const Vec3 local = position - grid.cells[brick].cast<double>();
    embedding.brick[i] = brick;
    embedding.local.row(i) = local;
    const double distance = distance_from_brick(local);
    if (!is_beyond || distance < kRounding) continue;
    ++embedding.outside;
    embedding.furthest = std::max(embedding.furthest, distance);
  }
  return embedding;
}

Points deform_points(const BrickGrid& grid, const Embedding& embedding, const Points& node_positions) {
  Points deformed(embedding.local.rows(), 3);
  tbb::parallel_for(tbb::blocked_range<int>(0, int(deformed.rows()), 2048), [&](const auto& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      const auto corners = corner_positions(grid, embedding.brick[i], node_positions);
      deformed.row(i) = corners * trilinear_weights(embedding.local.row(i));
    }
  });
  return deformed;
}

Eigen::VectorXd interpolate(const BrickGrid& grid, const Embedding& embedding, const Eigen::VectorXd& of_nodes) {
  Eigen::VectorXd mixed(embedding.local.rows());
  for (Eigen::Index i = 0; i < mixed.size(); ++i) {
    const Vec3 inside = embedding.local.row(i).transpose().cwiseMax(0.0).cwiseMin(1.0);
    const auto weights = trilinear_weights(inside);
    const auto& nodes = grid.nodes[embedding.brick[i]];
    mixed[i] = 0;
    for (int corner = 0; corner < 8; ++corner) {
      mixed[i] += weights[corner] * of_nodes[nodes[corner]];
    }
  }
  return mixed;
}

Points deform_normals(const BrickGrid& grid, const Embedding& embedding, const Points& normals,
                      const Points& node_positions) {
  Points deformed(normals.rows(), 3);
  tbb::parallel_for(tbb::blocked_range<int>(0, int(deformed.rows()), 2048), [&](const auto& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      const auto corners = corner_positions(grid, embedding.brick[i], node_positions);
      const Mat3 gradient = corners * trilinear_gradients(embedding.local.row(i)) / grid.brick_size;
      // The cofactor matrix is the inverse transpose up to a positive factor, and finite for a flattened brick.
      Mat3 cofactors;
      cofactors << gradient.col(1).cross(gradient.col(2)), gradient.col(2).cross(gradient.col(0)),
          gradient.col(0).cross(gradient.col(1));
      deformed.row(i) = cofactors * normals.row(i).transpose();
    }
  });
  return deformed;
}

namespace {

Vec3 corner_place(int corner) {
  return {on_high_side(corner, 0) ? 1.0 : 0.0, on_high_side(corner, 1) ? 1.0 : 0.0,
          on_high_side(corner, 2) ? 1.0 : 0.0};
}

}  // namespace

SmoothEmbedding::SmoothEmbedding(const BrickGrid& grid, const Points& nodes)
    : grid_(grid), nodes_(nodes), gradients_(grid.node_count(), Mat3::Zero()) {
  std::vector<int> counts(gradients_.size(), 0);
  for (const auto& brick : grid.nodes) {
    Eigen::Matrix<double, 3, 8> corners;
    for (int corner = 0; corner < 8; ++corner) {
      corners.col(corner) = nodes.row(brick[corner]).transpose();
    }
    for (int corner = 0; corner < 8; ++corner) {
      const std::size_t node = brick[corner];
      gradients_[node] += corners * trilinear_gradients(corner_place(corner)) / grid.brick_size;
      ++counts[node];
    }
  }
  for (std::size_t node = 0; node < counts.size(); ++node) gradients_[node] /= std::max(counts[node], 1);
}

SmoothEmbedding::Sample SmoothEmbedding::sample(int brick, const Vec3& local) const {
  const Vec3 inside = local.cwiseMax(0.0).cwiseMin(1.0);
  const Vec3 step = inside.array().square() * (3 - 2 * inside.array());
  const Vec3 slope = 6 * inside.array() * (1 - inside.array()) / grid_.brick_size;
  const CornerWeights weights = trilinear_weights(step);
  const Eigen::Matrix<double, 8, 3> weight_gradients = trilinear_gradients(step) * slope.asDiagonal();
  Sample sample{Vec3::Zero(), Mat3::Zero()};
  for (int corner = 0; corner < 8; ++corner) {
    const int node = grid_.nodes[brick][corner];
    const Mat3& gradient = gradients_[node];
    const Vec3 there = nodes_.row(node).transpose() + grid_.brick_size * (gradient * (local - corner_place(corner)));
    sample.position += weights[corner] * there;
    sample.gradient += weights[corner] * gradient + there * weight_gradients.row(corner);
  }
  return sample;
}

Points SmoothEmbedding::points(const Embedding& embedding) const {
  Points deformed(embedding.local.rows(), 3);
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, deformed.rows(), 1024), [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      deformed.row(i) = sample(embedding.brick[i], embedding.local.row(i)).position.transpose();
    }
  });
  return deformed;
}

Points SmoothEmbedding::normals(const Embedding& embedding, const Points& at_rest) const {
  Points deformed(at_rest.rows(), 3);
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, deformed.rows(), 1024), [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      const Mat3 f = sample(embedding.brick[i], embedding.local.row(i)).gradient;
      Mat3 cofactors;
      cofactors << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
      deformed.row(i) = cofactors * at_rest.row(i).transpose();
    }
  });
  return deformed;
}

}  // namespace sprung
