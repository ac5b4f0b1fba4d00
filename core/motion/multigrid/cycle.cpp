#include "core/motion/multigrid/cycle.h"

namespace sprung::multigrid {
namespace {

/// What the coarsest level's diagonal is raised by, relative: single precision leaves no more certain.
constexpr double kRaise = 1e-7;

/// Of the residual: a coarse level that the first step brings so low takes no second one.
constexpr float kEnough = 0.25F;

double dot(const Floats& a, const Floats& b) { return static_cast<double>(a.dot(b)); }

}  // namespace

Cycle::Cycle(const std::vector<Layout>& layouts) : rooms_(layouts.size()) {
  levels_.reserve(layouts.size());
  for (const Layout& layout : layouts) levels_.emplace_back(layout);
}

bool Cycle::prepare(int steps, double fastest_of_brick) {
  steps_ = steps;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (i > 0) levels_[i].coarsen(levels_[i - 1]);
    if (i + 1 < levels_.size()) levels_[i].prepare_smoother(i == 0 ? fastest_of_brick : 0);
  }
  Eigen::MatrixXd dense = levels_.back().dense();
  dense.diagonal() *= 1 + kRaise;
  coarsest_.compute(dense);
  return coarsest_.info() == Eigen::Success;
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
  const auto step = static_cast<float>(descent / curvature);
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
  x = static_cast<float>(descent / curvature - mixed * second_step / curvature) * x +
      static_cast<float>(second_step) * room.second;
}

void Cycle::solve_coarsest(const Floats& residual, Floats& x) const {
  const Eigen::VectorXd exact = coarsest_.solve(residual.cast<double>());
  x = exact.cast<float>();
  levels_.back().release_held(x);
}

}  // namespace sprung::multigrid
