#pragma once
#include <array>
#include <random>

#include "core/body/body.h"
#include "core/body/brick_hessian.h"
#include "core/body/brick_kernel.h"

namespace sprung::test {

/// Poisson's ratios that every exact property is checked at.
inline constexpr std::array<double, 7> kPoissonRatios{-0.2, 0, 0.1, 0.25, 0.3, 0.4, 0.49};
inline constexpr std::array<Model, 2> kCorrectedModels{Model::kTensile, Model::kM1};

inline Material test_material(double poisson, double young = 1e4) {
  return {.name = "test", .young = young, .poisson = poisson, .density = 1000, .damping = 0, .source = ""};
}

/// Every strain-energy density, with parameters.
inline const std::array<StrainEnergyLaw, 6> kStrainEnergyLaws{{
    {},
    {.kind = StrainEnergyKind::kMooneyRivlin, .mooney_share = 0.3},
    {.kind = StrainEnergyKind::kFung, .fung_exponent = 0.4},
    {.kind = StrainEnergyKind::kOgden, .ogden_exponents = {3.5}},
    {.kind = StrainEnergyKind::kOgden, .ogden_exponents = {1.3, 5, -2}, .ogden_shares = {0.75, 0.05, 0.2}},
    {.kind = StrainEnergyKind::kLinear},
}};

inline Material material_of_law(const StrainEnergyLaw& law, double poisson) {
  Material material = test_material(poisson);
  material.law = law;
  return material;
}

/// A brick's corners at rest, its low corner at the origin.
inline CornerVectors<double> rest_brick(double h) {
  CornerVectors<double> x{};
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      x[3 * corner + axis] = on_high_side(corner, axis) ? h : 0;
    }
  }
  return x;
}

/// The mass-spring stiffness of a brick at rest, 24 x 24, N/m.
inline BrickMatrix rest_stiffness(Model model, const Material& material, double h) {
  return brick_hessian(brick_law(model, material, h), h, rest_brick(h));
}

/// Corner displacements (24) of a displacement field given at points centred on the brick.
template <class Field>
Eigen::Matrix<double, 24, 1> corner_displacements(double h, const Field& field) {
  Eigen::Matrix<double, 24, 1> u;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = on_high_side(corner, axis) ? h / 2 : -h / 2;
    u.segment<3>(3 * corner) = field(point);
  }
  return u;
}

/// Shakes every node by up to `amount` of a brick in each direction.
inline void shake(Body& body, double amount, std::mt19937& random) {
  std::uniform_real_distribution<double> distance(-amount * body.grid.brick_size, amount * body.grid.brick_size);
  for (double& coordinate : body.positions.reshaped()) coordinate += distance(random);
}

}  // namespace sprung::test
