#pragma once
#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "render/image/image.h"

namespace sprung {

/// Draws pictures in parallel processes. Threads would not help: all contexts of a process share one rasteriser of
/// llvmpipe.
class DrawingProcesses {
 public:
  using Send = std::function<void(const Image& image)>;
  /// Work of process number `process`.
  using Work = std::function<void(std::size_t process, const Send& send)>;

  /// Forks; each child has one thread for tasks and prints nothing. Call it while this process has a single thread
  /// (end_worker_threads) and no pipe to a program. Throws Error(kFailed).
  DrawingProcesses(std::size_t count, const Work& work);
  /// Stops the children that are not done.
  ~DrawingProcesses();
  DrawingProcesses(const DrawingProcesses&) = delete;
  DrawingProcesses& operator=(const DrawingProcesses&) = delete;

  /// Waits for the next picture of that child; none once its work is done. Throws what its work threw, Error(kFailed)
  /// if it ended without a message, Interrupted.
  [[nodiscard]] std::optional<Image> receive(std::size_t process);
  /// Waits for all children. Throws likewise.
  void finish();
  /// Asks the children to stop; may be called by another thread than those above.
  void interrupt() const;

 private:
  struct Child {
    int pipe;
    pid_t process;  // -1: did not start
    bool is_done = false;
  };
  void start(std::size_t number, const Work& work);
  void stop();

  std::vector<Child> children_;
};

/// Ends idle worker threads; the next tasks start new ones. False if that is impossible.
[[nodiscard]] bool end_worker_threads();

}  // namespace sprung
