#pragma once
#include <array>

#include "core/body/kernel/tile.h"
#include "core/law/brick_law.h"

namespace sprung {

enum class Pass {
  kForces,   // writes the springs' forces, N
  kDamping,  // writes what of them is damping, N
  kEnergy,   // adds up their energy, J
  kMove      // positions += drift * velocities, then velocities += kick * (forces / mass + gravity - alpha velocities)
};

/// What a pass over a body's tiles reads and writes; arrays hold x y z a node.
struct PassInput {
  Pass pass = Pass::kForces;
  BrickLaw law;
  double brick_size = 0;                   // m
  double beta = 0;                         // s
  double* positions = nullptr;             // m; written by kMove only
  double* velocities = nullptr;            // m/s; written by kMove only
  double* forces = nullptr;                // N; kForces and kDamping
  const double* inverse_masses = nullptr;  // a node, 1/kg; kMove
  double drift = 0;                        // s; kMove
  double kick = 0;                         // s; kMove
  double keep = 1;                         // 1 - kick * alpha
  std::array<double, 3> gravity_kick{};    // kick * gravity, m/s
};

/// Sums of energy, J: always the same bricks' in the same place.
using EnergyLanes = std::array<double, kPackPadding>;

/// Computes all springs of a tile. Nodes of its own are then done with; what it adds to the forces on shared nodes goes
/// to `shared`. `scratch` holds kScratchSize finite numbers. The energy is added lane by lane.
using TilePass = void (*)(const TileView& tile, const PassInput& input, double* scratch, double* shared,
                          EnergyLanes& energy);

/// Sums the parts of the forces on shared nodes and does the rest for them.
using SharedPass = void (*)(const SharedNodes& nodes, const SharedPart* parts, const double* shared,
                            const PassInput& input);

/// The innermost loops, compiled for one instruction set; null where the processor cannot run them.
struct SpringKernel {
  const char* name = "";
  TilePass tile = nullptr;
  SharedPass shared = nullptr;
};

/// The one for the widest vectors this processor has. All give the same bits.
[[nodiscard]] const SpringKernel& best_spring_kernel();
[[nodiscard]] const std::array<SpringKernel, 3>& all_spring_kernels();

}  // namespace sprung
