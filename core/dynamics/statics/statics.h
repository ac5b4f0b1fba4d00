#pragma once
#include <functional>

#include "core/body/membrane.h"
#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// The response of a body to small loads and small movements of its supports, at its current positions.
struct LinearResponse {
  Points displacements;  // m x 3, m
  Points reactions;      // m x 3, N: of the supports, zero on free degrees of freedom
};

/// Solves K u = loads (m x 3, N) with u = `movements` (m x 3, m) where it is supported; the other entries of
/// `movements` are ignored. Throws Error(kBadInput) if the supports leave the body free to move.
[[nodiscard]] LinearResponse linear_response(const Body& body, const Supports& supports, const Points& loads,
                                             const Points& movements, LinearSolver& system);

struct StaticOptions {
  double tolerance = 1e-9;  // largest residual force on a free node over the largest force at work (loads, reactions)
  double direction_tolerance = 1e-4;  // residual of a direction of Newton's method over its forces
  int max_iterations = 200;           // of Newton's method, in each load step
  int max_iterations_in_all = 1000;
  int max_load_steps = 256;         // the load is split into ever more steps if Newton's method does not converge
  std::function<void()> between{};  // called before every iteration; may throw
};

struct StaticReport {
  int iterations = 0;  // of Newton's method, all load steps
  int load_steps = 1;
  double residual = 0;  // as StaticOptions::tolerance measures it
};

/// Small displacements (3 m, m) under `loads` (m x 3, N): one linear solve at the body's current positions. The forces
/// are balanced to a billionth, or what rounding allows. Throws Error(kBadInput), naming the motion, if the supports
/// leave the body free to move, Error(kFailed) if no such solution is found.
[[nodiscard]] Eigen::VectorXd solve_linear(const Body& body, const Supports& supports, const Points& loads,
                                           LinearSolver& system);

/// Moves the body into equilibrium under dead loads (m x 3, N): the minimum of elastic energy - loads . positions, by
/// Newton's method with a line search, for large deformations. Supported degrees of freedom keep the positions they
/// come with; `start` (m x 3, m) is where they were before, so that both loads and movements of the
/// supports are applied in steps if one is not enough. Throws Error(kDiverged) with load share and residual if no
/// equilibrium is found.
StaticReport solve_static(Body& body, const Supports& supports, const Points& loads, const Points& start,
                          LinearSolver& system, const StaticOptions& options = {});

/// Forces that the supports exert (m x 3, N); zero on free degrees of freedom.
[[nodiscard]] Points reactions(const Body& body, const Supports& supports, const Points& loads);

/// Small displacements (m x 2, m) of a membrane under `loads` (m x 2, N): one linear solve at its current positions.
/// Throws Error(kBadInput) if the supports leave the membrane free to move.
[[nodiscard]] Points2 solve_linear(const Membrane& membrane, const Points2& loads);

/// Moves the membrane into equilibrium under dead loads (m x 2, N): the minimum of elastic energy - loads . positions,
/// by Newton's method with a line search; the loads are applied in steps if one is not enough. Supported degrees of
/// freedom stay at membrane.positions. Throws Error(kDiverged) if no equilibrium is found.
StaticReport solve_static(Membrane& membrane, const Points2& loads, const StaticOptions& options = {});

/// Forces that the supports exert (m x 2, N); zero on free degrees of freedom.
[[nodiscard]] Points2 reactions(const Membrane& membrane, const Points2& loads);

}  // namespace sprung
