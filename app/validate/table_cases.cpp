#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/validate/cases.h"
#include "app/validate/macneal.h"
#include "app/validate/mapped_block.h"
#include "app/validate/table_scene.h"
#include "core/error.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"

namespace sprung {
namespace {

constexpr double kPi = std::numbers::pi;

/// A quantity that has been published.
struct Target {
  std::string quantity;
  std::function<double(const Recording&)> measure;
  double expected = 0;
  std::string unit;
  double tolerance = 0.02;
};

struct TableCase {
  std::string name;
  std::string source;
  Scene scene;
  std::vector<Target> targets;
};

const ProbeSample& last_of(const Recording& recording, const std::string& probe) {
  for (const ProbeTrack& track : recording.probes) {
    if (track.name == probe) return track.samples.back();
  }
  return recording.probes.at(0).samples.back();
}

Target displacement(const std::string& probe, int axis, double expected, double tolerance = 0.02) {
  return {.quantity = fmt::format("{}.displacement.{}", probe, "xyz"[axis]),
          .measure = [=](const Recording& run) { return last_of(run, probe).displacement[axis]; },
          .expected = expected,
          .unit = "m",
          .tolerance = tolerance};
}

Target stress(const std::string& probe, int axis, double expected, double tolerance = 0.05) {
  const char letter = "xyz"[axis];
  return {.quantity = fmt::format("{}.stress.{}{}", probe, letter, letter),
          .measure = [=](const Recording& run) { return last_of(run, probe).stress[axis]; },
          .expected = expected,
          .unit = "Pa",
          .tolerance = tolerance};
}

Target frequency(int mode, double expected, double tolerance = 0.02) {
  return {.quantity = fmt::format("frequency.{}", mode),
          .measure = [=](const Recording& run) { return run.frequencies[mode - 1]; },
          .expected = expected,
          .unit = "Hz",
          .tolerance = tolerance};
}

const std::string kMacNeal = "MacNeal and Harder, Finite Elements in Analysis and Design 1 (1985)";
const std::string kNafems = "NAFEMS, The Standard NAFEMS Benchmarks (1990)";

TableCase straight_beam() {
  TableScene scene(block_mesh({6, 0.2, 0.1}), 0.1 / 3, 1e7, 0.3);
  scene.hold("x-low").pull("x-high", {0, 1, 0}).probe("tip", {6, 0.1, 0.05});
  return {"straight beam", kMacNeal, scene.scene(), {displacement("tip", 1, 0.1081)}};
}

TableCase curved_beam(int axis, double expected) {
  return {axis == 2 ? "curved beam, out of plane" : "curved beam, in plane",
          kMacNeal,
          curved_beam_scene(axis),
          {displacement("tip", axis, expected)}};
}

TableCase twisted_beam(int axis, double expected, int bricks, double tolerance) {
  return {fmt::format("twisted beam, width of {} bricks, {} plane", bricks, axis == 2 ? "in" : "out of"),
          kMacNeal,
          twisted_beam_scene(axis, bricks),
          {displacement("tip", axis, expected, tolerance)}};
}

TableCase cooks_membrane() {
  const auto trapezoid = [](const Vec3& p) {
    const double low = 44 * p.x();
    const double high = 44 + 16 * p.x();
    return Vec3(48 * p.x(), low + (high - low) * p.y(), p.z());
  };
  TableScene scene(mapped_block({1, 1, 1}, trapezoid), 1, 1, 1.0 / 3);
  scene.hold("x-low").pull("x-high", {0, 1, 0}).probe("tip", {48, 52, 0.5});
  return {"Cook's membrane",
          "Cook, J. Struct. Div. ASCE 100 (1974); 23.96 by refined meshes",
          scene.scene(),
          {displacement("tip", 1, 23.96)}};
}

TableCase thick_tube(double poisson, double expected) {
  const auto quarter = [](const Vec3& p) {
    const double radius = 3 + 6 * p.x();
    const double angle = kPi / 2 * p.y();
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.5 * p.z());
  };
  TableScene scene(mapped_block({1, 90, 1}, quarter), 0.25, 1000, poisson);
  scene.hold("x-low", "x").hold("y-low", "y").hold("z-low", "z").hold("z-high", "z").press("x-low", 1);
  scene.probe("inner", {3, 0, 0.25});
  return {fmt::format("thick tube, nu = {}", poisson), kMacNeal, scene.scene(), {displacement("inner", 0, expected)}};
}

/// A quarter of the plate between two ellipses of NAFEMS LE1 and LE10, from D (2, 0) at "y-low".
SurfaceMesh quarter_of_ellipses(double thickness) {
  const auto quarter = [=](const Vec3& p) {
    const double angle = kPi / 2 * p.y();
    const double a = 2 + 1.25 * p.x();
    const double b = 1 + 1.75 * p.x();
    return Vec3(a * std::cos(angle), b * std::sin(angle), thickness * p.z());
  };
  return mapped_block({1, 90, 1}, quarter);
}

TableCase le1() {
  TableScene scene(quarter_of_ellipses(0.1), 0.05, 210e9, 0.3);
  scene.hold("x-low", "x").hold("y-low", "y").hold("z-low", "z").press("x-high", -10e6).probe("D", {2, 0, 0.05});
  return {"LE1, elliptic membrane", kNafems, scene.scene(), {stress("D", 1, 92.7e6)}};
}

TableCase le10() {
  TableScene scene(quarter_of_ellipses(0.6), 0.075, 210e9, 0.3);
  scene.hold("x-low", "x").hold("y-low", "y").hold_part("x-high").press("z-high", 1e6).probe("D", {2, 0, 0.6});
  return {"LE10, thick plate", kNafems, scene.scene(), {stress("D", 1, -5.38e6)}};
}

/// A square plate with a hole, a quarter: ten diameters wide.
TableCase kirsch() {
  const auto quarter = [](const Vec3& p) {
    const double angle = kPi / 2 * p.y();
    const Vec3 hole(std::cos(angle), std::sin(angle), 0);
    const Vec3 side = hole * (10 / std::max(hole.x(), hole.y()));
    const Vec3 position = hole + p.x() * (side - hole);
    return Vec3(position.x(), position.y(), 0.25 * p.z());
  };
  TableScene scene(mapped_block({1, 90, 1}, quarter), 0.125, 1e5, 0.3);
  scene.hold("x-low", "x").hold("y-low", "y").hold("z-low", "z");
  BodyForce& pull = scene.load("x-high");
  pull.part.clear();
  pull.box = Box{{1, 0, 0}, {1, 1, 1}};
  pull.traction = Vec3(1, 0, 0);
  scene.probe("top", {0, 1, 0.125});
  return {"plate with a hole",
          "Kirsch (1898); at this width Pilkey, Peterson's Stress Concentration Factors, chart 4.1",
          scene.scene(),
          {stress("top", 0, 3.035)}};
}

TableCase bent_by_45_degrees() {
  const auto arc = [](const Vec3& p) {
    const double radius = 99.5 + p.x();
    const double angle = kPi / 4 * p.y();
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), p.z());
  };
  TableScene scene(mapped_block({1, 45, 1}, arc), 0.25, 1e7, 0, Solver::kStatic);
  scene.steps(4).hold("y-low").pull("y-high", {0, 0, 600});
  const double side = 100 * std::sqrt(0.5);
  scene.probe("tip", {side, side, 0.5});
  // Positions in the source: (15.9, 47.2, 53.4) where y is along the root and x inward, from (29.3, 70.7, 0).
  return {"45 degree bend, large displacement",
          "Bathe and Bolourchi, Int. J. Numer. Meth. Engng 14 (1979)",
          scene.scene(),
          {displacement("tip", 2, 53.4), displacement("tip", 1, 47.2 - 70.71)}};
}

TableCase end_shear() {
  TableScene scene(block_mesh({10, 1, 0.1}), 0.05, 1.2e6, 0, Solver::kStatic);
  scene.steps(4).hold("x-low").pull("x-high", {0, 0, 4}).probe("tip", {10, 0.5, 0.05});
  return {"cantilever under end shear, large displacement",
          "Sze, Liu and Lo, Finite Elements in Analysis and Design 40 (2004)",
          scene.scene(),
          {displacement("tip", 2, 6.698), displacement("tip", 0, -3.286)}};
}

TableCase fv32() {
  const auto taper = [](const Vec3& p) {
    const double width = 5 - 4 * p.x();
    return Vec3(10 * p.x(), width * (p.y() - 0.5), 0.1 * p.z());
  };
  TableScene scene(mapped_block({1, 1, 1}, taper), 0.1, 200e9, 0.3, Solver::kModes);
  scene.density(8000).modes(6).hold("x-low").hold("z-low", "z").probe("tip", {10, 0, 0.05});
  const std::array<double, 6> expected{44.623, 130.03, 162.70, 246.05, 379.90, 391.44};
  TableCase made{"FV32, tapered membrane", kNafems, scene.scene(), {}};
  for (int mode = 1; mode <= 6; ++mode) made.targets.push_back(frequency(mode, expected[mode - 1]));
  return made;
}

TableCase plate_on_edges(bool on_lines) {
  TableScene scene(block_mesh({10, 10, 1}), 0.25, 200e9, 0.3, Solver::kModes);
  scene.density(8000).modes(5).probe("middle", {5, 5, 0.5});
  if (!on_lines) {
    scene.hold("x-low", "yz").hold("x-high", "yz").hold("y-low", "xz").hold("y-high", "xz");
    const double scale = std::sqrt(200e9 / (2 * 1.3 * 8000)) / (2 * kPi);  // of lambda = omega h sqrt(rho / G)
    return {"solid plate, simply supported faces",
            "Srinivas, Joga Rao and Rao, J. Sound Vib. 12 (1970)",
            scene.scene(),
            {frequency(1, 0.0932 * scale), frequency(2, 0.2226 * scale), frequency(3, 0.2226 * scale)}};
  }
  for (const char* side : {"x-low", "x-high", "y-low", "y-high"}) scene.hold_edge(side, "z-low", "z");
  // Modes 1 to 3 of the source are rigid. A solid yields along a line support, the more the finer the bricks are; modes
  // that do not bend are not supported by it, and are compared.
  return {"FV52, solid plate supported along lines",
          kNafems,
          scene.scene(),
          {frequency(1, 45.897, kNaN), frequency(2, 109.44, kNaN), frequency(4, 167.89, kNaN), frequency(5, 193.59)}};
}

/// Flanges of 1 m at a web of 2 m, 0.1 m thick; the torque by a force along each flange.
TableCase le5() {
  const std::array<Vec3, 4> line{Vec3(0, -1, -1), Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(0, 1, 1)};
  const std::array<Vec3, 4> aside{Vec3(0, 0, 1), Vec3(0, -1, 1), Vec3(0, -1, 1), Vec3(0, 0, 1)};  // mitred
  const auto section = [=](const Vec3& p) {
    const double place = 4 * p.y();  // along the line
    const std::size_t at = place <= 1 ? 0 : place <= 3 ? 1 : 2;
    const double share = at == 0 ? place : at == 1 ? (place - 1) / 2 : place - 3;
    const Vec3 middle = (1 - share) * line[at] + share * line[at + 1];
    const Vec3 out = (1 - share) * aside[at] + share * aside[at + 1];
    return Vec3(Vec3(10 * p.x(), 0, 0) + middle + 0.1 * (p.z() - 0.5) * out);
  };
  TableScene scene(mapped_block({1, 4, 1}, section), 0.05, 210e9, 0.3);
  scene.hold("x-low").probe("A", {2.5, 1, 1});
  for (const double side : {0.0, 1.0}) {
    BodyForce& shear = scene.load("");
    shear.box = Box{{1, 0, side == 0 ? 0 : 0.95}, {1, 1, side == 0 ? 0.05 : 1}};
    shear.total = Vec3(0, side == 0 ? -0.6e6 : 0.6e6, 0);
    shear.on_surface = true;
  }
  return {"LE5, Z-section cantilever", kNafems, scene.scene(), {stress("A", 0, -108e6)}};
}

std::vector<TableCase> table_cases() {
  return {straight_beam(),
          curved_beam(1, 0.08734),
          curved_beam(2, 0.5022),
          twisted_beam(2, 0.005424, 12, kNaN),
          twisted_beam(1, 0.001754, 12, kNaN),
          twisted_beam(2, 0.005424, 24, 0.04),
          twisted_beam(1, 0.001754, 24, 0.04),
          cooks_membrane(),
          thick_tube(0.3, 4.5825e-3),
          thick_tube(0.4999, 5.0623e-3),
          le1(),
          le10(),
          kirsch(),
          bent_by_45_degrees(),
          end_shear(),
          le5(),
          fv32(),
          plate_on_edges(false),
          plate_on_edges(true)};
}

}  // namespace

CaseResult run_tables(const Choice& choice, const Observer& observer) {
  CaseResult result;
  if (choice.bricks || choice.poisson) return result;  // each has its own
  const Observer silent;
  for (const TableCase& one : table_cases()) {
    observer.check_interrupt();
    Scene scene = one.scene;
    scene.bodies[0].model = choice.model.value_or(Model::kCalibrated);
    std::optional<Recording> run;
    std::string trouble;
    int bricks = 0;
    try {
      Simulation simulation = prepare_simulation(scene, silent);
      bricks = simulation.world.bodies.at(0).grid.brick_count();
      run = simulate(simulation, scene, silent);
    } catch (const Error& error) {
      trouble = error.what();
    }
    for (const Target& target : one.targets) {
      result.checks.push_back({.experiment = "tables",
                               .quantity = fmt::format("{}: {}", one.name, target.quantity),
                               .model = std::string(model_name(scene.bodies[0].model)),
                               .poisson = scene.bodies[0].material.poisson,
                               .grid = fmt::format("{}", bricks),
                               .measured = run ? target.measure(*run) : kNaN,
                               .expected = target.expected,
                               .unit = target.unit,
                               .source = one.source,
                               .tolerance = target.tolerance,
                               .trouble = trouble});
    }
  }
  return result;
}

}  // namespace sprung
