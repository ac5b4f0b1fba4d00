#include "core/dynamics/implicit/implicit_motion.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/contact/broad_phase.h"
#include "core/contact/glue.h"
#include "core/dynamics/divergence.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/implicit/implicit_step.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kShortestStride = 1.0 / 256;  // of a step

}  // namespace

/// Bodies that move together, for a step.
struct ImplicitMotion::Together {
  std::vector<std::size_t> rows;
  Group members;
  std::vector<ImplicitBody*> bodies;
  std::vector<GluedPoint> glue;
};

ImplicitMotion::ImplicitMotion(World& world, const ImplicitOptions& options)
    : world_(world), options_(options), counts_(std::make_unique<ImplicitCounts>()) {
  const std::string why_not = check_implicit_support(world);
  if (!why_not.empty()) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}, which implicit steps do not support: use an explicit scheme, euler or verlet", why_not));
  }
  for (SoftBody& body : world.bodies) bodies_.push_back(std::make_unique<ImplicitBody>(body, world, options_));
}

ImplicitMotion::~ImplicitMotion() = default;

void ImplicitMotion::advance(double dt, long steps, double time) {
  for (long step = 0; step < steps; ++step) {
    for (std::vector<std::size_t>& rows : contact_groups(world_, dt)) {
      Together group{.rows = std::move(rows), .members = {}, .bodies = {}, .glue = {}};
      for (const std::size_t row : group.rows) {
        group.members.push_back(&world_.bodies[row]);
        group.bodies.push_back(bodies_[row].get());
      }
      group.glue = glue_within(world_, group.rows);
      advance(group, {.elapsed = dt * double(step), .dt = dt, .begin = time});
    }
  }
  move_prescribed(world_, dt * double(steps));
}

void ImplicitMotion::advance(const Together& group, const Span& span) {
  double done = 0;  // of the step: one without a solution, or that moves too far, is halved
  double stride = 1;
  while (done < 1) {
    const double most = max_step_size(world_, group.members, stride * span.dt);
    while (stride * span.dt > most && stride > kShortestStride) stride /= 2;
    const std::string trouble = try_step(group, span.elapsed + done * span.dt, stride * span.dt);
    if (trouble.empty()) {
      done += stride;
      continue;
    }
    ++halvings_;
    stride /= 2;
    if (stride >= kShortestStride) continue;
    throw Diverged(group.rows.front(),
                   fmt::format("body {}: a step of {:.3g} s fails too at t = {:.6g} s: {}; {}", group.rows.front() + 1,
                               stride * span.dt, span.begin + span.elapsed + done * span.dt, trouble,
                               advice_for_divergence(world_, group.rows.front(),
                                                     worst_brick_of(world_.bodies[group.rows.front()]))));
  }
}

/// Empty, or the failure; the bodies are then unchanged.
std::string ImplicitMotion::try_step(const Together& group, double elapsed, double dt) {
  const std::vector<Energy> before = energies_of(world_, group.rows);
  ImplicitStep step(world_, group.bodies, group.members, group.glue, options_, dt);
  if (!step.make(elapsed, *counts_)) return "Newton's method did not converge";
  std::string gain = energy_gain(world_, group.rows, before, energies_of(world_, group.rows));
  if (gain.empty()) return gain;
  for (ImplicitBody* body : group.bodies) body->undo();
  return gain;
}

void ImplicitMotion::serialize(IntegratorState& state) {
  for (const auto& body : bodies_) body->serialize(state);
}

ImplicitMotion::Report ImplicitMotion::report() const {
  Report report;
  report.halvings = halvings_;
  report.steps = counts_->steps;
  report.newton_iterations = counts_->iterations;
  std::vector<SolveReport> all{counts_->coupled};
  for (const auto& body : bodies_) all.push_back(body->solves());
  for (const SolveReport& solves : all) {
    report.solves.solves += solves.solves;
    report.solves.iterations += solves.iterations;
    report.solves.most = std::max(report.solves.most, solves.most);
    report.solves.indefinite += solves.indefinite;
    report.solves.fallbacks += solves.fallbacks;
  }
  return report;
}

std::string check_implicit_support(const World& world) {
  for (const Obstacle& obstacle : world.obstacles) {
    if (obstacle.restitution > 0) return fmt::format("an obstacle has a restitution of {:.3g}", obstacle.restitution);
  }
  return "";
}

}  // namespace sprung
