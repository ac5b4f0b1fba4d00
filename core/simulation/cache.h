#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files.h"
#include "core/io/hdf5_file.h"
#include "core/simulation/recorder.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// The input of a run.
struct CacheHeader {
  std::string version;        // of the program
  std::string build;          // tells builds of the same version apart
  std::string scene;          // TOML, as resolved
  std::string progress_name;  // "time_s", "load", "mode"
  double position_error = 0;  // m: largest error of a node's coordinate in a frame; 0: every bit is kept
  double velocity_error = 0;  // m/s, likewise
  std::vector<std::string> probes;
  /// The bodies at rest, without what only their motion needs: laws, contacts, pins (except for the nodes they hold),
  /// loads and patches of bricks. Obstacles: as they are drawn.
  Simulation simulation;
};

/// The data of a frame besides the state of its nodes.
struct CachedFrame {
  double progress = 0;         // time (s), or fraction of the load, or number of the mode
  std::vector<double> probes;  // kNumbersOfProbe each, see kProbeQuantities
  std::uint64_t state_hash = 0;
  double seconds = 0;  // wall-clock time that it took
};

/// Writes a cache frame by frame; whenever the program is killed, all frames so far are readable. Where its header
/// allows errors, positions and velocities are rounded to multiples of a power of two, which compress well; the last
/// two frames are also kept exactly, for resuming.
class CacheWriter {
 public:
  /// Writes the constant data under a temporary name. The memory is the integrator's state besides positions and
  /// velocities, `memory_size` numbers. Throws Error(kFailed).
  CacheWriter(std::filesystem::path file, const CacheHeader& header, std::size_t memory_size);

  /// Positions and velocities by body (m x 3, m and m/s). Throws Error(kFailed) if the file cannot be written, was
  /// removed or replaced; frames appended before stay.
  void append(const CachedFrame& frame, const std::vector<const Points*>& positions,
              const std::vector<const Points*>& velocities, const std::vector<double>& memory);

  /// Gives the file its final name, replacing what had it; further frames are appended to it there.
  void publish();

  void close();

 private:
  FileLock lock_;  // until the file is complete or removed
  PartialFile file_;
  std::size_t frames_ = 0;
  double position_error_;
  double velocity_error_;
  Hdf5Writer hdf5_;
};

class CacheReader {
 public:
  /// Throws Error(kBadInput) if the file is not a cache, or one of another layout.
  explicit CacheReader(const std::filesystem::path& file);

  [[nodiscard]] const CacheHeader& header() const { return header_; }
  [[nodiscard]] std::size_t frame_count() const { return frame_count_; }

  [[nodiscard]] CachedFrame frame(std::size_t frame) const;
  /// By body, m x 3, m.
  [[nodiscard]] std::vector<Points> positions(std::size_t frame) const;
  /// By body, m x 3, m/s.
  [[nodiscard]] std::vector<Points> velocities(std::size_t frame) const;
  /// The exact values, for the last two frames only.
  [[nodiscard]] std::vector<Points> exact_positions(std::size_t frame) const;
  [[nodiscard]] std::vector<Points> exact_velocities(std::size_t frame) const;
  /// The integrator's memory after one of the last two frames.
  [[nodiscard]] std::vector<double> memory(std::size_t frame) const;

 private:
  [[nodiscard]] std::vector<Points> states(const char* name, std::size_t frame) const;
  [[nodiscard]] std::vector<Points> exact_states(std::size_t which, std::size_t frame) const;

  Hdf5Reader hdf5_;
  CacheHeader header_;
  std::size_t frame_count_ = 0;
};

/// Returns whether the file's name ends in .h5.
[[nodiscard]] bool is_cache_file(const std::filesystem::path& file);

}  // namespace sprung
