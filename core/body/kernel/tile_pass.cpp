#include "core/body/kernel/tile_pass.h"

#include <algorithm>

#include "core/body/kernel/brick_run.h"
#include "core/body/kernel/node_runs.h"
#include "core/body/kernel/spring_runs.h"

#define SPRUNG_QUOTE(name) #name
#define SPRUNG_NAME_OF(name) SPRUNG_QUOTE(name)

namespace sprung::SPRUNG_INSTRUCTION_SET {

[[nodiscard]] SpringKernel spring_kernel();

namespace {

/// Goes through the planes of a tile from low to high z with two of them in the core's own cache: bricks follow once
/// both their planes are in; then the lower one is done.
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
        springs_(input.law, input.brick_size, input.beta) {}

  void run() {
    enter(0);
    for (int plane = 0; plane + 1 < tile_.planes; ++plane) {
      enter(plane + 1);
      fill_layer(plane);
      leave(plane);
    }
    leave(tile_.planes - 1);
  }

 private:
  template <class Visit>
  void each_run(int plane, RunKind kind, const Visit& visit) const {
    const int* first = tile_.first_run + plane * kRunKinds + kind;
    for (const Run* run = tile_.runs + first[0]; run != tile_.runs + first[1]; ++run) visit(*run);
  }

  /// Calls visit(place) for the packs of a kind of runs.
  template <class Visit>
  void each_pack(int plane, RunKind kind, const Visit& visit) const {
    each_run(plane, kind, [&](const Run& run) {
      for (int place = run.place; place < run.place + run.count; place += kLanes) visit(place);
    });
  }

  [[nodiscard]] Place plane(int index) const { return {scratch_ + (index & 1) * kPlaneSize}; }
  [[nodiscard]] Place next_row(int index) const { return {plane(index).values + tile_.pitch}; }

  /// With sums of nothing; what pulls at a run's first node from the node before it is kept one place lower.
  void enter(int index) {
    const Place to = plane(index);
    each_run(index, kPlaces, [&](const Run& run) {
      for (int axis = 0; axis < 3; ++axis) *to.at(kForceHigh + axis, run.place - 1) = 0;
    });
    each_run(index, kNodes, [&](const Run& run) { copy_in(to, run); });
    each_run(index, kSharedNodes, [&](const Run& run) { copy_in(to, run); });
    each_pack(index, kPlaces, [&](int place) {
      const Place here = to.seen_from(place);
      for (int array = 0; array < kSums; ++array) store(Pack(0.0), here.at(array));
      measure_edges<kDamped, 0>(edge_, {here, here});
      measure_edges<kDamped, 1>(edge_, {here, next_row(index).seen_from(place)});
    });
  }

  void copy_in(const Place& to, const Run& run) const {
    const std::ptrdiff_t first = 3 * static_cast<std::ptrdiff_t>(run.node);
    take_apart<kDamped>(input_.positions + first, input_.velocities + first, input_.drift, run.count,
                        three(to, kPosition, run.place), three(to, kVelocity, run.place));
  }

  static Three<double> three(const Place& from, int array, int place) {
    return {from.at(array, place), from.at(array + 1, place), from.at(array + 2, place)};
  }

  template <Shift kShift>
  void pull_diagonals_of(const Ends<kShift>& diagonals, const Run& run) {
    pull_diagonals<kDamped, kEnergy>(springs_.face, input_.law.face, diagonals, run, tile_.shares, energy_);
  }

  /// Both diagonals of faces along x.
  void pull_faces(const Place& low, const Place& high, const Run& run) {
    pull_diagonals_of(Ends<Shift::kTo>{low, high}, run);
    pull_diagonals_of(Ends<Shift::kFrom>{low, high}, run);
  }

  /// What lies between a plane and the next.
  void fill_layer(int index) {
    const Place low = plane(index);
    const Place high = plane(index + 1);
    each_pack(index, kPlaces, [&](int place) {
      measure_edges<kDamped, 2>(edge_, {low.seen_from(place), high.seen_from(place)});
    });
    each_run(index, kBricks, [&](const Run& run) {
      brick_run<kFaces, kInner, kBends, kAxes, kDamped, kEnergy>(springs_, {low, high, tile_.pitch}, run, tile_.shares,
                                                                 energy_);
    });
    if constexpr (kFaces) {
      each_run(index, kZxFaces, [&](const Run& run) { pull_faces(low, high, run); });
      each_run(index, kYzFaces, [&](const Run& run) {
        pull_diagonals_of(Ends<Shift::kNone>{low, next_row(index + 1)}, run);
        pull_diagonals_of(Ends<Shift::kNone>{next_row(index), high}, run);
      });
    }
  }

  void leave(int index) {
    const Place from = plane(index);
    if constexpr (kFaces) {
      each_run(index, kXyFaces, [&](const Run& run) { pull_faces(from, next_row(index), run); });
    }
    if constexpr (kEnergy) return;
    each_run(index, kNodes, [&](const Run& run) {
      const Three<double> forces = three(from, kForceLow, run.place);
      sum_forces(from, run, forces);
      finish_nodes(input_, run.node, run.count, {forces.x, forces.y, forces.z});
    });
    each_run(index, kSharedNodes, [&](const Run& run) {
      double* part = shared_ + run.first;
      sum_forces(from, run, {part, part + run.count, part + 2 * static_cast<std::ptrdiff_t>(run.count)});
    });
  }

  static void sum_forces(const Place& from, const Run& run, const Three<double>& to) {
    int axis = 0;
    for (double* sum : {to.x, to.y, to.z}) {
      const double* low = from.at(kForceLow + axis, run.place);
      const double* high = from.at(kForceHigh + axis, run.place - 1);
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
