#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files.h"
#include "core/io/hdf5_file.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// What a run is made from.
struct CacheHeader {
  std::string version;        // of the program
  std::string build;          // which of all that have this version
  std::string scene;          // TOML, as resolved
  std::string progress_name;  // "time_s", "load", "mode"
  double position_error = 0;  // m: a node's coordinate may be that far off in a frame; 0: every bit is kept
  double velocity_error = 0;  // m/s, likewise
  std::vector<std::string> probes;
  /// What moves, as it is at rest and without what moving it takes: laws, contacts, pins (but for which nodes they
  /// hold), loads and patches of bricks. Obstacles: as they are drawn.
  Simulation simulation;
};

/// What a frame has beside the state of its nodes.
struct CachedFrame {
  double progress = 0;         // time (s), or share of the load, or number of the mode
  std::vector<double> probes;  // 12 each: position, displacement (m), force (N), torque (N m)
  std::uint64_t state_hash = 0;
  double seconds = 0;  // that it took, wall clock
};
inline constexpr std::size_t kNumbersOfProbe = 12;

/// A cache on its way: grows by a frame at a time, and is readable with all of them whenever the program is killed.
/// Where its header allows errors, positions and velocities are rounded to multiples of a power of two, whose zeros
/// compress; the last two frames are kept to the last bit as well, for a run that goes on.
class CacheWriter {
 public:
  /// Writes what does not change beside the file. The memory is what the motion carries from frame to frame beside
  /// positions and velocities, `memory_size` numbers. Throws Error(kFailed).
  CacheWriter(std::filesystem::path file, const CacheHeader& header, std::size_t memory_size);

  /// Positions and velocities by body (m x 3, m and m/s). Throws Error(kFailed) where it cannot be written, or the
  /// file is gone or no longer this one; what was appended before stays.
  void append(const CachedFrame& frame, const std::vector<const Points*>& positions,
              const std::vector<const Points*>& velocities, const std::vector<double>& memory);

  /// Gives the file its name, in place of what had it. From then on it is the one that grows.
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
  /// Throws Error(kBadInput) where the file is no cache, or one of another layout.
  explicit CacheReader(const std::filesystem::path& file);

  [[nodiscard]] const CacheHeader& header() const { return header_; }
  [[nodiscard]] std::size_t frame_count() const { return frame_count_; }

  [[nodiscard]] CachedFrame frame(std::size_t frame) const;
  /// By body, m x 3, m.
  [[nodiscard]] std::vector<Points> positions(std::size_t frame) const;
  /// By body, m x 3, m/s.
  [[nodiscard]] std::vector<Points> velocities(std::size_t frame) const;
  /// The same to the last bit, of the last or the last but one frame.
  [[nodiscard]] std::vector<Points> exact_positions(std::size_t frame) const;
  [[nodiscard]] std::vector<Points> exact_velocities(std::size_t frame) const;
  /// Of the motion after the last or the last but one frame.
  [[nodiscard]] std::vector<double> memory(std::size_t frame) const;

 private:
  [[nodiscard]] std::vector<Points> states(const char* name, std::size_t frame) const;
  [[nodiscard]] std::vector<Points> exact_states(std::size_t which, std::size_t frame) const;

  Hdf5Reader hdf5_;
  CacheHeader header_;
  std::size_t frame_count_ = 0;
};

/// True where the file's name ends in .h5.
[[nodiscard]] bool is_cache_file(const std::filesystem::path& file);

}  // namespace sprung
