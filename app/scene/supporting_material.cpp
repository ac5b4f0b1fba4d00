#include "app/scene/supporting_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "core/body/brick_model.h"
#include "core/bricks/fill_solid.h"
#include "core/dynamics/explicit/integrator.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "core/simulation/body_source.h"
#include "core/simulation/selector.h"

namespace sprung {
namespace {

constexpr int kBricks = 16;           // along the longest side,
constexpr double kManyBricks = 1500;  // but not many more than these in all, since compact bodies need no fine ones
constexpr double kManyBricksInFilm = 2500;
constexpr double kManyBrickSteps = 6e7;  // explicit ones, for a second of film
constexpr double kSag = 0.04;
constexpr double kOverload = 2;             // times the weight, which must not buckle it:
constexpr double kOverloadResponse = 3;     // times the displacement, at most
constexpr double kKeptMargin = 0.6;         // of the distance from the centre of mass to the edge of the feet
constexpr double kHopeless = 1.5;           // times the displacement allowed: not worth going on
constexpr int kHalvings = 4;                // of the size
constexpr double kStandingFraction = 0.04;  // of the height, as round bodies flatten, ...
constexpr double kHangingFraction = 0.08;   // ... or as the scenario pins, ...
constexpr double kSupportedBricks = 0.5;    // ... but at least so many bricks: these may be askew
constexpr double kFill = 0.25;              // a brick is taken to be at least that full

// Sags are told to a thousandth; what does not converge quickly is near buckling.
const StaticOptions kQuick{.tolerance = 1e-3, .direction_tolerance = 1e-2, .max_iterations = 20, .max_load_steps = 1};

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

double count_of_bricks(const std::vector<BrickGrid>& grids) {
  double count = 0;
  for (const BrickGrid& grid : grids) count += grid.brick_count();
  return count;
}

/// Along the longest side, so that a film takes seconds. `count` and `steps`: bricks, and explicit steps for a second
/// of film, where kBricks are along it.
int bricks_for_film(double count, double steps) {
  const double by_count = std::cbrt(kManyBricksInFilm / count);
  const double by_steps = std::pow(kManyBrickSteps / (count * steps), 0.25);
  return std::clamp(int(kBricks * std::min(by_count, by_steps)), kBricks * 3 / 4, kDefaultBricks);
}

/// The speed of pressure waves, m/s.
double wave_speed(const Material& material) {
  return std::sqrt((material.lame_lambda() + 2 * material.shear_modulus()) / material.density);
}

/// The solids of a body with bricks of that size.
std::vector<BrickGrid> filled(const LoadedBody& loaded, double brick_size, Model model) {
  if (loaded.grid) return {*loaded.grid};
  std::vector<BrickGrid> grids;
  for (const Solid& solid : loaded.solids) grids.push_back(fill_solid(solid, brick_size, bricks_for(model)).grid);
  return grids;
}

std::vector<Body> standing_bodies(std::vector<BrickGrid> grids, Model model, const Material& material) {
  std::vector<Body> bodies;
  for (BrickGrid& grid : grids) {
    Body& body = bodies.emplace_back(make_body(std::move(grid), model, material));
    // Hardly filled bricks would sag by themselves.
    for (double& scale : body.stiffness_scale) scale = std::max(scale, kFill);
    build_tiles(body);
  }
  return bodies;
}

/// The lowest part of a body, or the highest. `down`: in its frame.
Supports supports_at_end(const Body& body, Support support, const Vec3& down) {
  const Eigen::VectorXd heights = body.rest_positions * -down.normalized();
  const double low = heights.minCoeff();
  const double high = heights.maxCoeff();
  const double fraction = support == Support::kStands ? kStandingFraction : kHangingFraction;
  const double part = std::max(fraction * (high - low), kSupportedBricks * body.grid.brick_size);
  Supports supports(body.node_count());
  for (int node = 0; node < body.node_count(); ++node) {
    const bool is_supported = support == Support::kStands ? heights[node] <= low + part : heights[node] >= high - part;
    for (int axis = 0; is_supported && axis < 3; ++axis) supports.fix(node, axis);
  }
  return supports;
}

Supports supports_by_pins(const Body& body, std::size_t solid, const std::vector<Pin>& pins, const Selector& selector) {
  Supports supports(body.node_count());
  for (const Pin& pin : pins) {
    for (const int node : selector.nodes(pin, body.rest_positions, solid)) {
      for (int axis = 0; axis < 3; ++axis) {
        if (pin.axes.fixed[axis]) supports.fix(node, axis);
      }
    }
  }
  return supports;
}

/// Finds the equilibria of the supported solids of a body under multiples of its weight. `gravity`: in its frame.
class StandingBody {
 public:
  StandingBody(std::vector<Body> solids, Support support, const std::vector<Pin>& pins, const Selector& selector,
               const Vec3& gravity)
      : solids_(std::move(solids)), support_(support), gravity_(gravity) {
    for (std::size_t row = 0; row < solids_.size(); ++row) {
      supports_.push_back(support == Support::kPins ? supports_by_pins(solids_[row], row, pins, selector)
                                                    : supports_at_end(solids_[row], support, gravity));
      systems_.push_back(make_default_solver());
    }
  }

  /// The largest displacement of a node by the linear solution, m; none if the supports leave a solid free to move.
  std::optional<double> linear_displacement() {
    return displaced([this](std::size_t row) {
      Body& body = solids_[row];
      const Points still = Points::Zero(body.node_count(), 3);
      body.positions += linear_response(body, supports_[row], load(row, 1), still, *systems_[row]).displacements;
    });
  }

  /// s, at rest and at full size.
  [[nodiscard]] double stable_step() {
    double shortest = std::numeric_limits<double>::infinity();
    rest();
    for (const Body& body : solids_) shortest = std::min(shortest, sprung::stable_step(body));
    return shortest;
  }

  /// The largest displacement of a node, m, if the body keeps its shape: it is no more than `most`, and a single solid
  /// does not lean so far that it would topple.
  std::optional<double> carried_displacement(double weight, double most) {
    rest();
    const std::optional<double> once = displacement(weight, most);
    if (!once) return std::nullopt;
    if (support_ == Support::kStands && solids_.size() == 1) {
      const Body& body = solids_[0];
      if (margin(body, body.positions) < kKeptMargin * margin(body, body.rest_positions)) return std::nullopt;
    }
    return displacement(kOverload * weight, kOverloadResponse * *once) ? once : std::nullopt;
  }

 private:
  /// The largest displacement of a node of a solid, m.
  static double displacement(const Body& body) {
    return (body.positions - body.rest_positions).rowwise().norm().maxCoeff();
  }

  /// N on each node of a solid, of that multiple of its weight.
  [[nodiscard]] Points load(std::size_t row, double weight) const {
    return weight * solids_[row].masses * gravity_.transpose();
  }

  void rest() {
    for (Body& body : solids_) body.positions = body.rest_positions;
  }

  /// The largest displacement of a node, m, after `move(row)` has moved every solid; none if that throws Error.
  std::optional<double> displaced(const std::function<void(std::size_t)>& move) {
    double largest = 0;
    for (std::size_t row = 0; row < solids_.size(); ++row) {
      try {
        move(row);
      } catch (const Error&) {
        return std::nullopt;
      }
      largest = std::max(largest, displacement(solids_[row]));
    }
    return largest;
  }

  /// The largest displacement of a node in the equilibrium that is found from where the solids are, m; none if there is
  /// none or it is more than `most`.
  std::optional<double> displacement(double weight, double most) {
    const std::optional<double> largest = displaced([&](std::size_t row) {
      Body& body = solids_[row];
      StaticOptions options = kQuick;
      options.between = [&] {
        if (displacement(body) > kHopeless * most) throw Error(ErrorKind::kFailed, "sags too far");
      };
      const Points start = body.positions;
      solve_static(body, supports_[row], load(row, weight), start, *systems_[row], options);
    });
    return largest && *largest <= most ? largest : std::nullopt;
  }

  /// Along the ground, from the centre of mass to the nearest edge of the convex hull of the fixed nodes, m; negative
  /// if it is outside.
  [[nodiscard]] double margin(const Body& body, const Points& positions) const {
    constexpr int kDirections = 32;
    const Vec3 centre = positions.transpose() * body.masses / body.masses.sum();
    const Vec3 u = gravity_.unitOrthogonal();
    const Vec3 v = gravity_.normalized().cross(u);
    double nearest = std::numeric_limits<double>::max();
    for (int k = 0; k < kDirections; ++k) {
      const double turn = 2 * std::numbers::pi * k / kDirections;
      const Vec3 outwards = std::cos(turn) * u + std::sin(turn) * v;
      double farthest = std::numeric_limits<double>::lowest();
      for (int node = 0; node < body.node_count(); ++node) {
        if (!supports_[0].fixed[3 * std::size_t(node)]) continue;
        farthest = std::max(farthest, outwards.dot(positions.row(node).transpose() - centre));
      }
      nearest = std::min(nearest, farthest);
    }
    return nearest;
  }

  std::vector<Body> solids_;
  Support support_;
  Vec3 gravity_;
  std::vector<Supports> supports_;
  std::vector<std::unique_ptr<LinearSolver>> systems_;
};

}  // namespace

std::optional<SupportingMaterial> softest_supporting(const SceneBody& body, Support support, const Vec3& gravity,
                                                     bool may_shrink, const MaterialLibrary& library,
                                                     const Observer& observer) {
  const std::vector<const LibraryMaterial*> materials = elastomers(library);
  if (materials.empty()) return std::nullopt;
  Progress progress(observer, "material");
  const LibraryMaterial& reference = *materials[materials.size() / 2];
  SceneBody coarse = body;
  const bool has_bricks = body.bricks || body.brick_size;
  if (!body.box || !has_bricks) {  // its sides may not be whole bricks of another size
    coarse.bricks = kBricks;
    coarse.brick_size.reset();
  }
  const LoadedBody loaded = load_solids(coarse, Observer());
  const double size = loaded.extent.maxCoeff();
  const Mat3 world_from_bricks = rotation_matrix(body.rotation) * loaded.bricks_from_rest.transpose();
  std::vector<BrickGrid> grids = filled(loaded, loaded.brick_size, body.model);
  const double count = count_of_bricks(grids);
  const double coarser = std::max(1.0, std::cbrt(count / kManyBricks));
  if (coarser > 1) grids = filled(loaded, loaded.brick_size * coarser, body.model);
  StandingBody standing(standing_bodies(std::move(grids), body.model, reference.material()), support, body.pins,
                        Selector(loaded), world_from_bricks.transpose() * gravity);
  const std::optional<double> linear = standing.linear_displacement();
  if (!linear || *linear <= 0) return std::nullopt;

  double lightest_failing = std::numeric_limits<double>::infinity();  // of the reference material at full size
  for (int halving = 0; halving <= (may_shrink ? kHalvings : 0); ++halving) {
    const double scale = std::pow(0.5, halving);
    double sag = 0;  // m, at full size and of the softest that was seen to carry
    // Of the reference material at full size, the weight that displaces it as much.
    const auto weight_of = [&](const LibraryMaterial* material) {
      return scale * material->density / reference.density * reference.young / material->young;
    };
    const auto sags_beyond = [&](double most) {
      return [&, most](const LibraryMaterial* material) { return weight_of(material) * *linear > most; };
    };
    const auto fails = [&](const LibraryMaterial* material) {
      observer.check_interrupt();
      const double weight = weight_of(material);
      if (weight >= lightest_failing) return true;
      const std::optional<double> carried = standing.carried_displacement(weight, kSag * size);
      if (carried) {
        sag = *carried;
      } else {
        lightest_failing = weight;
      }
      return !carried;
    };
    // Few equilibria are needed where the search begins with what carries the body by the linear solution.
    auto from = std::partition_point(materials.begin(), materials.end(), sags_beyond(kHopeless * kSag * size));
    auto to = std::partition_point(from, materials.end(), sags_beyond(kSag * size));
    for (std::ptrdiff_t further = 1; to != materials.end() && fails(*to); further *= 2) {
      from = to + 1;
      to += std::min(further, materials.end() - to);
    }
    const auto softest = std::partition_point(from, to, fails);
    if (softest == materials.end()) continue;
    const double faster = wave_speed((*softest)->material()) / wave_speed(reference.material()) / scale;
    return SupportingMaterial{.material = *softest,
                              .size = scale * size,
                              .sag = sag / size,
                              .bricks = bricks_for_film(count, coarser * faster / standing.stable_step())};
  }
  return std::nullopt;
}

void choose_materials(Film& film, const Observer& observer) {
  for (std::size_t row = 0; row < film.bodies.size(); ++row) {
    SceneBody& body = film.bodies[row];
    if (body.material.name != kAutoMaterial) continue;
    std::optional<SupportingMaterial> found;
    if (body.regions.empty() && film.gravity.norm() > 0) {
      const Support support = body.pins.empty() ? Support::kStands : Support::kPins;
      found = softest_supporting(body, support, film.gravity, false, *film.library, observer);
    }
    body.material = found ? found->material->material() : built_in_materials()->find(kDefaultMaterial).material();
    const std::string why = found ? fmt::format("the softest that keeps its shape (sags {:.1f} %)", 100 * found->sag)
                                  : "since none is named";
    observer.note(fmt::format("material of body {}: {}, {}", row + 1, body.material.name, why));
  }
}

}  // namespace sprung
