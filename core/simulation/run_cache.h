#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/dynamics/integrator_state.h"
#include "core/simulation/cache.h"
#include "core/simulation/recorder.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// The text of a scene, as stored in a cache.
struct SceneRecord {
  std::string text{};
  /// The first difference to the scene text of another cache, with both values; empty if its run can be resumed. None:
  /// scenes are not compared.
  std::function<std::string(const std::string& cached_text)> difference{};
};

/// "to the last bit", "to within 1e-05 m".
[[nodiscard]] std::string position_accuracy(const CacheHeader& header);

/// The simulation of a cache, for drawing and measuring; it cannot be advanced, since contacts, pins and damping are
/// not stored.
[[nodiscard]] Simulation cached_simulation(const CacheHeader& header, const Scene& scene);

/// Its frames and probe values. `scene`: its own.
[[nodiscard]] Recording cached_recording(const CacheReader& cache, const Scene& scene);

/// One frame of it, by body.
[[nodiscard]] std::vector<Floats3> cached_nodes(const CacheReader& cache, std::size_t frame);

/// Stores the frames of a run, and resumes from those of an earlier run of the same scene.
class RunCache {
 public:
  /// With `resume` the frames of an existing file are kept, else it is replaced. Positions are stored to within
  /// `position_error` (m), velocities to within that per frame; 0: exactly. Throws Error(kBadInput) if the file is not
  /// a cache, Error(kFailed) if another run is writing it.
  RunCache(std::filesystem::path file, SceneRecord record, bool resume, double position_error = 0);
  /// Frames stay in memory until the run has taken `patience` (s); one that ends before that leaves no file. The file's
  /// folder is made with it.
  void wait_for(double patience) { patience_ = patience; }
  ~RunCache();

  /// Prepares for the frames of a run and returns the number of existing ones. Both must outlive this. Throws
  /// Error(kBadInput) naming the difference if those are of another run, Error(kFailed).
  int begin(const Scene& scene, const Simulation& simulation, const std::string& progress_name,
            std::size_t memory_size);

  /// An existing frame.
  [[nodiscard]] CachedFrame frame(int frame) const;
  /// Restores the nodes to the last existing frame; returns the integrator's state.
  [[nodiscard]] IntegratorState restore(World& world) const;

  /// Appends the current state as the next frame. Throws Error(kFailed); existing frames stay readable.
  void add(const CachedFrame& frame, const IntegratorState& state);

  /// The nodes in all frames, by body, from memory or from the file, which is closed.
  [[nodiscard]] std::vector<std::vector<Floats3>> take_frames();

  /// Closes the file.
  void close();

  /// Returns whether there is a file.
  [[nodiscard]] bool has_file() const { return writer_ != nullptr; }

  [[nodiscard]] int frame_count() const { return frame_count_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  /// A frame that is not in the file yet.
  struct Waiting {
    CachedFrame frame;
    std::vector<Points> positions;  // by body
    std::vector<Points> velocities;
    std::vector<double> memory;
  };

  void open();
  void append(const Waiting& frame);
  void copy_old_frames();

  std::filesystem::path file_;
  SceneRecord record_;
  double position_error_;
  std::unique_ptr<CacheReader> old_;  // of an earlier run
  std::unique_ptr<CacheWriter> writer_;
  std::optional<double> patience_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  CacheHeader header_;
  std::size_t memory_size_ = 0;
  std::vector<Waiting> waiting_;
  const Simulation* simulation_ = nullptr;
  int frame_count_ = 0;
};

/// The probe values of the last frame as stored in a cache, and the inverse.
[[nodiscard]] std::vector<double> numbers_of(const std::vector<ProbeTrack>& probes);
[[nodiscard]] ProbeSample sample_of(const CachedFrame& frame, std::size_t probe);

}  // namespace sprung
