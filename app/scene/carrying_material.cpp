#include "app/scene/carrying_material.h"

#include <algorithm>
#include <vector>

#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "core/simulation/drivers.h"
#include "core/simulation/simulation.h"

namespace sprung {
namespace {

constexpr int kBricks = 16;  // along the longest side
constexpr double kSag = 0.04;
constexpr double kOverload = 2;          // times the weight, which must not buckle it:
constexpr double kOverloadResponse = 3;  // times the displacement, at most
constexpr int kHalvings = 4;             // of the size

// What does not come to rest quickly is near buckling.
constexpr StaticOptions kQuick{.tolerance = 1e-5, .max_iterations = 30, .max_load_steps = 4};

/// Elastomers, the softest first.
std::vector<const LibraryMaterial*> elastomers(const MaterialLibrary& library) {
  std::vector<const LibraryMaterial*> found;
  for (const LibraryMaterial& material : library.materials()) {
    const MaterialClass kind = material.material_class;
    if (kind == MaterialClass::kGelatin || kind == MaterialClass::kSilicone || kind == MaterialClass::kRubber) {
      found.push_back(&material);
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const LibraryMaterial* a, const LibraryMaterial* b) {
    return a->young / a->density < b->young / b->density;
  });
  return found;
}

/// A scene of the body alone, held and coarse.
Scene standing_scene(const SceneBody& body, const Pin& held, const Vec3& gravity) {
  Scene scene;
  scene.gravity = gravity;
  scene.solver.scheme = Solver::kStatic;
  SceneBody& standing = scene.bodies.emplace_back(body);
  standing.bricks = kBricks;
  standing.brick_size.reset();
  standing.pins = {held};
  standing.pins.front().keyframes.clear();
  standing.velocity.setZero();
  standing.spin.setZero();
  return scene;
}

/// Finds the equilibria of the held solids of a body under multiples of its weight.
class StandingBody {
 public:
  explicit StandingBody(Simulation& simulation) : simulation_(simulation) {
    for (const SoftBody& body : simulation.world.bodies) {
      systems_.push_back(body.pinned.empty() ? nullptr : make_default_solver());
    }
  }

  /// The largest displacement of a node, m; none where there is no equilibrium. Solids that nothing holds are left out.
  std::optional<double> displacement(double weight, bool is_linear) {
    double largest = 0;
    for (std::size_t row = 0; row < systems_.size(); ++row) {
      if (!systems_[row]) continue;
      SoftBody& body = simulation_.world.bodies[row];
      body.positions = body.rest_positions;
      const Points loads = weight * body.masses * simulation_.world.gravity.transpose();
      const Supports supports = supports_of(body);
      try {
        if (is_linear) {
          const Points still = Points::Zero(body.node_count(), 3);
          body.positions += linear_response(body, supports, loads, still, *systems_[row]).displacements;
        } else {
          solve_static(body, supports, loads, body.rest_positions, *systems_[row], kQuick);
        }
      } catch (const Error&) {
        return std::nullopt;
      }
      largest = std::max(largest, (body.positions - body.rest_positions).rowwise().norm().maxCoeff());
    }
    return largest;
  }

 private:
  Simulation& simulation_;
  std::vector<std::unique_ptr<LinearSolver>> systems_;
};

}  // namespace

std::optional<CarryingMaterial> softest_carrying(const SceneBody& body, const Pin& held, const Vec3& gravity,
                                                 bool may_shrink, const MaterialLibrary& library,
                                                 const Observer& observer) {
  const std::vector<const LibraryMaterial*> materials = elastomers(library);
  if (materials.empty()) return std::nullopt;
  Progress progress(observer, "material");
  Scene scene = standing_scene(body, held, gravity);
  const LibraryMaterial& reference = *materials[materials.size() / 2];
  scene.bodies[0].material = reference.material();
  const Observer silent;
  const std::vector<LoadedBody> loaded{load_body(scene.bodies[0], silent)};
  const double size = loaded[0].extent.maxCoeff();
  Simulation simulation = build_world(scene, loaded, silent);
  StandingBody standing(simulation);
  const std::optional<double> linear = standing.displacement(1, true);
  if (!linear || *linear <= 0) return std::nullopt;

  constexpr double kHopeless = 2;  // times the sag by the linear solution: not worth a nonlinear one
  for (int halving = 0; halving <= (may_shrink ? kHalvings : 0); ++halving) {
    const double scale = std::pow(0.5, halving);
    for (const LibraryMaterial* material : materials) {
      observer.check_interrupt();
      const double weight = scale * material->density / reference.density * reference.young / material->young;
      if (weight * *linear > kHopeless * kSag * size) continue;
      const std::optional<double> once = standing.displacement(weight, false);
      if (!once || *once > kSag * size) continue;
      const std::optional<double> twice = standing.displacement(kOverload * weight, false);
      if (!twice || *twice > kOverloadResponse * *once) continue;
      return CarryingMaterial{material, scale * size, *once / size};
    }
  }
  return std::nullopt;
}

}  // namespace sprung
