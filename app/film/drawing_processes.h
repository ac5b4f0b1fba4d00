#pragma once
#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <vector>

#include "render/image/image.h"

namespace sprung {

/// Work on pictures in processes of their own. The contexts of one process share llvmpipe's one rasteriser; processes
/// do not.
class DrawingProcesses {
 public:
  using Send = std::function<void(const Image& image)>;
  /// What the process of this number does.
  using Work = std::function<void(std::size_t process, const Send& send)>;

  /// Forks; each process works with one thread for tasks and says no more than what it sends. To be called where this
  /// process has one thread (end_worker_threads) and no program is being written to. Throws Error(kFailed).
  DrawingProcesses(std::size_t count, const Work& work);
  /// Stops those that are not done.
  ~DrawingProcesses();
  DrawingProcesses(const DrawingProcesses&) = delete;
  DrawingProcesses& operator=(const DrawingProcesses&) = delete;

  /// Waits for what that one sends next: colours alone. Throws what its work threw, Error(kFailed) where it ended
  /// without a word, Interrupted.
  [[nodiscard]] Image receive(std::size_t process);
  /// Waits until all are done. Throws likewise.
  void finish();

 private:
  struct Child {
    int pipe;
    pid_t process;  // -1: has ended
  };
  void start(std::size_t number, const Work& work);
  void stop();

  std::vector<Child> children_;
};

/// Ends the threads that wait for tasks; new ones begin with the next tasks. False where that cannot be.
[[nodiscard]] bool end_worker_threads();

}  // namespace sprung
