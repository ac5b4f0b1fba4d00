#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/dynamics/integrator_state.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// What a probe saw in one frame: a point's place, or the mean place of a pin's nodes with the force that the pin
/// exerts on them and its torque about the middle of the pin's box.
struct ProbeSample {
  Vec3 position = Vec3::Zero();      // m
  Vec3 displacement = Vec3::Zero();  // m, from the start
  Vec3 force = Vec3::Zero();         // N; zero for points
  Vec3 torque = Vec3::Zero();        // N m; zero for points
};

/// One probe through all frames.
struct ProbeTrack {
  std::string name;
  bool is_pin = false;
  std::vector<ProbeSample> samples;  // frame by frame
};

class RunCache;

/// Everything that a scene gave.
struct Recording {
  std::vector<std::vector<Floats3>> frames;  // [frame][actor], nodes x 3, m; the picture needs no more than floats;
                                             // none where they are in a cache
  std::vector<double> progress;              // of every frame: time (s), or share of the load, or number of the mode
  std::vector<double> seconds;               // likewise: that it took, wall clock
  std::string progress_name;                 // "time_s", "load", "mode"
  std::vector<ProbeTrack> probes;
  Eigen::VectorXd frequencies;     // Hz, of modes
  double deepest_penetration = 0;  // m, of skins in what they touch, at the end of any frame moved through
  std::uint64_t state_hash = 0;    // of the last frame's node positions and velocities, every bit of them
};

/// Takes down frames as a simulation goes through them.
class Recorder {
 public:
  /// A cache, where there is one, gets the frames. Throws Error(kBadInput) where a probe's point is in no brick or its
  /// pin holds nothing.
  Recorder(const Scene& scene, const Simulation& simulation, std::string progress_name, RunCache* cache);

  /// Takes up the frames that the cache has: the world, that of the simulation, then stands as after the last of them,
  /// and `pass` has given the motion what it remembers. Returns how many they are. To be called before the first add().
  int take_up(World& world, const std::function<void(IntegratorState&)>& serialize);

  /// The simulation as it stands. `reactions` of the pins' nodes by actor (m x 3, N); none: no forces. `time` in the
  /// film (s), for the pins' movement; with `small`, torques are those of the shape at rest.
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
  [[nodiscard]] ProbeSample point_sample(const PointSeat& seat) const;
  [[nodiscard]] ProbeSample pin_sample(const Probe& probe, const std::vector<Points>& reactions, double time,
                                       bool small) const;

  const Scene& scene_;
  const Simulation& simulation_;
  RunCache* cache_;
  std::vector<PointSeat> seats_;  // by probe; unused for pins
  Recording recording_;
  std::chrono::steady_clock::time_point frame_began_ = std::chrono::steady_clock::now();
};

/// Every bit of the positions and velocities of all nodes (FNV-1a, 64 bits).
[[nodiscard]] std::uint64_t state_hash(const World& world);

}  // namespace sprung
