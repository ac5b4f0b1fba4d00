#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/dynamics/integrator_state.h"
#include "core/simulation/crossings.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// A probe's values in one frame: the position of a point and the stress there (see recover_stress()), or the mean
/// position of a pin's nodes, the force that the pin exerts on them and its torque about the centre of the pin's box.
struct ProbeSample {
  Vec3 position = Vec3::Zero();      // m
  Vec3 displacement = Vec3::Zero();  // m, from the start
  Vec3 force = Vec3::Zero();         // N; zero for points
  Vec3 torque = Vec3::Zero();        // N m; zero for points
  Vec3 stress = Vec3::Zero();        // xx, yy, zz, Pa; zero for pins
  Vec3 shear_stress = Vec3::Zero();  // xy, yz, zx, Pa; zero for pins
};

/// A quantity that probes measure.
struct ProbeQuantity {
  enum Kind { kAny, kPin, kPoint };

  std::string_view name;
  std::string_view unit;
  std::array<std::string_view, 3> components;
  Vec3 ProbeSample::*value;
  Kind kind = kAny;  // of probe, which measures it
  [[nodiscard]] bool is_of(bool pin) const { return kind == kAny || (kind == kPin) == pin; }
};

inline constexpr std::array<ProbeQuantity, 6> kProbeQuantities{
    {{"position", "m", {"x", "y", "z"}, &ProbeSample::position},
     {"displacement", "m", {"x", "y", "z"}, &ProbeSample::displacement},
     {"force", "N", {"x", "y", "z"}, &ProbeSample::force, ProbeQuantity::kPin},
     {"torque", "N m", {"x", "y", "z"}, &ProbeSample::torque, ProbeQuantity::kPin},
     {"stress", "Pa", {"xx", "yy", "zz"}, &ProbeSample::stress, ProbeQuantity::kPoint},
     {"shear_stress", "Pa", {"xy", "yz", "zx"}, &ProbeSample::shear_stress, ProbeQuantity::kPoint}}};

/// One probe in all frames.
struct ProbeTrack {
  std::string name;
  bool is_pin = false;
  std::vector<ProbeSample> samples;  // frame by frame
};

class RunCache;

/// The results of a run.
struct Recording {
  std::vector<std::vector<Floats3>> frames;  // [frame][actor], nodes x 3, m; floats suffice for drawing;
                                             // none where a cache has them
  std::vector<double> progress;              // of every frame: time (s), or fraction of the load, or number of the mode
  std::vector<double> seconds;               // likewise: wall-clock time that it took
  std::string progress_name;                 // "time_s", "load", "mode"
  std::vector<ProbeTrack> probes;
  Eigen::VectorXd frequencies;       // Hz, of modes
  std::vector<Crossings> crossings;  // of the frames of a motion that this run computed, but the first
  std::uint64_t state_hash = 0;      // of the last frame's node positions and velocities
};

/// Records the frames of a simulation.
class Recorder {
 public:
  /// Frames go to the cache if there is one. Throws Error(kBadInput) where a probe's point is in no brick or its pin
  /// holds no nodes.
  Recorder(const Scene& scene, const Simulation& simulation, std::string progress_name, RunCache* cache);

  /// Resumes from the frames in the cache: sets the world, that of the simulation, to its state after the last of them
  /// and restores the integrator by `serialize`. Returns their number. Call before the first add().
  int take_up(World& world, const std::function<void(IntegratorState&)>& serialize);

  /// Records the current state. `reactions`: of the pins' nodes by actor (m x 3, N); none: no forces. `time`: of the
  /// film (s), for the pins' movements; with `small`, displacements are small: torques
  /// refer to the rest shape, stresses to small strains.
  void add(double progress, const std::vector<Points>& reactions, double time, bool small,
           const IntegratorState& state = {});

  /// The recording, complete.
  [[nodiscard]] Recording finish();
  [[nodiscard]] Recording& recording() { return recording_; }

 private:
  struct PointSeat {
    std::size_t actor = 0;
    Embedding embedding;
    Vec3 start = Vec3::Zero();
  };

  [[nodiscard]] PointSeat seat_of(const Probe& probe) const;
  [[nodiscard]] ProbeSample point_sample(const PointSeat& seat, bool small) const;
  [[nodiscard]] ProbeSample pin_sample(const Probe& probe, const std::vector<Points>& reactions, double time,
                                       bool small) const;

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
