#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "core/body/kernel/pack.h"
#include "core/body/kernel/tile_kernel.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// A part of a run: its slots begin .. end - 1, counted from the run's first.
struct RunPart {
  const Run& run;
  int begin;
  int end;

  [[nodiscard]] int index() const { return run.index + begin; }
  [[nodiscard]] int count() const { return end - begin; }

  /// Calls visit(slot) for each pack.
  template <class Visit>
  void each_pack(const Visit& visit) const {
    for (int i = begin; i < end; i += kLanes) visit(run.index + i);
  }
};

/// Goes through the runs of one kind in a plane, up to one slot after the other.
class RunCursor {
 public:
  RunCursor(const TileView& tile, int plane, RunKind kind)
      : run_(tile.runs + tile.first_run[plane * kRunKinds + kind]),
        last_(tile.runs + tile.first_run[plane * kRunKinds + kind + 1]),
        unit_(kind < kSlots ? 1 : kPackPadding) {}

  /// Calls visit(part) for all nodes, or packs, that begin before this slot and were not visited yet.
  template <class Visit>
  void go_to(int index, const Visit& visit) {
    while (run_ != last_ && run_->index + done_ < index) {
      const int end = std::min(run_->count, (index - run_->index + unit_ - 1) & -unit_);
      visit(RunPart{*run_, done_, end});
      done_ = end;
      if (end < run_->count) return;
      ++run_;
      done_ = 0;
    }
  }

 private:
  const Run* run_;
  const Run* last_;
  int unit_;      // slots
  int done_ = 0;  // of the run's slots
};

/// Three components in arrays of their own.
template <class Number>
struct Three {
  Number* x;
  Number* y;
  Number* z;
};

/// Deinterleaves `count` points x y z x y z ..., with `drift` times their rates added; the rates as well if requested.
template <bool kRates>
void take_apart(const double* __restrict points, const double* __restrict rates, double drift, int count,
                const Three<double>& to, const Three<double>& rates_to) {
  double* __restrict x = to.x;
  double* __restrict y = to.y;
  double* __restrict z = to.z;
  double* __restrict u = rates_to.x;
  double* __restrict v = rates_to.y;
  double* __restrict w = rates_to.z;
  for (int i = 0; i < count; ++i) {
    x[i] = points[3 * i] + drift * rates[3 * i];
    y[i] = points[3 * i + 1] + drift * rates[3 * i + 1];
    z[i] = points[3 * i + 2] + drift * rates[3 * i + 2];
    if constexpr (kRates) {
      u[i] = rates[3 * i];
      v[i] = rates[3 * i + 1];
      w[i] = rates[3 * i + 2];
    }
  }
}

/// values += factor * rates
inline void add_rates(double* __restrict values, const double* __restrict rates, double factor, int count) {
  for (int i = 0; i < count; ++i) values[i] += factor * rates[i];
}

/// Adds the forces of gathered bricks on nodes.
inline void add_gathered_forces(const GatheredView& gathered, int node, int count, const Three<double>& forces) {
  if (gathered.first_force == nullptr) return;
  const int* first = gathered.first_force + node;
  for (int i = 0; i < count; ++i) {
    for (int entry = first[i]; entry < first[i + 1]; ++entry) {
      const double* force = gathered.forces + gathered.force_places[entry];
      forces.x[i] += force[0];
      forces.y[i] += force[kPackPadding];
      forces.z[i] += force[2 * kPackPadding];
    }
  }
}

/// Finishes nodes once their forces are known.
inline void finish_nodes(const KernelInput& input, int node, int count, const Three<const double>& forces) {
  const std::ptrdiff_t first = 3 * std::ptrdiff_t(node);
  const double* __restrict x = forces.x;
  const double* __restrict y = forces.y;
  const double* __restrict z = forces.z;
  if (input.task != KernelTask::kMove) {
    double* __restrict to = input.forces + first;
    for (int i = 0; i < count; ++i) {
      to[3 * i] = x[i];
      to[3 * i + 1] = y[i];
      to[3 * i + 2] = z[i];
    }
    return;
  }
  double* __restrict velocities = input.velocities + first;
  if (input.drift != 0) add_rates(input.positions + first, velocities, input.drift, 3 * count);
  const double* __restrict inverse_masses = input.inverse_masses + node;
  const double keep = input.keep;
  const double kick = input.kick;
  const std::array<double, 3> gravity = input.gravity_kick;
  for (int i = 0; i < count; ++i) {
    const double by_force = kick * inverse_masses[i];
    velocities[3 * i] = keep * velocities[3 * i] + by_force * x[i] + gravity[0];
    velocities[3 * i + 1] = keep * velocities[3 * i + 1] + by_force * y[i] + gravity[1];
    velocities[3 * i + 2] = keep * velocities[3 * i + 2] + by_force * z[i] + gravity[2];
  }
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
