#include <fmt/format.h>

#include <cmath>

#include "app/validate/cut_parts.h"
#include "app/validate/mapped_block.h"
#include "app/validate/table_scene.h"
#include "core/dynamics/statics/modes.h"
#include "core/simulation/simulation.h"

namespace sprung {
namespace {

/// The body of a scene, its bricks turned about z and, by 0.6 of that, about y.
Body turned_body(Scene scene, double degrees, Model model) {
  scene.bodies[0].model = model;
  scene.bodies[0].brick_rotation = Vec3(0, 0.6 * degrees, degrees);
  const Observer silent;
  return prepare_simulation(scene, silent).world.bodies.at(0);
}

struct FreeVibration {
  double bending = kNaN;  // Hz, of the mode most like the first bending along x
  int spurious = 0;       // modes far below what it should be
};

FreeVibration free_vibration(const Body& body, double length, double expected) {
  constexpr int kModes = 24;
  constexpr double kFarBelow = 0.75;  // no mode of the body itself is so wrong
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
    found.spurious += modes.frequencies[mode] < kFarBelow * expected ? 1 : 0;
  }
  return found;
}

/// Free of all supports, so that no clamp obscures the comparison with theory.
void add_free(std::vector<CutPart>& parts) {
  struct Free {
    std::string name;
    Vec3 sides;
    double brick;
    std::string bricks;
    double expected;  // Hz
  };
  // Of whole bricks of springs calibrated in bending and torsion too, 12 across the beam and 8 across the plate.
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
                        {name + ": modes far below it", 0, "", "bending is the slowest vibration", 0.5}},
                       [=](Model model) {
                         const FreeVibration found =
                             free_vibration(turned_body(scene, degrees, model), free.sides.x(), free.expected);
                         return std::vector{found.bending, double(found.spurious)};
                       }});
    }
  }
}

/// The plate held by the skin of one end, its bricks turned.
void add_clamped_plates(std::vector<CutPart>& parts) {
  for (const double brick : {1.0, 0.5}) {
    for (const double degrees : {0.0, 15.0, 30.0, 45.0}) {
      TableScene plate(block_mesh({10, 4, 0.5}), brick, 1000, 0.3);
      plate.hold_surface("x-low").pull("x-high", {0, 0, 1}).probe("tip", {10, 2, 0.25});
      Scene scene = plate.scene();
      scene.bodies[0].brick_rotation = Vec3(0, 0.6 * degrees, degrees);
      parts.push_back(probed_part(scene, brick == 1 ? "1/2 across" : "1 across", 2,
                                  {fmt::format("clamped plate turned by {} degrees: tip.displacement.z", degrees),
                                   7.77316, "m", kCalculix, kNaN}));
    }
  }
}

}  // namespace

std::vector<CutPart> turned_parts() {
  std::vector<CutPart> parts;
  add_free(parts);
  add_clamped_plates(parts);
  return parts;
}

}  // namespace sprung
