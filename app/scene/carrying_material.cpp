#include "app/scene/carrying_material.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
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
constexpr double kHopeless = 2;          // times the sag by the linear solution: not worth a nonlinear one
constexpr int kHalvings = 4;             // of the size
constexpr double kHeldFraction = 0.08;   // of the height
constexpr double kFill = 0.25;           // a brick is taken to be at least that full

// What does not come to rest quickly is near buckling.
constexpr StaticOptions kQuick{.tolerance = 1e-4, .max_iterations = 20, .max_load_steps = 1};

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

struct Choice {
  const LibraryMaterial* material;
  double scale;   // of the size
  double weight;  // of the body at full size and of the reference material that displaces it as much
};

/// In the order in which they are wanted.
std::vector<Choice> choices_of(const std::vector<const LibraryMaterial*>& materials, const LibraryMaterial& reference,
                               int halvings) {
  std::vector<Choice> choices;
  for (int halving = 0; halving <= halvings; ++halving) {
    const double scale = std::pow(0.5, halving);
    for (const LibraryMaterial* material : materials) {
      choices.push_back(
          {material, scale, scale * material->density / reference.density * reference.young / material->young});
    }
  }
  return choices;
}

/// A scene of the body alone, coarse.
Scene standing_scene(const SceneBody& body, const Vec3& gravity) {
  Scene scene;
  scene.gravity = gravity;
  scene.solver.scheme = Solver::kStatic;
  SceneBody& standing = scene.bodies.emplace_back(body);
  standing.bricks = kBricks;
  standing.brick_size.reset();
  standing.pins.clear();
  standing.velocity.setZero();
  standing.spin.setZero();
  return scene;
}

/// Finds the equilibria of the held solids of a body under multiples of its weight.
class StandingBody {
 public:
  StandingBody(Simulation& simulation, Support support) : simulation_(simulation) {
    for (SoftBody& body : simulation.world.bodies) {
      hold(body, support);
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

  /// Whether it keeps its shape: no node is displaced by more than `most` (m).
  bool is_carried(double weight, double most) {
    const std::optional<double> once = displacement(weight, false);
    if (!once || *once > most) return false;
    const std::optional<double> more = displacement(kOverload * weight, false);
    return more && *more <= kOverloadResponse * *once;
  }

 private:
  /// Holds the part of a body that carries it, and lets no brick be much softer than the others: what is hardly filled
  /// would sag by itself.
  void hold(SoftBody& body, Support support) const {
    const Eigen::VectorXd heights = body.rest_positions * -simulation_.world.gravity.normalized();
    const double low = heights.minCoeff();
    const double high = heights.maxCoeff();
    const double part = kHeldFraction * (high - low);
    for (int node = 0; node < body.node_count(); ++node) {
      const bool is_held = support == Support::kStands ? heights[node] <= low + part : heights[node] >= high - part;
      if (is_held) body.pinned.push_back({.node = node});
    }
    for (double& scale : body.stiffness_scale) scale = std::max(scale, kFill);
    build_tiles(body);
  }

  Simulation& simulation_;
  std::vector<std::unique_ptr<LinearSolver>> systems_;
};

}  // namespace

std::optional<CarryingMaterial> softest_carrying(const SceneBody& body, Support support, const Vec3& gravity,
                                                 bool may_shrink, const MaterialLibrary& library,
                                                 const Observer& observer) {
  const std::vector<const LibraryMaterial*> materials = elastomers(library);
  if (materials.empty()) return std::nullopt;
  Progress progress(observer, "material");
  Scene scene = standing_scene(body, gravity);
  const LibraryMaterial& reference = *materials[materials.size() / 2];
  scene.bodies[0].material = reference.material();
  const Observer silent;
  const std::vector<LoadedBody> loaded{load_body(scene.bodies[0], silent)};
  const double size = loaded[0].extent.maxCoeff();
  Simulation simulation = build_world(scene, loaded, silent);
  StandingBody standing(simulation, support);
  const std::optional<double> linear = standing.displacement(1, true);
  if (!linear || *linear <= 0) return std::nullopt;

  const std::vector<Choice> choices = choices_of(materials, reference, may_shrink ? kHalvings : 0);
  std::vector<double> weights;
  for (const Choice& choice : choices) weights.push_back(choice.weight);
  std::sort(weights.begin(), weights.end(), std::greater<>());
  const auto carried = std::partition_point(weights.begin(), weights.end(), [&](double weight) {
    observer.check_interrupt();
    return weight * *linear > kHopeless * kSag * size || !standing.is_carried(weight, kSag * size);
  });
  if (carried == weights.end()) return std::nullopt;
  const auto chosen =
      std::find_if(choices.begin(), choices.end(), [&](const Choice& choice) { return choice.weight <= *carried; });
  const std::optional<double> sag = standing.displacement(chosen->weight, false);
  if (!sag) return std::nullopt;
  return CarryingMaterial{chosen->material, chosen->scale * size, *sag / size};
}

}  // namespace sprung
