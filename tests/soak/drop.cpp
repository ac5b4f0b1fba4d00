#include "tests/soak/drop.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/body/brick_model.h"
#include "core/bricks/fill_solid.h"
#include "core/contact/inversion_guard.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/error.h"
#include "core/mesh/io/read_mesh.h"
#include "core/world/make_soft_body.h"
#include "tests/soak/dice.h"
#include "tests/support/meshes.h"

namespace sprung::test {
namespace {

constexpr double kGravity = 9.81;
constexpr double kPeriods = 8;  // after the fall
constexpr double kFramesPerPeriod = 4;
constexpr double kMaxDepth = 0.02;  // of the size
constexpr double kMaxGain = 0.05;   // of the energy at the start

enum class Shape { kBricks, kBox, kTorus, kBear };
constexpr std::array kShapeNames{"bricks", "box", "torus", "bear"};

SurfaceMesh mesh_of_shape(Shape shape, Dice& dice) {
  switch (shape) {
    case Shape::kBear:
      return read_mesh(std::filesystem::path(SPRUNG_SOURCE_DIR) / "assets/models/bear.ply");
    case Shape::kTorus:
      return torus_mesh(1, dice.between(0.2, 0.6), 48, 24);
    case Shape::kBricks:
    case Shape::kBox:
      break;
  }
  return box_mesh(Vec3::Zero(), Vec3(1, dice.between(0.2, 1), dice.between(0.2, 1)));
}

/// A body of that size (m), as the program makes it; of bricks alone: contact is at their corners.
SoftBody make_soft_body_of(Shape shape, double size, Model model, const Material& material, Dice& dice) {
  if (shape == Shape::kBricks) {
    const Eigen::Vector3i counts(dice.whole(1, 5), dice.whole(1, 5), dice.whole(1, 5));
    SoftBody body(make_body(make_box_grid(counts, size / counts.maxCoeff()), model, material));
    body.contact.points = embed(body.grid, body.grid.rest_positions());
    return body;
  }
  SurfaceMesh mesh = mesh_of_shape(shape, dice);
  mesh.positions = mesh.positions * dice.rotation().transpose();
  const Vec3 extent = mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff();
  mesh.positions *= size / extent.maxCoeff();
  const Solid solid = find_solids(mesh, "drop").solids.front();
  FilledSolid filled = fill_solid(solid, size / dice.between(2, 7), bricks_for(model));
  return make_soft_body(mesh, solid, std::move(filled.grid), model, material);
}

double lowest_contact_point(const SoftBody& body) {
  return deform_points(body.grid, body.contact.points, body.positions).col(1).minCoeff();
}

/// Of what contact keeps above the ground: the drawn skin, or contact points where there is none.
double lowest_kept_point(const SoftBody& body) {
  if (body.drawn.mesh == nullptr) return lowest_contact_point(body);
  return body.skin_positions(body.positions).col(1).minCoeff();
}

}  // namespace

Drop random_drop(std::uint32_t seed, std::uint32_t index, Model model, double min_poisson, const StrainEnergyLaw& law) {
  Dice dice(seed, index);
  const Material material{.name = "random",
                          .young = dice.log_between(1e3, 1e9),
                          .poisson = dice.between(min_poisson, 0.49),
                          .density = dice.log_between(100, 5000),
                          .damping = dice.whole(0, 3) == 0 ? 0 : dice.log_between(1e-3, 1),
                          .source = "",
                          .law = law};
  const double size = dice.log_between(1e-3, 10);
  const auto shape = static_cast<Shape>(dice.whole(0, 3));
  Drop drop;
  drop.world.gravity = Vec3(0, -kGravity, 0);
  drop.world.obstacles = {level_ground(0, dice.between(0, 1))};
  drop.world.bodies.push_back(make_soft_body_of(shape, size, model, material, dice));
  SoftBody& body = drop.world.bodies.front();
  place(body, dice.rotation(), Vec3::Zero());
  const double gap = dice.between(0, 0.02) * size;
  place(body, Mat3::Identity(), Vec3(0, gap - lowest_contact_point(body), 0));
  const double speed = dice.whole(0, 4) == 0 ? 0 : dice.between(0, 10);
  const Vec3 velocity = speed * Vec3(dice.between(-0.5, 0.5), -1, dice.between(-0.5, 0.5));
  body.velocities.rowwise() = velocity.transpose();
  drop.size = size;
  drop.period = 2 * size / std::sqrt(material.shear_modulus() / material.density);
  const double fall = gap / std::max(speed, std::sqrt(kGravity * gap / 2));
  drop.duration = fall + kPeriods * drop.period;
  drop.description = fmt::format(
      "{} of {} bricks, {:.3g} m, E {:.3g} Pa, nu {:.3g}, {:.4g} kg/m^3, damping {:.3g}, {:.3g} m/s, friction {:.2g}",
      kShapeNames[std::size_t(shape)], body.grid.brick_count(), size, material.young, material.poisson,
      material.density, material.damping, speed, drop.world.obstacles[0].friction);
  return drop;
}

DropResult run_drop(Drop& drop) {
  DropResult result;
  const SoftBody& body = drop.world.bodies.front();
  const int frames = int(std::ceil(drop.duration / drop.period * kFramesPerPeriod));
  const double frame = drop.duration / frames;
  const double scale = body.masses.sum() * kGravity * body.grid.brick_size;
  const double first = energy_of(body, drop.world.gravity).sum();
  AdaptiveIntegrator motion(drop.world, Scheme::kSymplecticEuler);
  try {
    for (int i = 0; i < frames; ++i) {
      const std::vector<GroupSteps> groups = motion.advance_frame(
          i * frame, frame, [](double) {}, [&](const std::string&) { ++result.halvings; });
      result.brick_steps += groups[0].steps.count * body.grid.brick_count();
      result.deepest = std::max(result.deepest, -lowest_kept_point(body) / drop.size);
      result.energy_gain =
          std::max(result.energy_gain, (energy_of(body, drop.world.gravity).sum() - first) / (first + scale));
      result.inverted_on_the_way = std::max(result.inverted_on_the_way, inverted_bricks(body));
    }
  } catch (const Error& error) {
    result.fault = error.what();
    return result;
  }
  result.inverted_bricks = inverted_bricks(body);
  result.smallest_volume = smallest_volume_ratio(body);
  if (result.inverted_bricks > 0) result.fault = fmt::format("{} inverted bricks at the end", result.inverted_bricks);
  if (result.deepest > kMaxDepth) result.fault += fmt::format("; {:.3g} of its size below the ground", result.deepest);
  if (result.energy_gain > kMaxGain) result.fault += fmt::format("; {:.3g} more energy", result.energy_gain);
  return result;
}

}  // namespace sprung::test
