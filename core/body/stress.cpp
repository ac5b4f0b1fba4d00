#include "core/body/stress.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "core/body/brick_model.h"

namespace sprung {
namespace {

constexpr double kLayer = 0.1;           // variance of positions, in squared bricks, needed for a slope
constexpr double kSameStiffness = 1e-6;  // relative

using Six = Eigen::Matrix<double, 6, 1>;

/// The fitted quantities: the second Piola-Kirchhoff stress in the axes of the grid, which is invariant under
/// rotations, and the deformation gradient.
struct State {
  Eigen::Matrix<double, 15, 1> numbers;

  [[nodiscard]] Six stress() const { return numbers.head<6>(); }
  [[nodiscard]] Mat3 gradient() const { return numbers.tail<9>().reshaped(3, 3); }
};
using Slopes = Eigen::Matrix<double, 15, 3>;  // 1/m

/// In the order of StressTensors.
constexpr std::array<std::array<int, 2>, 6> kEntries{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<std::array<int, 3>, 3> kEntryOf{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

Six six_of(const Mat3& tensor) {
  Six six;
  for (std::size_t i = 0; i < 6; ++i) six[i] = tensor(kEntries[i][0], kEntries[i][1]);
  return six;
}

template <class Row>
Mat3 tensor_of(const Row& six) {
  Mat3 tensor;
  for (std::size_t i = 0; i < 6; ++i) {
    tensor(kEntries[i][0], kEntries[i][1]) = six[i];
    tensor(kEntries[i][1], kEntries[i][0]) = six[i];
  }
  return tensor;
}

/// Slopes from the bending and twist of the brick: along each axis as in a plate normal to it, with free faces.
/// `reference`: its transpose times a change of the gradient is a change of strain.
Slopes slopes_within(const BrickColumns& x, const Mat3& reference, double h, double young, double poisson) {
  const double plate = young / (1 - poisson * poisson);
  const double shear = young / (1 + poisson);
  Slopes slopes = Slopes::Zero();
  for (int across = 0; across < 3; ++across) {
    Mat3 turned = Mat3::Zero();  // of the gradient, along `across`
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == across) continue;
      for (int corner = 0; corner < 8; ++corner) {
        const bool is_high = on_high_side(corner, axis) == on_high_side(corner, across);
        turned.col(axis) += (is_high ? 0.5 : -0.5) / (h * h) * x.col(corner);
      }
    }
    const Mat3 product = reference.transpose() * turned;
    const Mat3 strain = 0.5 * (product + product.transpose());
    const int b = (across + 1) % 3;
    const int c = (across + 2) % 3;
    slopes(b, across) = plate * (strain(b, b) + poisson * strain(c, c));
    slopes(c, across) = plate * (strain(c, c) + poisson * strain(b, b));
    slopes(kEntryOf[b][c], across) = shear * strain(b, c);
    slopes.col(across).tail<9>() = turned.reshaped();
  }
  return slopes;
}

/// A linear fit through the states of a brick and its neighbours, shifted to its own.
struct Line {
  Vec3 position = Vec3::Zero();  // m, in the frame of the grid
  State state{Eigen::Matrix<double, 15, 1>::Zero()};
  Slopes slopes = Slopes::Zero();

  [[nodiscard]] Eigen::Matrix<double, 15, 1> at(const Vec3& x) const { return state.numbers + slopes * (x - position); }
};

class Recovery {
 public:
  Recovery(const Body& body, const Points& positions, StrainMeasure measure)
      : body_(body),
        model_(brick_model(body.model)),
        positions_(positions),
        youngs_(brick_youngs(body)),
        corners_(list_corners(body.grid.nodes, body.node_count())) {
    if (measure == StrainMeasure::kFinite) return;
    at_rest_ = model_.gradient(body, 0, at_corners(body, 0, body.rest_positions));
  }

  [[nodiscard]] StressTensors at(const std::vector<int>& nodes) const {
    const BrickGrid& grid = body_.grid;
    const std::vector<int> bricks = bricks_at(nodes);
    std::vector<Line> lines(grid.cells.size());
    each(bricks.size(), [&](std::size_t row) { lines[bricks[row]] = line_through(bricks[row]); });
    StressTensors stresses(nodes.size(), 6);
    each(nodes.size(), [&](std::size_t row) { stresses.row(Eigen::Index(row)) = mean_at(nodes[row], lines); });
    return stresses;
  }

 private:
  template <class Do>
  static void each(std::size_t count, const Do& one) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) one(i);
    });
  }

  /// Ascending, each once.
  [[nodiscard]] std::vector<int> bricks_at(std::span<const int> nodes) const {
    std::vector<int> bricks;
    for (const int node : nodes) {
      for (int i = corners_.first[node]; i < corners_.first[node + 1]; ++i) bricks.push_back(corners_.corners[i] / 8);
    }
    std::sort(bricks.begin(), bricks.end());
    bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
    return bricks;
  }

  /// Cauchy stress, from the fits of the node's bricks.
  [[nodiscard]] Eigen::RowVector<double, 6> mean_at(int node, const std::vector<Line>& lines) const {
    const BrickGrid& grid = body_.grid;
    const Vec3 position = grid.origin + grid.brick_size * grid.lattice[node].cast<double>();
    State mean{Eigen::Matrix<double, 15, 1>::Zero()};
    double weights = 0;
    for (const int brick : bricks_at(std::span(&node, 1))) {
      mean.numbers += grid.fill[brick] * lines[brick].at(position);
      weights += grid.fill[brick];
    }
    mean.numbers /= weights;
    const Mat3 gradient = mean.gradient();
    return six_of(cauchy_stress(gradient, tensor_of(mean.stress()))).transpose();
  }

  [[nodiscard]] Mat3 gradient_of(int brick) const {
    return model_.gradient(body_, brick, at_corners(body_, brick, positions_));
  }

  /// m, in the frame of the grid, where gradient_of() is.
  [[nodiscard]] Vec3 middle_of(int brick) const {
    return brick_middle(body_.grid, brick) + body_.grid.brick_size * model_.middle(body_, brick);
  }

  [[nodiscard]] State state_of(int brick) const {
    const Mat3 gradient = gradient_of(brick);
    State state;
    if (!at_rest_) {
      state.numbers << six_of(model_.second_stress(body_, gradient, youngs_[brick])), gradient.reshaped();
      return state;
    }
    const Mat3 product = at_rest_->transpose() * gradient;
    const Mat3 strain = 0.5 * (product + product.transpose()) - Mat3::Identity();
    state.numbers << six_of(hooke_stress(strain, youngs_[brick], body_.material.poisson)), at_rest_->reshaped();
    return state;
  }

  [[nodiscard]] Slopes slopes_of(int brick) const {
    Slopes slopes = slopes_within(corners(brick), at_rest_.value_or(gradient_of(brick)), body_.grid.brick_size,
                                  youngs_[brick], body_.material.poisson);
    if (at_rest_) slopes.bottomRows<9>().setZero();
    return slopes;
  }

  [[nodiscard]] BrickColumns corners(std::size_t brick) const {
    return columns_of(body_.grid.nodes[brick], positions_);
  }

  [[nodiscard]] Line line_through(int brick) const {
    const BrickGrid& grid = body_.grid;
    std::vector<int> near = bricks_at(grid.nodes[brick]);
    const auto is_other = [&](int other) {
      return std::abs(youngs_[other] - youngs_[brick]) > kSameStiffness * youngs_[brick];
    };
    near.erase(std::remove_if(near.begin(), near.end(), is_other), near.end());
    Line line;
    double weights = 0;
    for (const int other : near) {
      const double weight = weight_of(other);
      weights += weight;
      line.position += weight * middle_of(other);
      line.state.numbers += weight * state_of(other).numbers;
    }
    line.position /= weights;
    line.state.numbers /= weights;
    Mat3 spread = Mat3::Zero();
    Slopes together = Slopes::Zero();
    Slopes within = Slopes::Zero();
    for (const int other : near) {
      const double weight = weight_of(other) / weights;
      const Vec3 way = middle_of(other) - line.position;
      spread += weight * way * way.transpose();
      together += weight * (state_of(other).numbers - line.state.numbers) * way.transpose();
      within += weight * slopes_of(other);
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 direction = axes.eigenvectors().col(axis);
      const double variance = axes.eigenvalues()[axis];
      const bool is_thin = variance < kLayer * grid.brick_size * grid.brick_size;
      const Eigen::Matrix<double, 15, 1> slope =
          is_thin ? within * direction : Eigen::Matrix<double, 15, 1>(together * direction / variance);
      line.slopes += slope * direction.transpose();
    }
    // Through the state of the brick itself, as far as it is filled.
    line.state.numbers += grid.fill[brick] * (state_of(brick).numbers - line.at(middle_of(brick)));
    return line;
  }

  /// Cut bricks have less weight.
  [[nodiscard]] double weight_of(int brick) const { return body_.grid.fill[brick] * body_.grid.fill[brick]; }

  const Body& body_;
  const BrickModel& model_;
  const Points& positions_;
  Eigen::VectorXd youngs_;  // Pa
  CornerLists corners_;
  std::optional<Mat3> at_rest_;  // for small strains: how the body was turned
};

}  // namespace

StressTensors recover_stress(const Body& body, const Points& positions, StrainMeasure measure) {
  std::vector<int> nodes(body.node_count());
  std::iota(nodes.begin(), nodes.end(), 0);
  return recover_stress(body, positions, nodes, measure);
}

StressTensors recover_stress(const Body& body, const Points& positions, const std::vector<int>& nodes,
                             StrainMeasure measure) {
  return Recovery(body, positions, measure).at(nodes);
}

StressTensors stress_at(const BrickGrid& grid, const Embedding& points, const StressTensors& of_nodes) {
  StressTensors stresses(points.local.rows(), 6);
  for (int entry = 0; entry < 6; ++entry) stresses.col(entry) = interpolate(grid, points, of_nodes.col(entry));
  return stresses;
}

Eigen::VectorXd von_mises(const StressTensors& stresses) {
  Eigen::VectorXd values(stresses.rows());
  for (Eigen::Index row = 0; row < values.size(); ++row) {
    values[row] = von_mises(tensor_of(stresses.row(row)));
  }
  return values;
}

PrincipalStresses principal_stresses(const StressTensors& stresses) {
  PrincipalStresses principal{.values = Points(stresses.rows(), 3)};
  for (Eigen::Index row = 0; row < stresses.rows(); ++row) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(tensor_of(stresses.row(row)));
    principal.values.row(row) = solver.eigenvalues().reverse().transpose();
    principal.directions.emplace_back(solver.eigenvectors().rowwise().reverse());
  }
  return principal;
}

}  // namespace sprung
