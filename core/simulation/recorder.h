#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/contact/pairs/guard_counts.h"
#include "core/dynamics/integrator_state.h"
#include "core/simulation/crossings.h"
#include "core/simulation/probe_sample.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// One probe in all frames.
struct ProbeTrack {
  std::string name;
  ProbeKind kind = ProbeKind::kPoint;
  std::vector<ProbeSample> samples;  // frame by frame
};

class RunCache;

/// The results of a run.
struct Recording {
  std::vector<std::vector<Floats3>> frames;  // [frame][body], nodes x 3, m; floats suffice for drawing;
                                             // none if a cache has them
  std::vector<double> progress;              // of every frame: time (s), or fraction of the load, or number of the mode
  std::vector<double> seconds;               // likewise: wall-clock time that it took
  std::string progress_name;                 // "time_s", "load", "mode"
  std::vector<ProbeTrack> probes;
  Eigen::VectorXd frequencies;       // Hz, of modes
  std::vector<Crossings> crossings;  // of the frames of a motion that this run computed, but the first
  GuardCounts guard;                 // of the explicit steps that this run computed
  double brick_steps = 0;            // of those steps, each counting the bricks that took it
  int inverted_bricks = 0;           // in the last frame of a motion
  std::uint64_t state_hash = 0;      // of the last frame's node positions and velocities
};

/// Records the frames of a simulation.
class Recorder {
 public:
  /// Frames go to the cache if there is one. Throws Error(kBadInput) if a probe's point is in no brick or its part has
  /// none.
  Recorder(const Scene& scene, const Simulation& simulation, std::string progress_name, RunCache* cache);

  /// Resumes from the frames in the cache: sets the world, that of the simulation, to its state after the last of them
  /// and restores the integrator by `serialize`. Returns their number. Call before the first add().
  int resume_from_cache(World& world, const std::function<void(IntegratorState&)>& serialize);

  /// Records the current state. `reactions`: of the pins' nodes by body (m x 3, N); none: no forces. `time`: of the
  /// film (s), for the pins' movements; with `small`, displacements are small: torques
  /// refer to the rest shape, stresses to small strains.
  void add(double progress, const std::vector<Points>& reactions, double time, bool small,
           const IntegratorState& state = {});

  /// The recording, complete.
  [[nodiscard]] Recording finish();
  [[nodiscard]] Recording& recording() { return recording_; }

 private:
  struct PointSeat {
    std::size_t body = 0;
    Embedding embedding;
    Vec3 start = Vec3::Zero();
  };

  [[nodiscard]] PointSeat seat_of(const Probe& probe) const;
  [[nodiscard]] ProbeSample point_sample(const PointSeat& seat, bool small) const;
  [[nodiscard]] ProbeSample pin_sample(const Probe& probe, const std::vector<Points>& reactions, double time,
                                       bool small) const;

  void check_part(std::size_t probe) const;
  [[nodiscard]] ProbeSample part_sample(std::size_t probe, bool small) const;

  const Scene& scene_;
  const Simulation& simulation_;
  RunCache* cache_;
  std::vector<PointSeat> seats_;  // by probe; unused for pins
  Recording recording_;
  std::chrono::steady_clock::time_point frame_began_ = std::chrono::steady_clock::now();
};

/// A hash of the positions and velocities of all nodes (FNV-1a, 64 bits).
[[nodiscard]] std::uint64_t state_hash(const World& world);

}  // namespace sprung
