#include "app/report/uniaxial.h"

#include <cmath>
#include <limits>

#include "core/body/brick_kernel.h"

namespace sprung {

namespace {

constexpr int kMaxSteps = 60;
constexpr double kProbe = 1e-6;  // for the slope by central differences

/// The zero of `force` (of the sideways stretch) near `start`, by Newton's method with steps kept small.
template <class Force>
double solve_sideways(double start, const Force& force) {
  double t = start;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double slope = (force(t + kProbe) - force(t - kProbe)) / (2 * kProbe);
    double move = -force(t) / slope;
    if (!std::isfinite(move)) break;
    if (std::abs(move) > 0.1 * t) move = std::copysign(0.1 * t, move);
    t += move;
    if (std::abs(move) < 1e-13) return t;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Forces that hold a brick of side 1 m at stretches s along x and t along y and z, N = Pa: on its x and y faces.
struct FaceForces {
  double along = 0;
  double sideways = 0;
};

FaceForces face_forces(const BrickLaw& law, double s, double t) {
  CornerVectors<double> x{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto axis = int(i % 3);
    if (on_high_side(int(i / 3), axis)) x[i] = axis == 0 ? s : t;
  }
  CornerVectors<double> force{};
  brick_forces<double>(law, 1, x, nullptr, force);
  FaceForces faces;
  for (std::size_t i = 0; i < x.size(); i += 3) {
    if (on_high_side(int(i / 3), 0)) faces.along -= force[i];
    if (on_high_side(int(i / 3), 1)) faces.sideways -= force[i + 1];
  }
  return faces;
}

/// P_i of a stretch s_i, see the header.
double neo_hookean_stress(const Material& material, double s, double t, double along) {
  const double volume = s * t * t;
  const double bulk = material.young / (3 * (1 - 2 * material.poisson));
  const double invariant = s * s + 2 * t * t;
  return material.shear_modulus() * std::pow(volume, -2.0 / 3) * (along - invariant / (3 * along)) +
         bulk * (volume - 1) * volume / along;
}

double first_guess(const Material& material, double stretch) { return std::pow(stretch, -material.poisson); }

}  // namespace

UniaxialResponse brick_uniaxial(Model model, const Material& material, double stretch) {
  const BrickLaw law = brick_law(model, material, 1);
  const double t = solve_sideways(first_guess(material, stretch),
                                  [&](double side) { return face_forces(law, stretch, side).sideways; });
  return {t, face_forces(law, stretch, t).along};
}

UniaxialResponse st_venant_kirchhoff_uniaxial(const Material& material, double stretch) {
  const double green = 0.5 * (stretch * stretch - 1);
  return {std::sqrt(1 - 2 * material.poisson * green), material.young * stretch * green};
}

UniaxialResponse neo_hookean_uniaxial(const Material& material, double stretch) {
  const double t = solve_sideways(first_guess(material, stretch),
                                  [&](double side) { return neo_hookean_stress(material, stretch, side, side); });
  return {t, neo_hookean_stress(material, stretch, t, stretch)};
}

}  // namespace sprung
