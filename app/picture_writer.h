#pragma once
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "app/output.h"
#include "render/film.h"
#include "render/image/image.h"

namespace sprung {

/// What there is of a frame.
struct Drawing {
  Image image{};                   // for pictures and films
  std::optional<Passes> passes{};  // for outputs of that kind
};

/// Encodes pictures in a thread of its own, so that drawing does not wait for it. Pictures go to every output in the
/// order in which they come.
class PictureWriter {
 public:
  /// Makes the folders. Pictures have the numbers first, first + step, ... Throws Error(kFailed).
  PictureWriter(std::vector<Output> outputs, int width, int height, double fps, int first = 1, int step = 1);
  /// Stops; films that are not finished disappear.
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// Waits where too many pictures are waiting already. Throws what went wrong in the thread.
  void write(Drawing drawing);
  /// Finishes the films. Pictures that this run did not write are left alone, whatever their names.
  void close();

 private:
  void run();
  void write_everywhere(const Drawing& drawing);

  std::vector<Output> outputs_;
  std::vector<std::unique_ptr<FilmWriter>> films_;
  std::deque<Drawing> waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr failure_;
  bool is_closed_ = false;
  int next_;  // number of the next picture
  int step_;
  std::thread thread_;
};

}  // namespace sprung
