#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/validate/cut_parts.h"
#include "app/validate/responses.h"
#include "core/dynamics/statics/statics.h"

namespace sprung {
namespace {

/// Whole bricks, two across: the remaining error is that of the clamp, which such bricks resolve worse the less
/// compressible the solid is.
void add_clamped(std::vector<CutPart>& parts) {
  const auto add = [&](double poisson, double expected, const std::string& source) {
    parts.push_back(
        {"8x2x2",
         poisson,
         {{"clamped beam under its weight: sag over theory", expected, "", source, poisson <= 0.3 ? 0.03 : kNaN}},
         [=](Model model) { return std::vector{cantilever_deflection(model, poisson, 2)}; }});
  };
  for (const DeflectionAt& known : reference_deflections()) {
    add(known.poisson, known.deflection, "finite elements (CalculiX C3D20R, converged)");
  }
  add(0.499, 0.003876852 / 0.00384, kCalculix);  // over rho g L^4 / (8 E I)
}

/// Apparent modulus over E of a block 2 x 2 x 1 between plates that it is bonded to.
double bonded_modulus(Model model, double poisson) {
  constexpr int kHigh = 4;
  constexpr double kPressed = 0.01;
  const Body body =
      make_body(make_box_grid({2 * kHigh, 2 * kHigh, kHigh}, 1.0 / kHigh), model, light_material(1, poisson));
  Supports supports(body.node_count());
  Points moved = Points::Zero(body.node_count(), 3);
  std::vector<int> top;
  for (int node = 0; node < body.node_count(); ++node) {
    const int z = body.grid.lattice[node].z();
    if (z == 0 || z == kHigh) supports.fix(node);
    if (z != kHigh) continue;
    moved(node, 2) = -kPressed;
    top.push_back(node);
  }
  const auto system = make_direct_solver();
  const Points forces = linear_response(body, supports, Points::Zero(body.node_count(), 3), moved, *system).reactions;
  double sum = 0;
  for (const int node : top) sum -= forces(node, 2);
  return sum / 4 / kPressed;
}

void add_bonded(std::vector<CutPart>& parts) {
  for (const auto& [poisson, expected] :
       {std::pair{0.0, 1.0}, {0.3, 1.13593}, {0.45, 1.44209}, {0.49, 1.61539}, {0.499, 1.66594}}) {
    parts.push_back({"8x8x4",
                     poisson,
                     {{"bonded block: modulus over E", expected, "", kCalculix, poisson <= 0.3 ? 0.02 : kNaN}},
                     [nu = poisson](Model model) { return std::vector{bonded_modulus(model, nu)}; }});
  }
}

/// A cube of 5 kPa, 20 cm, whose base is fixed, under its weight.
/// Height (m) of its middle, inverted bricks, steps of Newton's method.
std::vector<double> standing_cube(Model model, double poisson) {
  constexpr int kAcross = 8;
  Material material = light_material(5e3, poisson);
  material.density = 1000;
  Body body = make_body(make_box_grid({kAcross, kAcross, kAcross}, 0.2 / kAcross), model, material);
  const auto [supports, loads] = supported_at(body, 2, Vec3(0, 0, -9.81));
  const auto system = make_default_solver();
  const StaticReport report = solve_static(body, supports, loads, body.rest_positions, *system);
  const auto top =
      std::find(body.grid.lattice.begin(), body.grid.lattice.end(), Eigen::Vector3i(kAcross / 2, kAcross / 2, kAcross));
  return {body.positions(top - body.grid.lattice.begin(), 2), double(inverted_bricks(body)), double(report.iterations)};
}

void add_standing_cubes(std::vector<CutPart>& parts) {
  for (const auto& [poisson, height] : {std::pair{0.3, 0.166307}, {0.45, 0.168964}, {0.49, 0.170016}}) {
    parts.push_back({"8x8x8",
                     poisson,
                     {{"standing cube: height", height, "m", "the same model, 32 bricks across", 0.02},
                      {"standing cube: inverted bricks", 0, "", "it stands", 0.5},
                      {"standing cube: Newton steps", 4, "", "at most twice as many", 1}},
                     [nu = poisson](Model model) { return standing_cube(model, nu); }});
  }
}

/// Nominal stress over E of one brick whose nodes follow a deformation, except along the axes that are free.
double brick_stress(Model model, double poisson, const Mat3& gradient, const Eigen::Array<bool, 3, 1>& free, int row,
                    int column) {
  Body body = make_body(make_box_grid({1, 1, 1}, 1), model, light_material(1, poisson));
  const Points start = body.positions;
  body.positions = start * gradient.transpose();
  Supports supports(body.node_count());
  for (int node = 0; node < body.node_count(); ++node) {
    for (int axis = 0; axis < 3; ++axis) {
      supports.fixed[3 * node + axis] = !free[axis] || body.grid.lattice[node][axis] == 0;
    }
  }
  const Points none = Points::Zero(body.node_count(), 3);
  const auto system = make_direct_solver();
  solve_static(body, supports, none, body.positions, *system);
  return (reactions(body, supports, none).transpose() * start)(row, column);  // of a volume of 1
}

/// Nominal principal stress over E of the neo-Hookean solid of this model along the first axis; the stretches of free
/// axes, which are one and the same, make their stresses zero.
double closed_form_stress(double poisson, Vec3& stretches, const Eigen::Array<bool, 3, 1>& free) {
  const Material material = light_material(1, poisson);
  const double shear = material.shear_modulus();
  const double lambda = material.lame_lambda();
  const auto stress = [&](int axis) {
    const double s = stretches[axis];
    const double volume = stretches.prod();
    return shear * s + (lambda * (volume - 1) - shear / volume) * volume / s;
  };
  double low = 0.1;
  double high = 10;
  for (int halving = 0; halving < 100; ++halving) {
    const double middle = (low + high) / 2;
    for (int axis = 0; axis < 3; ++axis) stretches[axis] = free[axis] ? middle : stretches[axis];
    (stress(2) < 0 ? low : high) = middle;
  }
  return stress(0);
}

void add_strains(std::vector<CutPart>& parts) {
  constexpr double kPoisson = 0.3;
  const auto add = [&](const std::string& what, const Mat3& gradient, const Eigen::Array<bool, 3, 1>& free, int column,
                       double expected) {
    parts.push_back(
        {"1x1x1",
         kPoisson,
         {{fmt::format("brick {}: stress over E", what), expected, "", "the principal stresses of a neo-Hookean solid",
           1e-6}},
         [=](Model model) { return std::vector{brick_stress(model, kPoisson, gradient, free, 0, column)}; }});
  };
  for (const double stretch : {0.3, 0.5, 0.75, 1.5, 2.0, 3.0}) {
    const Eigen::Array<bool, 3, 1> sides{false, true, true};
    Vec3 one(stretch, 1, 1);
    const double along = closed_form_stress(kPoisson, one, sides);
    add(fmt::format("stretched to {}", stretch), one.asDiagonal(), sides, 0, along);
    const Eigen::Array<bool, 3, 1> thickness{false, false, true};
    Vec3 two(stretch, stretch, 1);
    const double both = closed_form_stress(kPoisson, two, thickness);
    add(fmt::format("stretched to {} both ways", stretch), two.asDiagonal(), thickness, 0, both);
  }
  for (const double shear : {0.3, 1.0, 3.0}) {
    Mat3 gradient = Mat3::Identity();
    gradient(0, 1) = shear;
    add(fmt::format("sheared by {}", shear), gradient, {false, false, false}, 1, shear / (2 * (1 + kPoisson)));
  }
}

}  // namespace

std::vector<CutPart> strained_parts() {
  std::vector<CutPart> parts;
  add_clamped(parts);
  add_bonded(parts);
  add_standing_cubes(parts);
  add_strains(parts);
  return parts;
}

}  // namespace sprung
