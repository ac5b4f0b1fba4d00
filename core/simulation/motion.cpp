#include "core/simulation/motion.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/statics/statics.h"
#include "core/world/load_forces.h"

namespace sprung {
namespace {

constexpr double kRounding = 1e-6;  // fraction of a step by which a piece of a frame may exceed whole steps

}  // namespace

SceneMotion::SceneMotion(Simulation& simulation, const Scene& scene)
    : world_(simulation.world),
      driver_(scene, simulation),
      plan_(plan_steps(world_, scene)),
      explicit_(world_, plan_.scheme == Solver::kVerlet ? Scheme::kVerlet : Scheme::kSymplecticEuler) {
  if (!plan_.is_implicit()) return;
  implicit_.emplace(world_, ImplicitOptions{.scheme = plan_.scheme == Solver::kBdf2 ? ImplicitScheme::kBdf2
                                                                                    : ImplicitScheme::kEuler});
}

void SceneMotion::advance(double begin, double end, double duration, const Between& between, const Tell& tell) {
  const std::vector<double> ends = driver_.pieces(begin, end);
  double piece_begin = begin;
  for (const double piece_end : ends) {
    driver_.aim(piece_begin, piece_end);
    const double piece = ends.size() == 1 ? duration : piece_end - piece_begin;
    const double before = (piece_begin - begin) / duration;
    advance_piece(
        piece_begin, piece, [&](double share) { between(before + share * piece / duration); }, tell);
    piece_begin = piece_end;
  }
}

void SceneMotion::advance_piece(double begin, double duration, const Between& between, const Tell& tell) {
  if (implicit_) {
    const long count = std::max(1L, std::lround(std::ceil(duration / plan_.steps.dt - kRounding)));
    const double dt = duration / double(count);
    for (long step = 0; step < count; ++step) {
      implicit_->advance(dt, 1, begin + dt * double(step));
      between(double(step + 1) / double(count));
    }
    return;
  }
  const std::vector<GroupSteps> groups = explicit_.advance_frame(begin, duration, between, tell);
  report_ += explicit_.report();
  brick_steps_ += brick_steps_of(world_, groups);
  const auto fewer = [](const GroupSteps& a, const GroupSteps& b) { return a.steps.count < b.steps.count; };
  plan_.steps = std::max_element(groups.begin(), groups.end(), fewer)->steps;
}

void SceneMotion::serialize(IntegratorState& state) {
  explicit_.serialize(state);
  if (implicit_) implicit_->serialize(state);
  driver_.serialize(state);
}

std::optional<ImplicitMotion::Report> SceneMotion::implicit_report() const {
  if (!implicit_) return std::nullopt;
  return implicit_->report();
}

std::vector<Points> SceneMotion::pin_reactions() const {
  std::vector<Points> all;
  for (const SoftBody& body : world_.bodies) {
    Points loads = body.masses * world_.gravity.transpose();
    if (LoadForces acting(body, world_); acting.any()) loads += acting.forces();
    all.push_back(reactions(body, supports_of(body), loads));
  }
  return all;
}

}  // namespace sprung
