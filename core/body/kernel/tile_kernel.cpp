#include "core/body/kernel/tile_kernel.h"

#include <algorithm>

#include "core/body/kernel/brick_springs.h"
#include "core/body/kernel/solid_matrices.h"
#include "core/body/kernel/solid_rows.h"
#include "core/body/kernel/tile_runs.h"

#define SPRUNG_QUOTE(name) #name
#define SPRUNG_NAME_OF(name) SPRUNG_QUOTE(name)

namespace sprung::SPRUNG_INSTRUCTION_SET {

[[nodiscard]] SpringKernel spring_kernel();

namespace {

/// How many nodes are copied in at a time, so that later stages find them in the L1 cache.
constexpr int kStride = 96;  // slots

/// Packs that begin before this have their neighbours, a row and a slot further on, before `index`.
int before_neighbours(int index, int pitch) { return index - pitch - kPackPadding; }

/// Sweeps a tile from low to high z with two planes of nodes in the scratch. Within a plane, edges are measured once
/// their nodes are loaded, bricks follow once their edges are measured, and the nodes below are finished once all their
/// bricks are. Solid bricks have no edges of their own.
template <Layout kLayout, Part kPart>
class Walk {
 public:
  Walk(const TileView& tile, const KernelInput& input, double* scratch, double* shared, Energy& energy)
      : tile_(tile),
        input_(input),
        scratch_(scratch),
        shared_(shared),
        energy_(energy),
        edge_(input.brick_size * input.brick_size, input.beta),
        springs_(input.law, input.brick_size, input.beta) {}

  void run() {
    Entry first(tile_, 0);
    enter(first, end_of(0), end_of(0));
    for (int plane = 0; plane + 1 < tile_.planes; ++plane) go_through_layer(plane);
    Exit last(tile_, tile_.planes - 1);
    leave<false>(last, end_of(tile_.planes - 1) + kPackPadding);
  }

 private:
  /// How far a plane's nodes and edges have been loaded.
  struct Entry {
    int plane;
    RunCursor nodes;
    RunCursor sums;
    RunCursor edges;

    Entry(const TileView& tile, int index)
        : plane(index), nodes(tile, index, kNodes), sums(tile, index, kSlots), edges(tile, index, kSlots) {}
  };

  /// How far the bricks between a plane and the next have been computed.
  struct Layer {
    int plane;
    RunCursor edges;
    RunCursor bricks;
    RunCursor zx_faces;
    RunCursor yz_faces;

    Layer(const TileView& tile, int index)
        : plane(index),
          edges(tile, index, kSlots),
          bricks(tile, index, kBricks),
          zx_faces(tile, index, kZxFaces),
          yz_faces(tile, index, kYzFaces) {}
  };

  /// How far a plane is finished.
  struct Exit {
    int plane;
    RunCursor faces;
    RunCursor edges;
    RunCursor nodes;
    RunCursor shared_nodes;

    Exit(const TileView& tile, int index)
        : plane(index),
          faces(tile, index, kXyFaces),
          edges(tile, index, kSlots),
          nodes(tile, index, kOwnNodes),
          shared_nodes(tile, index, kSharedNodes) {}
  };

  [[nodiscard]] PlaneView plane(int index) const { return {scratch_ + (index & 1) * kPlaneSize}; }
  [[nodiscard]] PlaneView next_row(int index) const { return {plane(index).values + tile_.pitch}; }

  /// Behind the last slot of a plane.
  [[nodiscard]] int end_of(int index) const {
    const Run& last = tile_.runs[tile_.first_run[index * kRunKinds + kSlots + 1] - 1];
    return last.index + last.count;
  }

  template <class Visit>
  static void each_pack(RunCursor& runs, int to, const Visit& visit) {
    runs.go_to(to, [&](const RunPart& part) { part.each_pack(visit); });
  }

  void go_through_layer(int index) {
    Entry above(tile_, index + 1);
    Layer layer(tile_, index);
    Exit below(tile_, index);
    const int end = std::max(end_of(index), end_of(index + 1));
    for (int entered = kStride, done = 0; done < end + kPackPadding; entered += kStride) {
      const int measured = before_neighbours(entered, tile_.pitch);
      done = before_neighbours(measured, tile_.pitch);
      enter(above, entered, measured);
      fill(layer, measured, done);
      leave<true>(below, done);
    }
  }

  /// With zeroed sums; contributions to a run's first node from the node before it are stored one slot lower.
  void enter(Entry& entry, int nodes_to, int edges_to) {
    const PlaneView to = plane(entry.plane);
    entry.sums.go_to(nodes_to, [&](const RunPart& part) {
      if (part.begin == 0) {
        for (int array = kForceHigh; array < kSums; ++array) *to.at(array, part.index() - 1) = 0;
      }
      part.each_pack([&](int slot) {
        const PlaneView here = to.seen_from(slot);
        for (int array = 0; array < kSums; ++array) store(Pack(0.0), here.at(array));
      });
    });
    entry.nodes.go_to(nodes_to, [&](const RunPart& part) { copy_in(to, part); });
    if constexpr (kLayout.solid) return;
    each_pack(entry.edges, edges_to, [&](int slot) {
      const PlaneView here = to.seen_from(slot);
      measure_edges<kPart, 0>(edge_, {here, here});
      measure_edges<kPart, 1>(edge_, {here, next_row(entry.plane).seen_from(slot)});
    });
  }

  void copy_in(const PlaneView& to, const RunPart& part) const {
    const std::ptrdiff_t first = 3 * std::ptrdiff_t(part.run.node + part.begin);
    take_apart<reads_velocities(kPart)>(input_.positions + first, input_.velocities + first, input_.drift, part.count(),
                                        three(to, kPosition, part.index()), three(to, kVelocity, part.index()));
  }

  static Three<double> three(const PlaneView& from, int array, int slot) {
    return {from.at(array, slot), from.at(array + 1, slot), from.at(array + 2, slot)};
  }

  template <Shift kShift>
  void pull_diagonals_of(const Ends<kShift>& diagonals, const RunPart& part) {
    pull_diagonals<kPart>(springs_.face, input_.law.face, diagonals, part, tile_.shares, energy_);
  }

  /// Both face diagonals along x.
  void pull_faces(const PlaneView& low, const PlaneView& high, const RunPart& part) {
    pull_diagonals_of(Ends<Shift::kTo>{low, high}, part);
    pull_diagonals_of(Ends<Shift::kFrom>{low, high}, part);
  }

  /// What lies between a plane and the next.
  void fill(Layer& layer, int edges_to, int bricks_to) {
    const PlaneView low = plane(layer.plane);
    const PlaneView high = plane(layer.plane + 1);
    if constexpr (kLayout.solid) {
      layer.bricks.go_to(bricks_to, [&](const RunPart& part) {
        solid_run<kPart>(input_.solid, input_.beta, {low, high, tile_.pitch}, part, tile_, energy_);
      });
      return;
    }
    each_pack(layer.edges, edges_to, [&](int slot) {
      measure_edges<kPart, 2>(edge_, {low.seen_from(slot), high.seen_from(slot)});
    });
    layer.bricks.go_to(bricks_to, [&](const RunPart& part) {
      brick_run<kLayout, kPart>(springs_, {low, high, tile_.pitch}, part, tile_, energy_);
    });
    if constexpr (kLayout.faces) {
      layer.zx_faces.go_to(bricks_to, [&](const RunPart& part) { pull_faces(low, high, part); });
      layer.yz_faces.go_to(bricks_to, [&](const RunPart& part) {
        pull_diagonals_of(Ends<Shift::kNone>{low, next_row(layer.plane + 1)}, part);
        pull_diagonals_of(Ends<Shift::kNone>{next_row(layer.plane), high}, part);
      });
    }
  }

  /// Bricks before `to` are done.
  template <bool kHasLayer>
  void leave(Exit& exit, int to) {
    const PlaneView from = plane(exit.plane);
    if constexpr (kLayout.faces) {
      exit.faces.go_to(to, [&](const RunPart& part) { pull_faces(from, next_row(exit.plane), part); });
    }
    if constexpr (kPart == Part::kEnergy) return;
    const int whole = to - kPackPadding + 1;  // packs that begin before this end before `to`
    exit.edges.go_to(whole, [&](const RunPart& part) { pull_edges_of<kHasLayer>(exit.plane, part); });
    exit.nodes.go_to(whole, [&](const RunPart& part) {
      const Three<double> forces = three(from, kForceLow, part.index());
      const int node = part.run.node + part.begin;
      add_gathered_forces(input_.gathered, node, part.count(), forces);
      finish_nodes(input_, node, part.count(), {forces.x, forces.y, forces.z});
    });
    exit.shared_nodes.go_to(whole, [&](const RunPart& part) {
      double* sums = shared_ + part.run.first + part.begin;
      const std::ptrdiff_t count = part.run.count;
      const Three<double> forces = three(from, kForceLow, part.index());
      std::copy_n(forces.x, part.count(), sums);
      std::copy_n(forces.y, part.count(), sums + count);
      std::copy_n(forces.z, part.count(), sums + 2 * count);
    });
  }

  /// Sums of nodes are then complete.
  template <bool kHasLayer>
  void pull_edges_of(int index, const RunPart& part) const {
    const PlaneView from = plane(index);
    if constexpr (!kLayout.solid) {
      part.each_pack([&](int slot) {
        pull_edges<kHasLayer>(from.seen_from(slot), next_row(index).seen_from(slot), plane(index + 1).seen_from(slot));
      });
    }
    part.each_pack([&](int slot) {
      const PlaneView here = from.seen_from(slot);
      here.set_three(kForceLow, here.three(kForceLow) + here.three(kForceHigh, -1));
    });
  }

  const TileView& tile_;
  const KernelInput& input_;
  double* scratch_;
  double* shared_;
  Energy& energy_;
  SpringType edge_;
  BrickSprings springs_;
};

/// Calls visit(part) with the part of the law, a constant, that a task needs.
template <class Visit>
void with_part_of(const KernelInput& input, const Visit& visit) {
  const auto with = [&]<Part kPart>() { visit(std::integral_constant<Part, kPart>()); };
  if (input.task == KernelTask::kEnergy) return with.template operator()<Part::kEnergy>();
  if (input.task == KernelTask::kProduct) return with.template operator()<Part::kProduct>();
  if (input.task == KernelTask::kDamping) return with.template operator()<Part::kDamping>();
  if (input.beta > 0) return with.template operator()<Part::kElasticAndDamping>();
  with.template operator()<Part::kElastic>();
}

template <Layout kLayout>
void walk(const TileView& tile, const KernelInput& input, double* scratch, double* shared, Energy& energy) {
  with_part_of(input, [&](auto part) {
    if constexpr (kLayout.solid || part != Part::kProduct) {
      Walk<kLayout, part>(tile, input, scratch, shared, energy).run();
    }
  });
}

void run_gathered(const KernelInput& input, int pack, Energy& energy) {
  with_part_of(input, [&](auto part) { gathered_pack<part>(input, pack, energy); });
}

/// One kernel for solid bricks and for each layout of springs, which follows from the zeros of the law.
void run_tile(const TileView& tile, const KernelInput& input, double* scratch, double* shared, Energy& energy) {
  if (input.is_solid) return walk<Layout{.solid = true}>(tile, input, scratch, shared, energy);
  const BrickLaw& law = input.law;
  if (law.axes == 0) {
    if (law.face == 0) return walk<Layout{.edges = true, .inner = true}>(tile, input, scratch, shared, energy);
    return walk<Layout{.edges = true, .faces = true}>(tile, input, scratch, shared, energy);
  }
  walk<Layout{.edges = true, .faces = true, .inner = true, .axes = true}>(tile, input, scratch, shared, energy);
}

constexpr int kSharedAtOnce = 64;

void finish_shared(const SharedNodes& nodes, const SharedPart* parts, const double* shared, const KernelInput& input) {
  for (int done = 0; done < nodes.count; done += kSharedAtOnce) {
    const int first = nodes.node + done;
    const int last = first + std::min(kSharedAtOnce, nodes.count - done);
    std::array<std::array<double, kSharedAtOnce>, 3> sums;
    for (auto& sum : sums) std::fill_n(sum.begin(), last - first, 0.0);
    for (std::size_t i = nodes.first_part; i < nodes.last_part; ++i) {
      const SharedPart& part = parts[i];
      const int begin = std::max(first, part.node);
      const int end = std::min(last, part.node + part.count);
      for (std::size_t axis = 0; begin < end && axis < 3; ++axis) {
        const double* from = shared + part.offset + axis * std::size_t(part.count) + (begin - part.node);
        add_rates(&sums[axis][begin - first], from, 1, end - begin);
      }
    }
    add_gathered_forces(input.gathered, first, last - first, {sums[0].data(), sums[1].data(), sums[2].data()});
    finish_nodes(input, first, last - first, {sums[0].data(), sums[1].data(), sums[2].data()});
  }
}

}  // namespace

SpringKernel spring_kernel() {
  return {.name = SPRUNG_NAME_OF(SPRUNG_INSTRUCTION_SET),
          .tile = run_tile,
          .gathered = run_gathered,
          .shared = finish_shared,
          .solid_matrices = solid_matrices};
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
