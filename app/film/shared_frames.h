#pragma once
#include <cstddef>
#include <vector>

#include "core/skin/skin.h"

namespace sprung {

/// The frames of a motion in memory that this process shares with those that it forks afterwards. It adds them one by
/// one; the others wait for them.
class SharedFrames {
 public:
  /// `nodes`: of each body; `readers`: processes. Throws Error(kFailed) if there is no memory for them.
  SharedFrames(std::size_t frames, std::vector<Eigen::Index> nodes, std::size_t readers);
  ~SharedFrames();
  SharedFrames(const SharedFrames&) = delete;
  SharedFrames& operator=(const SharedFrames&) = delete;

  /// The next frame, by body.
  void add(const std::vector<Floats3>& frame);
  /// There are no more frames.
  void close();

  /// For reader number `reader`: waits until that frame is there, or all that come are. Returns the frame, or nothing.
  /// Throws Interrupted.
  [[nodiscard]] std::vector<Floats3> wait_for(std::size_t frame, std::size_t reader) const;

 private:
  struct Control;
  [[nodiscard]] float* numbers(std::size_t frame) const;
  void wake();

  std::vector<Eigen::Index> nodes_;
  std::size_t readers_;
  std::size_t per_frame_;  // numbers
  std::size_t offset_;     // bytes, of the first frame
  std::size_t bytes_;
  void* memory_;
};

}  // namespace sprung
