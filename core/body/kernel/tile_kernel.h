#pragma once
#include <array>
#include <cstddef>

#include "core/law/brick_law.h"
#include "core/law/solid/hyperelastic_terms.h"

namespace sprung {

/// Slots side by side in a plane of a tile.
struct Run {
  int index;  // of the first
  int count;
  int first;  // of bricks: in `packs`; of faces: in `shares`; of shared nodes: in the shared forces
  int node;   // runs of nodes: the body's node that comes first; the others follow it
};

/// The kinds of runs of a plane of nodes. All but those of nodes are a multiple of kPackPadding long and may include
/// slots that are not theirs.
enum RunKind : int {
  kNodes,        // all
  kOwnNodes,     // no other tile contributes to them
  kSharedNodes,  // other tiles do
  kSlots,        // all that hold nodes
  kBricks,       // between this plane and the next
  kXyFaces,      // those that are no brick's low face: the body ends there
  kZxFaces,
  kYzFaces,
  kRunKinds
};

/// No vector of numbers that is computed at once is wider.
inline constexpr int kPackPadding = 8;

/// A box of lattice cells with some of a body's bricks; each brick is in one tile. Its planes of nodes are stored row
/// by row along x with `pitch` slots per row, so the neighbours of a slot in x, y and z are slot + 1, slot + pitch
/// and the same one in the next plane, and runs continue from row to row. Plain arrays, for code that is compiled once
/// for each instruction set.
///
/// `shares`: the stiffness of a run's bricks or faces in multiples of a full brick's, 0 at slots without one. Those of
/// bricks are stored in packs of kPackPadding slots: for springs their own shares, then those of their low xy, zx and
/// yz faces, the sum over a face's two bricks; for solid bricks see SolidNumber. `packs` holds the offset of each pack;
/// identical packs, as inside a body, are stored once. Those of faces are one list.
struct TileView {
  int pitch;
  int planes;  // of nodes
  const Run* runs;
  const int* first_run;  // of kind k in plane p: first_run[p * kRunKinds + k], up to the next
  const double* shares;
  const int* packs;
};

/// One tile's contribution to the forces on a run of nodes that other tiles contribute to as well: x, y and z of the
/// run one after the other.
struct SharedPart {
  int node;  // first
  int count;
  std::size_t offset;  // in the shared forces
};

/// Neighbouring shared nodes and the parts that cover them, in a fixed order; none cover nodes without a tile.
struct SharedNodes {
  int node;  // first
  int count;
  std::size_t first_part;
  std::size_t last_part;  // one past
};

/// A tile's planes of nodes in the scratch: kPlaneArrays arrays each, an odd number of cache lines long, since arrays
/// at power-of-two distances would compete for the same cache lines. There is no node before kFirstSlot.
inline constexpr int kFirstSlot = 8;
inline constexpr int kMaxSlots = 760;  // of a plane, with room for a pack, a row and a slot behind the last brick
inline constexpr int kArraySize = 776;
inline constexpr int kPlaneArrays = 23;
inline constexpr int kPlaneSize = kPlaneArrays * kArraySize;
static_assert(kArraySize % 16 == 8 && kArraySize >= kFirstSlot + kMaxSlots + kPackPadding);

/// Doubles of scratch for a tile.
inline constexpr int kScratchSize = 2 * kPlaneSize;

/// The law of solid bricks (SolidBrick): Young's modulus and Lame's constants in J, times h^3, and a whole brick's
/// stiffnesses against differences of its springs over E h^3: of a bend with itself and with the transverse bend of the
/// same plate, of a twist and of warping.
struct SolidLaw {
  double per_size = 0;  // 1 / h, 1/m
  double young = 0;
  double shear = 0;
  double lambda = 0;
  double bending = 0;
  double across = 0;
  double twist = 0;
  double warping = 0;
  HyperelasticTerms psi;  // in J, times h^3; kNeoHooke: by shear and lambda alone
};

/// The parameters of a pack of solid bricks if one of them is cut, kPackPadding each, preceded by -1; a pack of whole
/// bricks has only their shares. Tiles have whole bricks only, and gathered packs do not mix them.
enum SolidNumber : int {
  kSolidIsCut = 0,
  kSolidShare = 1,      // stiffness in multiples of the body's full brick, by material and fill
  kSolidCentroid = 2,   // x y z, in brick lengths from the middle
  kSolidStiffness = 5,  // of the nine gradients, over E h^3: the upper triangle row by row
  kSolidWarping = 50,   // of q, likewise
  kSolidTangent = 53,   // CurvedSolid's, row by row
  kSolidNumbers = 80
};

/// Solid bricks in packs of any kPackPadding of them, which gather their corners from the body's nodes: cut ones, and
/// rows too short for a tile. Their forces are stored corner by corner and summed node by node, in a fixed order.
struct GatheredView {
  const double* numbers = nullptr;   // see SolidNumber; slots without a brick have zeros
  const int* packs = nullptr;        // the offset of each pack's
  const int* corners = nullptr;      // of each pack: 8 * kPackPadding places of x in positions, corner by corner
  const int* first_force = nullptr;  // by node, into force_places; null: there are no such bricks
  const int* force_places = nullptr;
  double* forces = nullptr;  // kGatheredForces a pack; y and z of a force follow its x after kPackPadding each
};
inline constexpr int kGatheredForces = 24 * kPackPadding;

enum class KernelTask {
  kForces,   // writes the springs' forces, N
  kDamping,  // writes their damping part, N
  kProduct,  // writes the second derivative of the energy times the vector in place of velocities, N; solid bricks only
  kEnergy,   // adds up their energy, J
  kMove      // positions += drift * velocities, then velocities += kick * (forces / mass + gravity - alpha velocities)
};

/// Input and output of a task over a body's tiles; arrays hold x y z per node.
struct KernelInput {
  KernelTask task = KernelTask::kForces;
  BrickLaw law;
  bool is_solid = false;  // then bricks follow `solid`, not `law`
  SolidLaw solid;
  double brick_size = 0;                   // m
  double beta = 0;                         // s
  double* positions = nullptr;             // m; written by kMove only
  double* velocities = nullptr;            // m/s; written by kMove only
  double* forces = nullptr;                // N; kForces, kDamping and kProduct
  const double* inverse_masses = nullptr;  // per node, 1/kg; kMove
  double drift = 0;                        // s; kMove
  double kick = 0;                         // s; kMove
  double keep = 1;                         // 1 - kick * alpha
  std::array<double, 3> gravity_kick{};    // kick * gravity, m/s
  GatheredView gathered;                   // their forces are complete when the nodes are finished
};

/// Partial sums of energy, J: each lane always sums the same bricks.
using EnergyLanes = std::array<double, kPackPadding>;

/// Computes all springs of a tile. Its own nodes are then finished; its contributions to the forces on shared nodes go
/// to `shared`. `scratch` holds kScratchSize finite numbers. The energy is added lane by lane.
using TileKernel = void (*)(const TileView& tile, const KernelInput& input, double* scratch, double* shared,
                            EnergyLanes& energy);

/// Computes one pack of input.gathered. The energy is added lane by lane.
using GatheredKernel = void (*)(const KernelInput& input, int pack, EnergyLanes& energy);

/// Sums the contributions to the forces on shared nodes and finishes those nodes.
using SharedNodesKernel = void (*)(const SharedNodes& nodes, const SharedPart* parts, const double* shared,
                                   const KernelInput& input);

/// The second derivatives of the energy of kPackPadding solid bricks with respect to their corners 1 to 7, N/m: entry
/// anchored_index(a, b) of each side by side. `own`: their parameters, see TileView; `corners`: x y z of each corner,
/// m, those of all bricks side by side.
using SolidMatrices = void (*)(const SolidLaw& law, const double* own, const double* corners, double* matrices);

/// The innermost loops, compiled for one instruction set; null if the processor cannot run them.
struct SpringKernel {
  const char* name = "";
  TileKernel tile = nullptr;
  GatheredKernel gathered = nullptr;
  SharedNodesKernel shared = nullptr;
  SolidMatrices solid_matrices = nullptr;
};

/// The one for the widest vectors this processor has. All give the same bits.
[[nodiscard]] const SpringKernel& best_spring_kernel();
[[nodiscard]] const std::array<SpringKernel, 3>& all_spring_kernels();

}  // namespace sprung
