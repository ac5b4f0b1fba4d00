#include "core/dynamics/linear/multigrid_level.h"

#include <tbb/parallel_for.h>

#include <Eigen/CholmodSupport>
#include <Eigen/LU>
#include <numeric>

#include "core/dynamics/linear/eigenvalue_bound.h"

namespace sprung::multigrid {
namespace {

constexpr int kNodesPerTask = 512;
constexpr int kNodeBlocksPerTask = 8;

template <class Body>
void for_nodes(int count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(0, count, kNodesPerTask), [&](const tbb::blocked_range<int>& range) {
    for (int node = range.begin(); node < range.end(); ++node) body(node);
  });
}

/// The inverse over the free axes, zero in the others.
Eigen::Matrix3f inverse_of_free(Eigen::Matrix3d block, const char* fixed) {
  for (int k = 0; k < 3; ++k) {
    if (fixed[k] == 0) continue;
    block.row(k).setZero();
    block.col(k).setZero();
    block(k, k) = 1;
  }
  Eigen::Matrix3d inverse = block.inverse();
  for (int k = 0; k < 3; ++k) {
    if (fixed[k] != 0) inverse(k, k) = 0;
  }
  return inverse.cast<float>();
}

}  // namespace

Level::Level(const Layout& layout) : layout_(&layout) {
  const std::size_t blocks = (layout.bricks.size() + kLanes - 1) / kLanes;
  matrices_.assign(kAnchoredSize * kLanes * blocks, 0);
  pull_of_block_.assign(blocks, -1);
  diagonal.assign(layout.node_count, 0);
  fixed.assign(3 * std::size_t(layout.node_count), 0);
  corner_forces_.resize(24 * kLanes * blocks);
  corner_places_.reserve(layout.corners.corners.size());
  for (const int corner : layout.corners.corners) {
    const std::size_t brick = corner / 8;
    corner_places_.push_back((brick / kLanes * 24 + 3 * std::size_t(corner % 8)) * kLanes + brick % kLanes);
  }
}

FineMatrices Level::matrices() const {
  return {.matrices = matrices_.data(), .pulls = pulls_.data(), .pull_of_block = pull_of_block_.data()};
}

float* Level::add_pull(int block) {
  int& pull = pull_of_block_[block];
  if (pull < 0) {
    pull = int(pulls_.size() / (kPullSize * kLanes));
    pulls_.resize(pulls_.size() + kPullSize * kLanes, 0);
  }
  return &pulls_[kPullSize * kLanes * std::size_t(pull)];
}

LevelBlock Level::input(int block) const {
  const std::size_t b = block;
  const int pull = pull_of_block_[b];
  return {.matrix = &matrices_[kAnchoredSize * kLanes * b],
          .pull = pull < 0 ? nullptr : &pulls_[kPullSize * kLanes * std::size_t(pull)],
          .nodes = &layout_->bricks[kLanes * b],
          .count = std::min(kLanes, isize(layout_->bricks) - block * kLanes)};
}

void Level::clear_pulls() {
  pulls_.clear();
  std::fill(pull_of_block_.begin(), pull_of_block_.end(), -1);
}

void Level::coarsen(const Level& fine) {
  clear_pulls();
  const std::span<const Children> children = layout_->children;
  std::vector<float> pulls(kPullSize * kLanes * std::size_t(block_count()));
  std::vector<char> has_pull(block_count());
  tbb::parallel_for(0, block_count(), [&](int block) {
    const std::size_t b = block;
    const auto bricks = children.subspan(b * kLanes, std::min<std::size_t>(kLanes, children.size() - b * kLanes));
    has_pull[b] = kernels().coarsen(fine.matrices(), bricks, matrix(block), &pulls[b * kPullSize * kLanes]) ? 1 : 0;
  });
  for (int block = 0; block < block_count(); ++block) {
    if (has_pull[block] == 0) continue;
    float* pull = add_pull(block);
    std::copy_n(&pulls[std::size_t(block) * kPullSize * kLanes], kPullSize * kLanes, pull);
  }
  const Interpolation& hang = fine.layout().to_coarse;
  for (std::size_t node = 0; node < diagonal.size(); ++node) {
    double sum = 0;
    std::array<char, 3> all_fixed{1, 1, 1};
    for (int i = hang.first_fine[node]; i < hang.first_fine[node + 1]; ++i) {
      const std::size_t from = hang.fine_nodes[i];
      sum += fine.diagonal[from] / hang.counts[from];
      for (std::size_t k = 0; k < 3; ++k) all_fixed[k] = all_fixed[k] != 0 && fine.fixed[3 * from + k] != 0 ? 1 : 0;
    }
    diagonal[node] = sum;
    std::copy(all_fixed.begin(), all_fixed.end(), &fixed[3 * node]);
  }
}

void Level::release_held(Floats& x) const {
  for_nodes(layout_->node_count, [&](int node) {
    for (int i = 3 * node; i < 3 * node + 3; ++i) {
      if (fixed[i] != 0) x[i] = 0;
    }
  });
}

template <class Vector, class Apply>
void Level::multiply_bricks(const Vector& x, Vector& product, Apply apply) const {
  using Number = typename Vector::Scalar;
  Vector* room = nullptr;
  if constexpr (std::is_same_v<Number, float>) {
    room = &corner_forces_;
  } else {
    corner_forces_double_.resize(corner_forces_.size());
    room = &corner_forces_double_;
  }
  Number* forces = room->data();
  product.resize(x.size());
  tbb::parallel_for(tbb::blocked_range<int>(0, block_count(), kNodeBlocksPerTask),
                    [&](const tbb::blocked_range<int>& range) {
                      for (int block = range.begin(); block < range.end(); ++block) {
                        apply(input(block), x.data(), forces + 24 * kLanes * std::size_t(block));
                      }
                    });
  for_nodes(layout_->node_count, [&](int node) {
    const std::size_t n = node;
    const auto inertia = static_cast<Number>(diagonal[n]);
    Number sum[3];
    for (int k = 0; k < 3; ++k) sum[k] = inertia * x[3 * node + k];
    for (int i = layout_->corners.first[n]; i < layout_->corners.first[n + 1]; ++i) {
      const Number* force = forces + corner_places_[i];
      for (int k = 0; k < 3; ++k) sum[k] += force[k * kLanes];
    }
    for (int k = 0; k < 3; ++k) product[3 * node + k] = sum[k];
  });
}

void Level::multiply(const Floats& x, Floats& product) const { multiply_bricks(x, product, kernels().apply); }

void Level::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& product) const {
  multiply_bricks(x, product, kernels().apply_double);
}

double Level::entry(std::size_t brick, std::size_t row, std::size_t column) const {
  const std::size_t block = brick / kLanes;
  const std::size_t lane = brick % kLanes;
  if (row < 3) std::swap(row, column);
  if (row >= 3 && column >= 3) {
    const std::size_t index = anchored_index(std::max(row, column) - 3, std::min(row, column) - 3);
    return matrices_[(block * kAnchoredSize + index) * kLanes + lane];
  }
  const int pull = pull_of_block_[block];
  double rest = 0;
  if (pull >= 0) {
    rest = double(pulls_[(std::size_t(pull) * kPullSize + 3 * row + column) * kLanes + lane]);
  }
  for (std::size_t corner = 1; corner < 8; ++corner) rest -= entry(brick, row, 3 * corner + column);
  return rest;
}

void Level::prepare_smoother(double fastest_of_brick) {
  std::vector<float> blocks(48 * kLanes * std::size_t(block_count()));
  tbb::parallel_for(0, block_count(), [&](int block) {
    const std::size_t b = block;
    kernels().corner_blocks(input(block), &blocks[48 * kLanes * b]);
  });
  inverse_blocks_.resize(layout_->node_count);
  for_nodes(layout_->node_count, [&](int node) {
    const std::size_t n = node;
    Eigen::Matrix3d sum = diagonal[n] * Eigen::Matrix3d::Identity();
    for (int i = layout_->corners.first[n]; i < layout_->corners.first[n + 1]; ++i) {
      const std::size_t corner = layout_->corners.corners[i];
      const std::size_t brick = corner / 8;
      const float* entry = &blocks[(brick / kLanes * 48 + corner % 8 * 6) * kLanes + brick % kLanes];
      for (int r = 0; r < 3; ++r) {
        for (int c = r; c < 3; ++c, entry += kLanes) sum(c, r) += double(*entry);
      }
    }
    inverse_blocks_[n] = inverse_of_free(sum.selfadjointView<Eigen::Lower>(), &fixed[3 * n]);
  });
  fastest_ = float(fastest_of_brick);
  if (fastest_of_brick == 0) find_fastest();
}

void Level::find_fastest() {
  const auto scale = [&](const Floats& x, Floats& scaled) {
    scaled.resize(x.size());
    for_nodes(layout_->node_count,
              [&](int node) { scaled.segment<3>(3 * node) = inverse_blocks_[node] * x.segment<3>(3 * node); });
  };
  const auto multiplied = [&](const Floats& x, Floats& product) { multiply(x, product); };
  const double bound = bound_on_eigenvalues<Floats>(Eigen::Index(3) * layout_->node_count, multiplied, scale);
  fastest_ = bound > 0 ? float(bound) : 1;
}

void Level::smooth(int steps, Floats& x, Floats& residual, bool with_residual) const {
  direction_.resize(x.size());
  for (int step = 1; step <= steps; ++step) {
    const auto s = float(step);
    const float keep = (2 * s - 3) / (2 * s + 1);
    const float take = (8 * s - 4) / ((2 * s + 1) * fastest_);
    const bool is_first = step == 1;
    for_nodes(layout_->node_count, [&](int node) {
      Eigen::Vector3f d = take * (inverse_blocks_[node] * residual.segment<3>(3 * node));
      if (!is_first) d += keep * direction_.segment<3>(3 * node);
      direction_.segment<3>(3 * node) = d;
      x.segment<3>(3 * node) += d;
    });
    if (step == steps && !with_residual) break;
    multiply(direction_, product_);
    for_nodes(layout_->node_count, [&](int node) { residual.segment<3>(3 * node) -= product_.segment<3>(3 * node); });
  }
}

void Level::smooth(int steps, Floats& x, Floats& residual) const { smooth(steps, x, residual, true); }

Eigen::SparseMatrix<double> Level::sparse() const {
  const Eigen::Index size = Eigen::Index(3) * layout_->node_count;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t brick = 0; brick < layout_->bricks.size(); ++brick) {
    for (std::size_t row = 0; row < 24; ++row) {
      const int to = 3 * layout_->bricks[brick][row / 3] + int(row % 3);
      for (std::size_t column = 0; column < 24; ++column) {
        const int from = 3 * layout_->bricks[brick][column / 3] + int(column % 3);
        if (from > to || fixed[from] != 0 || fixed[to] != 0) continue;
        entries.emplace_back(to, from, entry(brick, row, column));
      }
    }
  }
  for (Eigen::Index i = 0; i < size; ++i) entries.emplace_back(i, i, fixed[i] == 0 ? diagonal[i / 3] : 1);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void restrict_to_coarse(const Interpolation& hang, const Floats& fine, Floats& coarse) {
  const int count = isize(hang.first_fine) - 1;
  coarse.resize(Eigen::Index{3} * count);
  for_nodes(count, [&](int node) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    const std::size_t n = node;
    for (int i = hang.first_fine[n]; i < hang.first_fine[n + 1]; ++i) {
      const int from = hang.fine_nodes[i];
      sum += fine.segment<3>(3 * from) / float(hang.counts[from]);
    }
    coarse.segment<3>(3 * node) = sum;
  });
}

void add_from_coarse(const Interpolation& hang, const Floats& coarse, Floats& fine) {
  for_nodes(isize(hang.counts), [&](int node) {
    const std::size_t n = node;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t i = 0; i < hang.counts[n]; ++i) sum += coarse.segment<3>(3 * hang.coarse_nodes[n][i]);
    fine.segment<3>(3 * node) += sum / float(hang.counts[n]);
  });
}

namespace {

/// The relative increase of the coarsest level's diagonal: the accuracy of single precision.
constexpr double kRaise = 1e-7;
constexpr double kMaxRaise = 1e-4;  // if the rounding of soft bodies needs more

/// Of the residual: a coarse level reduced this far by the first step needs no second one.
constexpr float kEnough = 0.25F;

double dot(const Floats& a, const Floats& b) { return a.dot(b); }

}  // namespace

namespace {

/// By row, the largest diagonal entry of the rows that its entries couple. Corners of coarse bricks that hardly any
/// child reaches have less than the others' rounding.
Eigen::VectorXd largest_around(const Eigen::SparseMatrix<double>& lower) {
  const Eigen::VectorXd diagonal = lower.diagonal();
  Eigen::VectorXd largest = diagonal;
  for (Eigen::Index column = 0; column < lower.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, column); entry; ++entry) {
      largest[entry.row()] = std::max(largest[entry.row()], diagonal[column]);
      largest[column] = std::max(largest[column], diagonal[entry.row()]);
    }
  }
  return largest;
}

}  // namespace

struct Cycle::Coarsest {
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky;
};

Cycle::Cycle(const std::vector<Layout>& layouts) : coarsest_(std::make_unique<Coarsest>()), rooms_(layouts.size()) {
  coarsest_->cholesky.cholmod().print = 0;
  levels_.reserve(layouts.size());
  for (const Layout& layout : layouts) levels_.emplace_back(layout);
}

Cycle::~Cycle() = default;

bool Cycle::prepare(int steps, double fastest_of_brick) {
  steps_ = steps;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (i > 0) levels_[i].coarsen(levels_[i - 1]);
    if (i + 1 < levels_.size()) levels_[i].prepare_smoother(i == 0 ? fastest_of_brick : 0);
  }
  Eigen::SparseMatrix<double> matrix = levels_.back().sparse();
  const Eigen::VectorXd diagonal = matrix.diagonal();
  const auto succeeds_with = [&](const Eigen::VectorXd& more) {
    matrix.diagonal() = diagonal + more;
    coarsest_->cholesky.compute(matrix);
    return coarsest_->cholesky.info() == Eigen::Success;
  };
  if (succeeds_with(kRaise * diagonal)) return true;
  matrix.diagonal() = diagonal;
  const Eigen::VectorXd around = largest_around(matrix);
  for (double raise = 10 * kRaise; raise <= kMaxRaise; raise *= 10) {
    if (succeeds_with(raise * around)) return true;
  }
  return false;
}

void Cycle::apply(const Floats& b, Floats& x) const {
  rooms_[0].residual = b;
  descend(0, rooms_[0].residual, x);
}

void Cycle::descend(std::size_t level, Floats& residual, Floats& x) const {
  x.setZero(residual.size());
  if (level + 1 == levels_.size()) {
    solve_coarsest(residual, x);
    return;
  }
  const Level& here = levels_[level];
  const Interpolation& hang = here.layout().to_coarse;
  Room& room = rooms_[level];
  Room& coarse = rooms_[level + 1];
  here.smooth(steps_, x, residual);
  restrict_to_coarse(hang, residual, coarse.right);
  solve_coarse(level + 1, coarse.right, coarse.answer);
  room.correction.setZero(x.size());
  add_from_coarse(hang, coarse.answer, room.correction);
  here.release_held(room.correction);
  x += room.correction;
  here.multiply(room.correction, room.product);
  residual -= room.product;
  here.smooth_last(steps_, x, residual);
}

void Cycle::solve_coarse(std::size_t level, const Floats& b, Floats& x) const {
  Room& room = rooms_[level];
  room.residual = b;
  descend(level, room.residual, x);
  if (level + 1 == levels_.size()) return;
  const Level& here = levels_[level];
  here.multiply(x, room.first_product);
  const double curvature = dot(x, room.first_product);
  const double descent = dot(x, b);
  if (!(curvature > 0)) return;
  const auto step = float(descent / curvature);
  room.left = b - step * room.first_product;
  if (room.left.norm() <= kEnough * b.norm()) {
    x *= step;
    return;
  }
  room.residual = room.left;
  descend(level, room.residual, room.second);
  here.multiply(room.second, room.product);
  const double mixed = dot(room.second, room.first_product);
  const double second_curvature = dot(room.second, room.product) - mixed * mixed / curvature;
  if (!(second_curvature > 0)) {
    x *= step;
    return;
  }
  const double second_step = dot(room.second, room.left) / second_curvature;
  x = float(descent / curvature - mixed * second_step / curvature) * x + float(second_step) * room.second;
}

void Cycle::solve_coarsest(const Floats& residual, Floats& x) const {
  const Eigen::VectorXd exact = coarsest_->cholesky.solve(residual.cast<double>());
  x = exact.cast<float>();
  levels_.back().release_held(x);
}

}  // namespace sprung::multigrid
