#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "app/validate/cases.h"
#include "app/validate/macneal.h"
#include "app/validate/mapped_block.h"
#include "app/validate/responses.h"
#include "app/validate/table_scene.h"
#include "core/bricks/pieces.h"
#include "core/dynamics/statics/modes.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "core/mesh/repair/solids.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"

namespace sprung {
namespace {

constexpr double kPi = std::numbers::pi;
const std::string kCalculix = "finite elements (CalculiX C3D20R, tests/references/curved.py)";

/// A figure of a part, and what it should be.
struct CutFigure {
  std::string quantity;
  double expected = 0;
  std::string unit;
  std::string source;
  double tolerance = kNaN;  // of neo-hooke
};

/// A part, whose figures a model has all at once.
struct CutPart {
  std::string bricks;
  double poisson = 0;
  std::vector<CutFigure> figures;
  std::function<std::vector<double>(Model)> measure;
};

/// A block with its low corner at the origin.
SurfaceMesh block_mesh(const Vec3& sides) {
  return mapped_block({1, 1, 1}, [=](const Vec3& p) { return Vec3(p.cwiseProduct(sides)); });
}

/// The displacement (m) of the probe of a scene along an axis.
double probed(Scene scene, Model model, int axis) {
  scene.bodies[0].model = model;
  const Observer silent;
  Simulation simulation = prepare_simulation(scene, silent);
  return simulate(simulation, scene, silent).probes.at(0).samples.back().displacement[axis];
}

/// Held at every node of a side; the weights of the others' nodes as loads.
struct Held {
  Supports supports;
  Points loads;
};

Held held_at(const Body& body, int axis, const Vec3& acceleration) {
  Held held{.supports = Supports(body.node_count()), .loads = body.masses * acceleration.transpose()};
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.grid.lattice[node][axis] == 0) held.supports.fix(node);
  }
  return held;
}

/// Tip sag over beam theory of a plate 20 x 1 x 1 bricks, `thickness` bricks thick, `low` bricks up.
double plate_sag(Model model, double thickness, double low, double poisson) {
  constexpr int kLength = 20;
  const Vec3 from(0, 0, low);
  SurfaceMesh mesh = block_mesh(Vec3(kLength, 1, thickness));
  mesh.positions.rowwise() += from.transpose();
  BrickGrid grid = make_box_grid({kLength, 1, 1}, 1);
  grid.fill.assign(kLength, thickness);
  split_pieces(find_solids(mesh, "plate").solids.at(0), grid);
  grid.moments = solid_moments(grid);
  const Body body = make_body(std::move(grid), model, light_material(1e6, poisson));
  const auto [supports, loads] = held_at(body, 0, Vec3(0, 0, -1e-3));
  const auto system = make_direct_solver();
  const Eigen::VectorXd u = solve_linear(body, supports, loads, *system);
  double sag = 0;
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.grid.lattice[node].x() == kLength) sag -= u[3 * node + 2] / 4;
  }
  return sag / (1e-3 * std::pow(kLength, 4) * 12 / (8 * 1e6 * thickness * thickness));
}

/// The one of five positions in the bricks that is furthest from 1.
double worst_plate(Model model, double thickness, double poisson) {
  double worst = 1;
  for (const double share : {0.0, 0.21, 0.5, 0.83, 1.0}) {
    const double sag = plate_sag(model, thickness, share * (1 - thickness), poisson);
    if (std::abs(sag - 1) > std::abs(worst - 1)) worst = sag;
  }
  return worst;
}

void add_plates(std::vector<CutPart>& parts) {
  for (const double poisson : {0.0, 0.3}) {
    for (const double thickness : {0.2, 0.25, 0.35, 0.5, 0.67, 0.8, 1.0}) {
      parts.push_back({"20x1x1",
                       poisson,
                       {{fmt::format("plate of {} bricks: sag over theory", thickness), 1, "",
                         "beam theory; the worst of five positions in the bricks", 0.01}},
                       [=](Model model) { return std::vector{worst_plate(model, thickness, poisson)}; }});
    }
  }
}

/// A part that is a scene with one probe.
CutPart probed_part(const Scene& scene, const std::string& bricks, int axis, CutFigure figure) {
  return {bricks, scene.bodies[0].material.poisson, {std::move(figure)}, [=](Model model) {
            return std::vector{probed(scene, model, axis)};
          }};
}

/// Tip deflection of a square beam, ten times as long as thick, that so many bricks fill across.
void add_beams(std::vector<CutPart>& parts) {
  for (const double across : {1.5, 2.5, 3.5, 4.5, 5.5}) {
    TableScene scene(block_mesh({10, 1, 1}), 1 / across, 1e6, 0);
    scene.hold("x-low").pull("x-high", {0, 0, 1}).probe("tip", {10, 0.5, 0.5});
    // L^3 / (3 E I) and shear, kappa = 10/12 at nu = 0.
    const double expected = (4 * 1000 + 10 * 2 * 1.2) / 1e6;
    parts.push_back(probed_part(scene.scene(), fmt::format("{} across", across), 2,
                                {"beam, end load: tip.displacement.z", expected, "m", "Timoshenko's beam", 0.02}));
  }
}

/// A solid rod about the x axis, ten diameters long, of diameter 1.
SurfaceMesh rod_mesh() {
  const auto disc = [](const Vec3& p) {
    const double y = 2 * p.y() - 1;
    const double z = 2 * p.z() - 1;
    const double square = std::max(std::abs(y), std::abs(z));
    const double length = std::hypot(y, z);
    const double scale = length > 0 ? square / length / 2 : 0;
    return Vec3(10 * p.x(), scale * y, scale * z);
  };
  return mapped_block({1, 16, 16}, disc);
}

void add_rods(std::vector<CutPart>& parts) {
  constexpr double kStiffness = 1e6;  // Pa
  constexpr double kPoisson = 0.3;
  // The mesh has 64 sides: its second moment is that of the polygon.
  const double angle = 2 * kPi / 64;
  const double polar = 64 * std::sin(angle) * (2 + std::cos(angle)) / 12 * std::pow(0.5, 4);
  const double area = 32 * 0.25 * std::sin(angle);
  const double shear = kStiffness / (2 * (1 + kPoisson));
  for (const int across : {4, 8}) {
    TableScene bent(rod_mesh(), 1.0 / across, kStiffness, kPoisson);
    bent.hold("x-low").pull("x-high", {0, 0, 1}).probe("tip", {10, 0, 0});
    const double factor = 6 * (1 + kPoisson) / (7 + 6 * kPoisson);
    parts.push_back(probed_part(
        bent.scene(), fmt::format("{} across", across), 2,
        {"round rod, end load: tip.displacement.z", 1000 / (3 * kStiffness * polar / 2) + 10 / (factor * shear * area),
         "m", "Timoshenko's beam", 0.02}));
    TableScene twisted(rod_mesh(), 1.0 / across, kStiffness, kPoisson);
    twisted.hold("x-low").load("x-high").moment = Vec3(1, 0, 0);
    twisted.probe("rim", {10, 0.5, 0});
    parts.push_back(
        probed_part(twisted.scene(), fmt::format("{} across", across), 2,
                    {"round rod, torque: rim.displacement.z", 10 / (shear * polar) / 2, "m", "Saint-Venant", 0.02}));
  }
}

/// The body of a scene, its bricks turned about z and, by 0.6 of that, about y.
Body turned_body(Scene scene, double degrees, Model model) {
  scene.bodies[0].model = model;
  scene.bodies[0].brick_rotation = Vec3(0, 0.6 * degrees, degrees);
  const Observer silent;
  return prepare_simulation(scene, silent).world.bodies.at(0);
}

struct FreeVibration {
  double bending = kNaN;  // Hz, of the mode most like the first bending along x
  int spurious = 0;       // modes below 0.9 of what it should be
};

FreeVibration free_vibration(const Body& body, double length, double expected) {
  constexpr int kModes = 24;
  const Modes modes = natural_modes(body, Supports(body.node_count()), kModes);
  // The shape of a free beam: cosh, cos, sinh and sin of 4.73004 x / L.
  constexpr double kWaves = 4.730040745;
  const double ratio = (std::cosh(kWaves) - std::cos(kWaves)) / (std::sinh(kWaves) - std::sin(kWaves));
  Eigen::VectorXd weights(body.node_count());
  const double low = body.rest_positions.col(0).mean() - length / 2;
  for (int node = 0; node < body.node_count(); ++node) {
    const double s = kWaves * (body.rest_positions(node, 0) - low) / length;
    weights[node] = body.masses[node] * (std::cosh(s) + std::cos(s) - ratio * (std::sinh(s) + std::sin(s)));
  }
  FreeVibration found;
  double best = 0;
  for (Eigen::Index mode = 0; mode < modes.frequencies.size(); ++mode) {
    const auto shape = modes.shapes.col(mode).reshaped<Eigen::RowMajor>(body.node_count(), 3);
    const double likeness = (weights.transpose() * shape).rightCols(2).squaredNorm();
    if (likeness > best) {
      best = likeness;
      found.bending = modes.frequencies[mode];
    }
    found.spurious += modes.frequencies[mode] < 0.9 * expected ? 1 : 0;
  }
  return found;
}

/// Free of all supports, so that no clamp stands between the law and theory.
void add_turned(std::vector<CutPart>& parts) {
  struct Free {
    std::string name;
    Vec3 sides;
    double brick;
    std::string bricks;
    double expected;  // Hz
  };
  // Of whole bricks of the calibrated model, 12 across the beam and 8 across the plate.
  constexpr double kOfBeam = 0.006968;
  constexpr double kOfPlate = 0.005115;
  const std::vector<Free> bodies{{"beam", {12, 1, 1}, 1, "1 across", kOfBeam},
                                 {"beam", {12, 1, 1}, 0.5, "2 across", kOfBeam},
                                 {"plate", {10, 4, 0.5}, 1, "1/2 across", kOfPlate},
                                 {"plate", {10, 4, 0.5}, 0.5, "1 across", kOfPlate}};
  for (const Free& free : bodies) {
    const Scene scene = TableScene(block_mesh(free.sides), free.brick, 1, 0.3).scene();
    for (const double degrees : {0.0, 15.0, 30.0, 45.0}) {
      const std::string name = fmt::format("free {} turned by {} degrees", free.name, degrees);
      parts.push_back({free.bricks,
                       0.3,
                       {{name + ": frequency of bending", free.expected, "Hz", "fine whole bricks", kNaN},
                        {name + ": modes below it", 0, "", "bending is the slowest vibration", kNaN}},
                       [=](Model model) {
                         const FreeVibration found =
                             free_vibration(turned_body(scene, degrees, model), free.sides.x(), free.expected);
                         return std::vector{found.bending, double(found.spurious)};
                       }});
    }
  }
}

/// The plate held at one end, its bricks turned; what free vibrations say of the law this says with a clamp.
void add_clamped_plates(std::vector<CutPart>& parts) {
  for (const double brick : {1.0, 0.5}) {
    for (const double degrees : {0.0, 15.0, 30.0, 45.0}) {
      TableScene plate(block_mesh({10, 4, 0.5}), brick, 1000, 0.3);
      plate.hold_part("x-low").pull("x-high", {0, 0, 1}).probe("tip", {10, 2, 0.25});
      Scene scene = plate.scene();
      scene.bodies[0].brick_rotation = Vec3(0, 0.6 * degrees, degrees);
      parts.push_back(probed_part(scene, brick == 1 ? "1/2 across" : "1 across", 2,
                                  {fmt::format("clamped plate turned by {} degrees: tip.displacement.z", degrees),
                                   7.77316, "m", kCalculix, kNaN}));
    }
  }
}

/// A cube of 5 kPa, 20 cm, whose base is held, under its weight.
/// Height (m) of its middle, inverted bricks, steps of Newton's method.
std::vector<double> standing_cube(Model model, double poisson) {
  constexpr int kAcross = 8;
  Material material = light_material(5e3, poisson);
  material.density = 1000;
  Body body = make_body(make_box_grid({kAcross, kAcross, kAcross}, 0.2 / kAcross), model, material);
  const auto [supports, loads] = held_at(body, 2, Vec3(0, 0, -9.81));
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
                     {{"standing cube: height", height, "m", "neo-hooke, 32 bricks across", 0.02},
                      {"standing cube: inverted bricks", 0, "", "it stands", 0.5},
                      {"standing cube: Newton steps", 4, "", "at most twice as many", 1}},
                     [nu = poisson](Model model) { return standing_cube(model, nu); }});
  }
}

/// Of one brick, whose nodes are held where a deformation puts them but along the axes that are free: nominal stress
/// over E.
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
/// axes, which are one and the same, make their stresses zero. Below a volume ratio of 0.2 its pressure is linear in J.
double closed_form_stress(double poisson, Vec3& stretches, const Eigen::Array<bool, 3, 1>& free) {
  const Material material = light_material(1, poisson);
  const double shear = material.shear_modulus();
  const double lambda = material.lame_lambda();
  const auto stress = [&](int axis) {
    const double s = stretches[axis];
    const double volume = stretches.prod();
    const double slope = volume >= 0.2 ? 1 / volume : 10 - 25 * volume;  // of log J, and of its parabola
    return shear * s + (lambda * (volume - 1) - shear * slope) * volume / s;
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

/// Whole bricks, two across: what is left is the clamp, which such bricks resolve the worse the less the solid gives
/// way sideways.
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

/// Half a brick thick, on no line of the bricks.
void add_shells(std::vector<CutPart>& parts) {
  constexpr double kPoisson = 0.3;
  const auto ring = [](const Vec3& p) {
    const double radius = 9.75 + 0.5 * p.x();
    return Vec3(radius * std::cos(kPi * p.y()), radius * std::sin(kPi * p.y()), p.z());
  };
  for (const auto& [axis, expected] : {std::pair{0, 150.838}, {2, 462.453}}) {
    TableScene scene(mapped_block({1, 180, 1}, ring), 1, 1000, kPoisson);
    scene.hold_part("y-high").pull("y-low", Vec3::Unit(axis)).probe("tip", {10, 0, 0.5});
    parts.push_back(
        probed_part(scene.scene(), "1/2 across", axis,
                    {fmt::format("half ring: tip.displacement.{}", "xyz"[axis]), expected, "m", kCalculix, kNaN}));
  }
  const auto segment = [](const Vec3& p) {
    const double radius = 9.75 + 0.5 * p.x();
    const double azimuth = kPi / 2 * p.y();
    const double elevation = kPi / 3 * p.z();
    return Vec3(radius * std::cos(elevation) * std::cos(azimuth), radius * std::cos(elevation) * std::sin(azimuth),
                radius * std::sin(elevation));
  };
  TableScene scene(mapped_block({1, 60, 40}, segment), 1, 1000, kPoisson);
  scene.hold_part("y-low").pull("y-high", {1, 0, 0}).probe("tip", {0, 10, 0});
  parts.push_back(probed_part(scene.scene(), "1/2 across", 0,
                              {"spherical shell: tip.displacement.x", 0.412165, "m", kCalculix, kNaN}));
}

void add_macneal(std::vector<CutPart>& parts) {
  const std::string source = "MacNeal and Harder (1985)";
  for (const auto& [axis, twisted, curved] : {std::tuple{1, 0.001754, 0.08734}, {2, 0.005424, 0.5022}}) {
    const std::string tip = fmt::format("tip.displacement.{}", "xyz"[axis]);
    for (const int bricks : {6, 12}) {
      parts.push_back(probed_part(twisted_beam_scene(axis, bricks), fmt::format("{} across", bricks), axis,
                                  {"twisted beam: " + tip, twisted, "m", source, 0.01}));
    }
    parts.push_back(
        probed_part(curved_beam_scene(axis), "3 across", axis, {"curved beam: " + tip, curved, "m", source, 0.02}));
  }
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

/// An L of walls 6 mm thick, 80 x 60 x 30 mm, its leg on a wall, 50 N at the end of its arm; so many bricks along that.
void add_brackets(std::vector<CutPart>& parts) {
  const auto walls = [](const Vec3& p) {
    const double deep = 6 * p.y();
    const double along = 2 * p.x();
    const double height = along <= 1 ? 60 + along * (deep - 60) : deep;
    const double length = along <= 1 ? deep : deep + (along - 1) * (80 - deep);
    return Vec3(length, height, 30 * p.z());
  };
  for (const int bricks : {12, 16, 20, 23, 24, 28, 32, 36, 48, 80}) {
    TableScene scene(mapped_block({2, 1, 1}, walls), 80.0 / bricks, 2100, 0.35);
    scene.hold("x-low").pull("x-high", {0, -50, 0}).probe("tip", {80, 3, 15});
    parts.push_back(probed_part(scene.scene(), fmt::format("{} along", bricks), 1,
                                {"bracket: tip.displacement.y (mm)", -6.511, "",
                                 "finite elements (CalculiX C3D10, tests/references/parts.py)", kNaN}));
  }
}

std::vector<CutPart> cut_parts() {
  std::vector<CutPart> parts;
  add_plates(parts);
  add_beams(parts);
  add_rods(parts);
  add_turned(parts);
  add_clamped_plates(parts);
  add_clamped(parts);
  add_shells(parts);
  add_macneal(parts);
  add_bonded(parts);
  add_brackets(parts);
  add_standing_cubes(parts);
  add_strains(parts);
  return parts;
}

}  // namespace

CaseResult run_cut(const Choice& choice, const Observer& observer) {
  CaseResult result;
  if (choice.bricks || choice.poisson) return result;  // each has its own
  std::vector<Model> models{Model::kCalibrated, Model::kNeoHooke};
  if (choice.model) models = {*choice.model};
  for (const CutPart& part : cut_parts()) {
    for (const Model model : models) {
      observer.check_interrupt();
      std::vector<double> measured(part.figures.size(), kNaN);
      std::string trouble;
      try {
        measured = part.measure(model);
      } catch (const Error& error) {
        trouble = error.what();
      }
      for (std::size_t i = 0; i < measured.size(); ++i) {
        const CutFigure& figure = part.figures[i];
        result.checks.push_back({.experiment = "cut",
                                 .quantity = figure.quantity,
                                 .model = std::string(model_name(model)),
                                 .poisson = part.poisson,
                                 .grid = part.bricks,
                                 .measured = measured[i],
                                 .expected = figure.expected,
                                 .unit = figure.unit,
                                 .source = figure.source,
                                 .tolerance = model == Model::kNeoHooke ? figure.tolerance : kNaN,
                                 .trouble = trouble});
      }
    }
  }
  return result;
}

}  // namespace sprung
