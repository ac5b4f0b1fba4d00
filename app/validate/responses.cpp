#include "app/validate/responses.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/body/brick_model.h"
#include "core/dynamics/statics/statics.h"

namespace sprung {
namespace {

constexpr int kMaxSteps = 60;
constexpr double kProbe = 1e-6;      // for the slope by central differences
constexpr double kThickness = 0.1;   // of the beam, m
constexpr double kBeamLength = 0.4;  // m
constexpr double kYoung = 1000;      // Pa; ratios of deflections do not depend on it
/// rho g L^4 / (8 E I) with I = A H^2 / 12, for a weight of 1 N/m^3, m.
constexpr double kBeamTheory =
    12 * kBeamLength * kBeamLength * kBeamLength * kBeamLength / (8 * kYoung * kThickness * kThickness);

/// The zero of `force` (of the sideways stretch) near `start`, by Newton's method with limited steps.
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

/// Forces (N) on the x and y faces that hold a brick of side 1 m at stretches s along x and t along y and z.
struct FaceForces {
  double along = 0;
  double sideways = 0;
};

/// `brick`: a body of one.
FaceForces face_forces(const Body& brick, double s, double t) {
  const Vec3 stretches(s, t, t);
  BrickVector x = BrickVector::Zero();
  for (int i = 0; i < 24; ++i) {
    if (on_high_side(i / 3, i % 3)) x[i] = stretches[i % 3];
  }
  const BrickVector force = brick_model(brick.model).forces(brick, 0, x);
  FaceForces faces;
  for (int corner = 0; corner < 8; ++corner) {
    if (on_high_side(corner, 0)) faces.along -= force[3 * corner];
    if (on_high_side(corner, 1)) faces.sideways -= force[3 * corner + 1];
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

Material light_material(double young, double poisson) {
  return {.name = "light", .young = young, .poisson = poisson, .density = 1, .damping = 0, .source = ""};
}

UniaxialResponse brick_uniaxial(Model model, const Material& material, double stretch) {
  const Body brick = make_body(make_box_grid({1, 1, 1}, 1), model, material);
  const double t = solve_sideways(first_guess(material, stretch),
                                  [&](double side) { return face_forces(brick, stretch, side).sideways; });
  return {t, face_forces(brick, stretch, t).along};
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

std::vector<UniaxialLaw> uniaxial_laws(std::span<const Model> models, const Material& material) {
  std::vector<UniaxialLaw> laws;
  for (const Model model : models) {
    laws.push_back({std::string(model_name(model)), model,
                    [=](double stretch) { return brick_uniaxial(model, material, stretch); }});
  }
  laws.push_back({"neo-Hookean", {}, [=](double stretch) { return neo_hookean_uniaxial(material, stretch); }});
  laws.push_back(
      {"St. Venant-Kirchhoff", {}, [=](double stretch) { return st_venant_kirchhoff_uniaxial(material, stretch); }});
  return laws;
}

double cantilever_deflection(Model model, double poisson, int across) {
  const Body body = make_body(make_box_grid({4 * across, across, across}, kThickness / across), model,
                              light_material(kYoung, poisson));
  Supports supports(body.node_count());
  Points weight = Points::Zero(body.node_count(), 3);
  weight.col(1) = -body.masses;  // 1 kg/m^3 at 1 m/s^2
  std::vector<int> tips;         // the four corners of the free end
  for (int node = 0; node < body.node_count(); ++node) {
    const Eigen::Vector3i place = body.grid.lattice[node];
    if (place.x() == 0) supports.fix(node);
    if (place.x() == 4 * across && place.y() % across == 0 && place.z() % across == 0) tips.push_back(node);
  }
  const auto system = make_direct_solver();
  const Eigen::VectorXd moved = solve_linear(body, supports, weight, *system);
  double sum = 0;
  for (const int tip : tips) sum -= moved[3 * tip + 1];
  return sum / double(tips.size()) / kBeamTheory;
}

std::span<const DeflectionAt> reference_deflections() {
  static constexpr std::array<DeflectionAt, 7> kReference{{{0, 0.004030315 / kBeamTheory},
                                                           {0.1, 0.004040113 / kBeamTheory},
                                                           {0.25, 0.00402089 / kBeamTheory},
                                                           {0.3, 0.004004546 / kBeamTheory},
                                                           {0.4, 0.00395431 / kBeamTheory},
                                                           {0.45, 0.00391884 / kBeamTheory},
                                                           {0.49, 0.003884205 / kBeamTheory}}};
  return kReference;
}

}  // namespace sprung
