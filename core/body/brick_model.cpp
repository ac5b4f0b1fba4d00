#include "core/body/brick_model.h"

#include <algorithm>

#include "core/body/brick_damping.h"
#include "core/body/brick_hessian.h"
#include "core/body/brick_kernel.h"
#include "core/body/brick_measures.h"
#include "core/law/solid/solid_brick.h"

namespace sprung {

BricksFor bricks_for(Model model) { return model == Model::kCalibrated ? BricksFor::kMoments : BricksFor::kFill; }

double region_factor(const Body& body, std::size_t brick) {
  return body.stiffness_scale[brick] / std::max(body.grid.fill[brick], kStiffnessFloor);
}

BrickVector at_corners(const Body& body, std::size_t brick, const Points& values) {
  return columns_of(body.grid.nodes[brick], values).reshaped();
}

BrickVector BrickModel::damped_forces(const Body& body, std::size_t brick, const BrickVector& x,
                                      const BrickVector& v) const {
  BrickVector sum = forces(body, brick, x);
  if (body.damping.beta > 0) sum -= body.damping.beta * damping_product(body, brick, x, v);
  return sum;
}

BrickVector BrickModel::product(const Body& body, std::size_t brick, const BrickVector& x, const BrickVector& u) const {
  return hessian(body, brick, x, false) * u;
}

BrickVector BrickModel::damping_product(const Body& body, std::size_t brick, const BrickVector& x,
                                        const BrickVector& v) const {
  return damping(body, brick, x) * v;
}

Mat3 BrickModel::gradient(const Body& body, std::size_t /*brick*/, const BrickVector& x) const {
  return mean_axes_of(x.reshaped(3, 8)) / body.grid.brick_size;
}

Vec3 BrickModel::middle(const Body& /*body*/, std::size_t /*brick*/) const { return Vec3::Zero(); }

/// St. Venant-Kirchhoff.
Mat3 BrickModel::second_stress(const Body& body, const Mat3& gradient, double young) const {
  const Mat3 green_strain = 0.5 * (gradient.transpose() * gradient - Mat3::Identity());
  return hooke_stress(green_strain, young, body.material.poisson);
}

namespace {

BrickVector corners_at_rest(double h) {
  BrickVector x;
  for (int i = 0; i < 24; ++i) x[i] = on_high_side(i / 3, i % 3) ? h : 0;
  return x;
}

CornerVectors<double> as_corners(const BrickVector& x) {
  CornerVectors<double> corners;
  std::copy(x.begin(), x.end(), corners.begin());
  return corners;
}

/// Mass-spring systems: the law of a full brick (BrickLaw), scaled by the fill.
class SpringModel : public BrickModel {
 public:
  [[nodiscard]] double energy(const Body& body, std::size_t brick, const BrickVector& x) const override {
    CornerVectors<double> force{};
    return body.stiffness_scale[brick] *
           brick_forces<double>(body.law, body.grid.brick_size, as_corners(x), nullptr, force);
  }

  [[nodiscard]] BrickVector forces(const Body& body, std::size_t brick, const BrickVector& x) const override {
    CornerVectors<double> force{};
    brick_forces<double>(body.law, body.grid.brick_size, as_corners(x), nullptr, force);
    return body.stiffness_scale[brick] * Eigen::Map<const BrickVector>(force.data());
  }

  [[nodiscard]] BrickMatrix hessian(const Body& body, std::size_t brick, const BrickVector& x,
                                    bool /*definite*/) const override {
    return body.stiffness_scale[brick] * brick_hessian(body.law, body.grid.brick_size, as_corners(x));
  }

  /// Axial stiffness of the springs only.
  [[nodiscard]] BrickMatrix damping(const Body& body, std::size_t brick, const BrickVector& x) const override {
    const auto directions = spring_directions(body.grid.brick_size, as_corners(x));
    BrickMatrix matrix;
    for (int column = 0; column < 24; ++column) {
      CornerVectors<double> unit{};
      unit[column] = 1;
      CornerVectors<double> product{};
      sprung::damping_product(body.law, directions, unit, product);
      matrix.col(column) = body.stiffness_scale[brick] * Eigen::Map<const BrickVector>(product.data());
    }
    return matrix;
  }

  [[nodiscard]] BrickMatrix full_brick_hessian(const Body& body) const override {
    const double h = body.grid.brick_size;
    return brick_hessian(body.law, h, as_corners(corners_at_rest(h)));
  }
};

/// Trilinear hexahedra whose force is linear in the displacement from rest, scaled by the fill.
class HexahedronModel : public BrickModel {
 public:
  [[nodiscard]] double energy(const Body& body, std::size_t brick, const BrickVector& x) const override {
    const BrickVector u = displacement(body, brick, x);
    return 0.5 * body.stiffness_scale[brick] * u.dot(body.small_strain_stiffness * u);
  }

  [[nodiscard]] BrickVector forces(const Body& body, std::size_t brick, const BrickVector& x) const override {
    return -body.stiffness_scale[brick] * (body.small_strain_stiffness * displacement(body, brick, x));
  }

  [[nodiscard]] BrickVector damped_forces(const Body& body, std::size_t brick, const BrickVector& x,
                                          const BrickVector& v) const override {
    const BrickVector ahead = displacement(body, brick, x) + body.damping.beta * v;
    return -body.stiffness_scale[brick] * (body.small_strain_stiffness * ahead);
  }

  [[nodiscard]] BrickMatrix hessian(const Body& body, std::size_t brick, const BrickVector& /*x*/,
                                    bool /*definite*/) const override {
    return body.stiffness_scale[brick] * body.small_strain_stiffness;
  }

  [[nodiscard]] BrickVector product(const Body& body, std::size_t brick, const BrickVector& /*x*/,
                                    const BrickVector& u) const override {
    return body.stiffness_scale[brick] * (body.small_strain_stiffness * u);
  }

  [[nodiscard]] BrickMatrix damping(const Body& body, std::size_t brick, const BrickVector& x) const override {
    return hessian(body, brick, x, false);
  }

  [[nodiscard]] BrickVector damping_product(const Body& body, std::size_t brick, const BrickVector& x,
                                            const BrickVector& v) const override {
    return product(body, brick, x, v);
  }

  [[nodiscard]] BrickMatrix full_brick_hessian(const Body& body) const override { return body.small_strain_stiffness; }

 private:
  static BrickVector displacement(const Body& body, std::size_t brick, const BrickVector& x) {
    return x - at_corners(body, brick, body.rest_positions);
  }
};

SolidBrick solid_brick(const Body& body, std::size_t brick) {
  const auto& [moments, curved] = body.solids[brick];
  return {body.material, body.grid.brick_size, body.grid.fill[brick], moments, *curved};
}

/// Bricks with the moments of their solid.
class SolidModel : public BrickModel {
 public:
  [[nodiscard]] double energy(const Body& body, std::size_t brick, const BrickVector& x) const override {
    return region_factor(body, brick) * solid_brick(body, brick).energy(x);
  }

  [[nodiscard]] BrickVector forces(const Body& body, std::size_t brick, const BrickVector& x) const override {
    return region_factor(body, brick) * solid_brick(body, brick).forces(x);
  }

  [[nodiscard]] BrickMatrix hessian(const Body& body, std::size_t brick, const BrickVector& x,
                                    bool definite) const override {
    return region_factor(body, brick) * solid_brick(body, brick).hessian(x, definite);
  }

  [[nodiscard]] BrickMatrix damping(const Body& body, std::size_t brick, const BrickVector& x) const override {
    return region_factor(body, brick) * solid_brick(body, brick).damping(x);
  }

  [[nodiscard]] BrickVector damping_product(const Body& body, std::size_t brick, const BrickVector& x,
                                            const BrickVector& v) const override {
    return region_factor(body, brick) * solid_brick(body, brick).damping_product(x, v);
  }

  [[nodiscard]] BrickMatrix full_brick_hessian(const Body& body) const override {
    const double h = body.grid.brick_size;
    return SolidBrick(body.material, h, 1, {}).hessian(corners_at_rest(h), false);
  }

  [[nodiscard]] Mat3 gradient(const Body& body, std::size_t brick, const BrickVector& x) const override {
    return solid_brick(body, brick).gradient(x);
  }

  [[nodiscard]] Vec3 middle(const Body& body, std::size_t brick) const override {
    return body.solids[brick].moments.centroid;
  }

  /// F^-1 P, unless the solid is inverted.
  [[nodiscard]] Mat3 second_stress(const Body& body, const Mat3& gradient, double young) const override {
    constexpr double kFlat = 0.05;  // volume ratio
    if (gradient.determinant() < kFlat) return BrickModel::second_stress(body, gradient, young);
    return young / body.material.young * gradient.inverse() * StrainEnergy(body.material).stress(gradient);
  }
};

}  // namespace

BrickVector volume_rates(const Body& body, std::size_t brick) {
  return solid_brick(body, brick).volume_rates(at_corners(body, brick, body.positions));
}

const BrickModel& brick_model(Model model) {
  static const SpringModel springs;
  static const HexahedronModel hexahedra;
  static const SolidModel solids;
  switch (model) {
    case Model::kFem:
      return hexahedra;
    case Model::kCalibrated:
      return solids;
    case Model::kTensile:
    case Model::kM1:
    case Model::kM2Plain:
    case Model::kM1Plain:
      break;
  }
  return springs;
}

}  // namespace sprung
