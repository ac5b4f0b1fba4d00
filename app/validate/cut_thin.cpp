#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "app/validate/cut_parts.h"
#include "app/validate/macneal.h"
#include "app/validate/mapped_block.h"
#include "app/validate/responses.h"
#include "app/validate/table_scene.h"
#include "core/bricks/pieces.h"
#include "core/dynamics/statics/statics.h"
#include "core/mesh/repair/solids.h"
#include "core/simulation/thin_part_error.h"

namespace sprung {
namespace {

constexpr double kPi = std::numbers::pi;

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
  const auto [supports, loads] = supported_at(body, 0, Vec3(0, 0, -1e-3));
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
    parts.push_back(probed_part(twisted.scene(), fmt::format("{} across", across), 2,
                                {"round rod, torque: rim.displacement.z", 10 / (shear * polar) / 2, "m", "Saint-Venant",
                                 across == 4 ? 0.04 : 0.02}));
  }
}

/// Thin, off the lattice, pinned at the skin: pinning the nodes near it would make a hinge.
void add_shells(std::vector<CutPart>& parts) {
  constexpr double kPoisson = 0.3;
  const auto ring = [](const Vec3& p) {
    const double radius = 9.75 + 0.5 * p.x();
    return Vec3(radius * std::cos(kPi * p.y()), radius * std::sin(kPi * p.y()), p.z());
  };
  for (const auto& [across, name] :
       {std::pair{0.25, "1/4"}, {0.5, "1/2"}, {0.75, "3/4"}, {1.0, "1"}, {1.5, "3/2"}, {2.5, "5/2"}}) {
    for (const auto& [axis, expected] : {std::pair{0, 150.838}, {2, 462.453}}) {
      TableScene scene(mapped_block({1, 180, 1}, ring), 0.5 / across, 1000, kPoisson);
      scene.hold_surface("y-high").pull("y-low", Vec3::Unit(axis)).probe("tip", {10, 0, 0.5});
      parts.push_back(probed_part(scene.scene(), fmt::format("{} across", name), axis,
                                  {fmt::format("half ring: tip.displacement.{}", "xyz"[axis]), expected, "m", kCalculix,
                                   missing_bend(across)}));
    }
  }
  // The surface of an octahedron, blown up; its edges at y = 0 and z = 0 are two sides of the block each.
  const auto quarter_sphere = [](const Vec3& p) {
    const Vec3 on_octahedron(1 - p.y() - p.z(), std::min(p.y(), 1 - p.z()), std::min(p.z(), 1 - p.y()));
    return Vec3((9.75 + 0.5 * p.x()) * on_octahedron.normalized());
  };
  TableScene scene(mapped_block({1, 64, 64}, quarter_sphere), 1, 1000, kPoisson);
  scene.hold_surface("z-low").hold_surface("y-high");
  scene.pull("y-low", {0, 0, 0.5}).pull("z-high", {0, 0, 0.5}).probe("top", {0, 0, 10});
  parts.push_back(probed_part(scene.scene(), "1/2 across", 2,
                              {"quarter sphere: top.displacement.z", 0.0367599, "m", kCalculix, kNaN}));
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
    parts.push_back(
        probed_part(scene.scene(), fmt::format("{} along", bricks), 1,
                    {"bracket: tip.displacement.y (mm)", -6.511, "",
                     "finite elements (CalculiX C3D10, tests/references/parts.py)", missing_bend(bricks * 6 / 80.0)}));
  }
}

}  // namespace

std::vector<CutPart> thin_parts() {
  std::vector<CutPart> parts;
  add_plates(parts);
  add_beams(parts);
  add_rods(parts);
  add_shells(parts);
  add_macneal(parts);
  add_brackets(parts);
  return parts;
}

}  // namespace sprung
