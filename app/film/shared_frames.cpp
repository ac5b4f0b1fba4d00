#include "app/film/shared_frames.h"

#include <semaphore.h>
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include "app/console/interrupt.h"
#include "core/error.h"

namespace sprung {

/// At the beginning of the memory; the readers' semaphores follow it.
struct SharedFrames::Control {
  std::atomic<std::size_t> count = 0;  // of frames so far
  std::atomic<bool> is_closed = false;

  [[nodiscard]] sem_t* semaphores() { return reinterpret_cast<sem_t*>(this + 1); }
};

SharedFrames::SharedFrames(std::size_t frames, std::vector<Eigen::Index> nodes, std::size_t readers)
    : nodes_(std::move(nodes)),
      readers_(readers),
      per_frame_(3 * std::size_t(std::accumulate(nodes_.begin(), nodes_.end(), Eigen::Index{0}))),
      offset_(sizeof(Control) + readers * sizeof(sem_t)),
      bytes_(offset_ + frames * per_frame_ * sizeof(float)),
      memory_(mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
  if (memory_ == MAP_FAILED) {
    throw Error(ErrorKind::kFailed, "no memory to share with drawing processes; --jobs 1 needs none");
  }
  auto* control = new (memory_) Control;
  for (std::size_t reader = 0; reader < readers_; ++reader) sem_init(control->semaphores() + reader, 1, 0);
}

SharedFrames::~SharedFrames() { munmap(memory_, bytes_); }

float* SharedFrames::numbers(std::size_t frame) const {
  return reinterpret_cast<float*>(static_cast<std::byte*>(memory_) + offset_) + frame * per_frame_;
}

void SharedFrames::add(const std::vector<Floats3>& frame) {
  auto* control = static_cast<Control*>(memory_);
  float* to = numbers(control->count);
  for (const Floats3& body : frame) to = std::copy_n(body.data(), body.size(), to);
  ++control->count;
  wake();
}

void SharedFrames::close() {
  static_cast<Control*>(memory_)->is_closed = true;
  wake();
}

void SharedFrames::wake() {
  auto* control = static_cast<Control*>(memory_);
  for (std::size_t reader = 0; reader < readers_; ++reader) sem_post(control->semaphores() + reader);
}

std::vector<Floats3> SharedFrames::wait_for(std::size_t frame, std::size_t reader) const {
  auto* control = static_cast<Control*>(memory_);
  while (control->count <= frame && !control->is_closed) {
    stop_if_interrupted();
    sem_wait(control->semaphores() + reader);  // returns after a signal, too
  }
  std::vector<Floats3> bodies;
  if (control->count <= frame) return bodies;
  const float* from = numbers(frame);
  for (const Eigen::Index nodes : nodes_) {
    bodies.emplace_back(Eigen::Map<const Floats3>(from, nodes, 3));
    from += 3 * nodes;
  }
  return bodies;
}

}  // namespace sprung
