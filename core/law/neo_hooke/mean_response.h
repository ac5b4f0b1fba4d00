#pragma once
#include "core/law/brick_vector.h"
#include "core/law/neo_hooke/strain_energy.h"
#include "core/types.h"

namespace sprung {

/// The part of a brick's energy that its mean deformation has: W = V psi(F), F the gradient of the trilinear map of its
/// corners at the centroid of its solid.
class MeanResponse {
 public:
  /// `h`: m, the brick's side; `volume`: V, m^3; `centroid`: from the brick's middle, in brick lengths.
  MeanResponse(const Material& material, double h, double volume, const Vec3& centroid);

  [[nodiscard]] Mat3 gradient(const BrickVector& x) const;
  [[nodiscard]] const NeoHooke& law() const { return law_; }

  [[nodiscard]] double energy(const BrickVector& x) const;
  void add_forces(const BrickVector& x, BrickVector& forces) const;
  void add_hessian(const BrickVector& x, bool definite, BrickMatrix& matrix) const;
  void add_damping(const BrickVector& x, BrickMatrix& matrix) const;
  void add_damping_product(const BrickVector& x, const BrickVector& v, BrickVector& product) const;

 private:
  void add(const GradientMatrix& of_gradient, BrickMatrix& matrix) const;

  NeoHooke law_;
  double volume_;
  Eigen::Matrix<double, 8, 3> weights_;  // gradients of the corners' trilinear weights at the centroid, 1/m
};

}  // namespace sprung
