#include "core/body/kernel/tile_pass.h"

#include <algorithm>
#include <cstring>

#include "core/body/kernel/brick_run.h"
#include "core/body/kernel/node_runs.h"
#include "core/body/kernel/spring_runs.h"

#define SPRUNG_QUOTE(name) #name
#define SPRUNG_NAME_OF(name) SPRUNG_QUOTE(name)

namespace sprung::SPRUNG_INSTRUCTION_SET {

[[nodiscard]] SpringKernel spring_kernel();

namespace {

/// Goes through the planes of a tile from low to high z and through their rows from low to high y, with two planes of
/// nodes in the core's own cache and four rows in its nearest one. Bricks follow once the last of their four rows is
/// in; then the first of them is done.
template <bool kFaces, bool kInner, bool kBends, bool kAxes, bool kDamped, bool kEnergy>
class Walk {
 public:
  Walk(const TileView& tile, const PassInput& input, double* scratch, double* shared, Energy& energy)
      : tile_(tile),
        input_(input),
        scratch_(scratch),
        shared_(shared),
        energy_(energy),
        edge_(input.brick_size * input.brick_size, input.beta),
        springs_(input.law, input.brick_size, input.beta),
        edge_shares_(input.law.edge != 0 ? tile.shares : nullptr) {}

  void run() {
    for (int y = 0; y < tile_.rows; ++y) enter_row(0, y);
    for (int plane = 0; plane + 1 < tile_.planes; ++plane) {
      for (int y = 0; y < tile_.rows; ++y) {
        enter_row(plane + 1, y);
        each_run(plane, y, kZEdges, [&](const Run& run) { measure<2>(plane, y, run); });
        if (y == 0) continue;
        layer_row(plane, y - 1);
        leave_row(plane, y - 1);
      }
      layer_row(plane, tile_.rows - 1);
      leave_row(plane, tile_.rows - 1);
    }
    for (int y = 0; y < tile_.rows; ++y) leave_row(tile_.planes - 1, y);
  }

 private:
  template <class Visit>
  void each_run(int plane, int y, RunKind kind, const Visit& visit) const {
    const int* first = tile_.first_run + (plane * tile_.rows + y) * kRunKinds + kind;
    for (const Run* run = tile_.runs + first[0]; run != tile_.runs + first[1]; ++run) visit(*run);
  }

  [[nodiscard]] Row row(int plane, int y) const { return {scratch_ + ((plane & 1) * tile_.rows + y) * kRowSize}; }

  template <int kAxis>
  [[nodiscard]] EdgeEnds<kAxis> edges(int plane, int y) const {
    return {row(plane, y), row(kAxis == 2 ? plane + 1 : plane, kAxis == 1 ? y + 1 : y)};
  }

  void enter_row(int plane, int y) {
    const Row to = row(plane, y);
    const auto clear = [&](const Run& run) {
      for (int array = 0; array < kSums; ++array) {
        std::memset(to.at(array, run.x - 1), 0, static_cast<std::size_t>(run.count + kRunPadding + 1) * sizeof(double));
      }
    };
    each_run(plane, y, kNodes, clear);
    each_run(plane, y, kSharedNodes, clear);
    each_run(plane, y, kNodes, [&](const Run& run) { copy_in(to, run); });
    each_run(plane, y, kSharedNodes, [&](const Run& run) { copy_in(to, run); });
    each_run(plane, y, kXEdges, [&](const Run& run) { measure<0>(plane, y, run); });
    if (y > 0) each_run(plane, y - 1, kYEdges, [&](const Run& run) { measure<1>(plane, y - 1, run); });
  }

  void copy_in(const Row& to, const Run& run) const {
    const std::ptrdiff_t first = 3 * static_cast<std::ptrdiff_t>(run.node);
    take_apart(input_.positions + first, run.count, three(to, kPosition, run.x));
    take_apart(input_.velocities + first, run.count, three(to, kVelocity, run.x));
    if (input_.drift == 0) return;
    for (int axis = 0; axis < 3; ++axis) {
      add_rates(to.at(kPosition + axis, run.x), to.at(kVelocity + axis, run.x), input_.drift, run.count);
    }
  }

  static Three<double> three(const Row& row, int array, int x) {
    return {row.at(array, x), row.at(array + 1, x), row.at(array + 2, x)};
  }

  template <int kAxis>
  void measure(int plane, int y, const Run& run) const {
    measure_edges<kDamped, kAxis>(edge_, edges<kAxis>(plane, y), run);
  }

  template <int kAxis>
  void pull(int plane, int y, const Run& run) {
    pull_edges<kEnergy, kAxis>(input_.law.edge, springs_.size_squared, edges<kAxis>(plane, y), run, edge_shares_,
                               energy_);
  }

  template <Shift kShift>
  void pull_diagonals_of(const Ends<kShift>& diagonals, const Run& run) {
    pull_diagonals<kDamped, kEnergy>(springs_.face, input_.law.face, diagonals, run, tile_.shares, energy_);
  }

  /// Both diagonals of faces along x.
  void pull_faces(const Row& low, const Row& high, const Run& run) {
    pull_diagonals_of(Ends<Shift::kTo>{low, high}, run);
    pull_diagonals_of(Ends<Shift::kFrom>{low, high}, run);
  }

  /// What lies between a row and those above it in the next plane.
  void layer_row(int plane, int y) {
    const int up = plane + 1;
    each_run(plane, y, kBricks, [&](const Run& run) {
      brick_run<kFaces, kInner, kBends, kAxes, kDamped, kEnergy>(springs_, {row(plane, y), row(up, y)}, run,
                                                                 tile_.shares, energy_);
    });
    if constexpr (kFaces) {
      each_run(plane, y, kZxFaces, [&](const Run& run) { pull_faces(row(plane, y), row(up, y), run); });
      each_run(plane, y, kYzFaces, [&](const Run& run) {
        pull_diagonals_of(Ends<Shift::kNone>{row(plane, y), row(up, y + 1)}, run);
        pull_diagonals_of(Ends<Shift::kNone>{row(plane, y + 1), row(up, y)}, run);
      });
    }
    each_run(plane, y, kZEdges, [&](const Run& run) { pull<2>(plane, y, run); });
  }

  void leave_row(int plane, int y) {
    const Row from = row(plane, y);
    if constexpr (kFaces) {
      each_run(plane, y, kXyFaces, [&](const Run& run) { pull_faces(from, row(plane, y + 1), run); });
    }
    each_run(plane, y, kXEdges, [&](const Run& run) { pull<0>(plane, y, run); });
    each_run(plane, y, kYEdges, [&](const Run& run) { pull<1>(plane, y, run); });
    if constexpr (kEnergy) return;
    each_run(plane, y, kNodes, [&](const Run& run) {
      const Three<double> forces = three(from, kForceLow, run.x);
      sum_forces(from, run, forces);
      finish_nodes(input_, run.node, run.count, {forces.x, forces.y, forces.z});
    });
    each_run(plane, y, kSharedNodes, [&](const Run& run) {
      double* part = shared_ + run.first;
      sum_forces(from, run, {part, part + run.count, part + 2 * static_cast<std::ptrdiff_t>(run.count)});
    });
  }

  static void sum_forces(const Row& from, const Run& run, const Three<double>& to) {
    int axis = 0;
    for (double* sum : {to.x, to.y, to.z}) {
      const double* low = from.at(kForceLow + axis, run.x);
      const double* high = from.at(kForceHigh + axis, run.x - 1);
      for (int i = 0; i < run.count; ++i) sum[i] = low[i] + high[i];
      ++axis;
    }
  }

  const TileView& tile_;
  const PassInput& input_;
  double* scratch_;
  double* shared_;
  Energy& energy_;
  Kind edge_;
  BrickSprings springs_;
  const double* edge_shares_;
};

template <bool kFaces, bool kInner, bool kBends, bool kAxes>
void walk(const TileView& tile, const PassInput& input, double* scratch, double* shared, Energy& energy) {
  if (input.pass == Pass::kEnergy) {
    Walk<kFaces, kInner, kBends, kAxes, false, true>(tile, input, scratch, shared, energy).run();
  } else if (input.beta > 0) {
    Walk<kFaces, kInner, kBends, kAxes, true, false>(tile, input, scratch, shared, energy).run();
  } else {
    Walk<kFaces, kInner, kBends, kAxes, false, false>(tile, input, scratch, shared, energy).run();
  }
}

/// One walk for each layout of springs; the law's zeros tell them apart.
void run_tile(const TileView& tile, const PassInput& input, double* scratch, double* shared, Energy& energy) {
  const BrickLaw& law = input.law;
  const bool bends = law.bending_self != 0 || law.bending_cross != 0;
  if (law.axes != 0) return walk<true, true, true, true>(tile, input, scratch, shared, energy);
  if (law.face == 0 && !bends) return walk<false, true, false, false>(tile, input, scratch, shared, energy);
  if (law.inner == 0 && !bends) return walk<true, false, false, false>(tile, input, scratch, shared, energy);
  walk<true, true, true, false>(tile, input, scratch, shared, energy);
}

constexpr int kSharedAtOnce = 64;

void finish_shared(const SharedNodes& nodes, const SharedPart* parts, const double* shared, const PassInput& input) {
  for (int done = 0; done < nodes.count; done += kSharedAtOnce) {
    const int first = nodes.node + done;
    const int last = first + std::min(kSharedAtOnce, nodes.count - done);
    std::array<std::array<double, kSharedAtOnce>, 3> sums{};
    for (std::size_t i = nodes.first_part; i < nodes.last_part; ++i) {
      const SharedPart& part = parts[i];
      const int begin = std::max(first, part.node);
      const int end = std::min(last, part.node + part.count);
      for (std::size_t axis = 0; begin < end && axis < 3; ++axis) {
        const double* from = shared + part.offset + axis * static_cast<std::size_t>(part.count) + (begin - part.node);
        add_rates(&sums[axis][static_cast<std::size_t>(begin - first)], from, 1, end - begin);
      }
    }
    finish_nodes(input, first, last - first, {sums[0].data(), sums[1].data(), sums[2].data()});
  }
}

}  // namespace

SpringKernel spring_kernel() {
  return {.name = SPRUNG_NAME_OF(SPRUNG_INSTRUCTION_SET), .tile = run_tile, .shared = finish_shared};
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
