#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/dynamics/integrator_state.h"
#include "core/simulation/cache.h"
#include "core/simulation/recorder.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// A scene in words, as a cache keeps it.
struct SceneRecord {
  std::string text{};
  /// What a run of the scene in the words of another cache would do otherwise, with both values; empty: nothing, and
  /// its frames can be gone on with. None: scenes are not compared.
  std::function<std::string(const std::string& cached_text)> difference{};
};

/// "to the last bit", "to within 1e-05 m".
[[nodiscard]] std::string position_accuracy(const CacheHeader& header);

/// The simulation that a cache was made of, for what draws or measures it: nothing in it can be moved on, since
/// contacts, pins and damping are not in a cache.
[[nodiscard]] Simulation cached_simulation(const CacheHeader& header, const Scene& scene);

/// Its frames, and what the probes saw in them; which of those are of pins is not in a cache.
[[nodiscard]] Recording cached_recording(const CacheReader& cache);

/// One frame of it, by actor.
[[nodiscard]] std::vector<Floats3> cached_nodes(const CacheReader& cache, std::size_t frame);

/// Where a run keeps its frames as they come; and takes those up that an earlier run of the same scene has left there.
class RunCache {
 public:
  /// With `resume` what the file has is kept, if there is such a file; else it is replaced. Positions are kept to
  /// within `position_error` (m), velocities to within that in a frame; 0: to the last bit. Throws Error(kBadInput)
  /// where the file is no cache, Error(kFailed) where another run is writing it.
  RunCache(std::filesystem::path file, SceneRecord record, bool resume, double position_error = 0);
  ~RunCache();

  /// Makes ready for the frames of a run and returns how many are there. Both have to outlive this.
  /// Throws Error(kBadInput) naming the difference where those are of another run, Error(kFailed).
  int begin(const Scene& scene, const Simulation& simulation, const std::string& progress_name,
            std::size_t memory_size);

  /// A frame that is there.
  [[nodiscard]] CachedFrame frame(int frame) const;
  /// Brings the nodes to where they were after the last frame that is there; what the motion remembered.
  [[nodiscard]] IntegratorState restore(World& world) const;

  /// The next frame, as the world stands. Throws Error(kFailed); what is there stays readable.
  void add(const CachedFrame& frame, const IntegratorState& state);

  /// Nothing more will come.
  void close();

  [[nodiscard]] int frame_count() const { return frame_count_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  void copy_old_frames();

  std::filesystem::path file_;
  SceneRecord record_;
  double position_error_;
  std::unique_ptr<CacheReader> old_;  // what an earlier run left
  std::unique_ptr<CacheWriter> writer_;
  const Simulation* simulation_ = nullptr;
  int frame_count_ = 0;
};

/// The numbers of the probes in a frame, for a cache; and back.
[[nodiscard]] std::vector<double> numbers_of(const std::vector<ProbeTrack>& probes);
[[nodiscard]] ProbeSample sample_of(const CachedFrame& frame, std::size_t probe);

}  // namespace sprung
