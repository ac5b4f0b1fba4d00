#include "app/scene/supporting_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/body/brick_model.h"
#include "core/bricks/fill_solid.h"
#include "core/simulation/body_source.h"
#include "core/simulation/selector.h"

namespace sprung {
namespace {

constexpr int kBricks = 16;           // along the longest side,
constexpr double kManyBricks = 1500;  // but not many more than these in all, since compact bodies need no fine ones
constexpr double kManyBricksInFilm = 2500;
constexpr double kManyBrickSteps = 6e7;  // explicit ones, for a second of film
constexpr double kSag = 0.04;
constexpr double kLinearSag = 1.5;  // times as much by the linear solution: an equilibrium may sag less
constexpr int kHalvings = 4;        // of the size

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

/// The first element that does not fail, of some that do and then some that do not: looked for in growing strides from
/// `likely` on, and by bisection.
template <class Iterator, class Fails>
Iterator first_that_holds(Iterator first, Iterator likely, Iterator last, const Fails& fails) {
  for (std::ptrdiff_t stride = 1; likely != last && fails(*likely); stride *= 2) {
    first = likely + 1;
    likely += std::min(stride, last - likely);
  }
  return std::partition_point(first, likely, fails);
}

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
  StandingBody standing(std::move(grids), body.model, reference.material().in_motion(), support, body.pins,
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
    const auto possible =
        std::partition_point(materials.begin(), materials.end(), sags_beyond(kLinearSag * kSag * size));
    const auto likely = std::partition_point(possible, materials.end(), sags_beyond(kSag * size));
    const auto softest = first_that_holds(possible, likely, materials.end(), fails);
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
