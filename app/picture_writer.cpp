#include "app/picture_writer.h"

#include "app/writable.h"
#include "render/image/exr.h"
#include "render/image/png.h"

namespace sprung {
namespace {

constexpr std::size_t kMostWaiting = 4;

}  // namespace

PictureWriter::PictureWriter(std::vector<Output> outputs, int width, int height, double fps, int first, int step)
    : outputs_(std::move(outputs)), next_(first), step_(step) {
  for (const Output& output : outputs_) {
    make_folder(output.folder);
    if (output.kind != Output::Kind::kFilm) continue;
    films_.push_back(std::make_unique<FilmWriter>(output.film, width, height, fps));
  }
  thread_ = std::thread([this] { run(); });
}

PictureWriter::~PictureWriter() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    is_closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void PictureWriter::write(Drawing drawing) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting || failure_; });
  if (failure_) std::rethrow_exception(failure_);
  waiting_.push_back(std::move(drawing));
  changed_.notify_all();
}

void PictureWriter::close() {
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
  thread_.join();
  if (failure_) std::rethrow_exception(failure_);
  for (const auto& film : films_) film->close();
}

void PictureWriter::run() {
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !waiting_.empty() || is_closed_; });
    if (waiting_.empty()) return;
    const Drawing drawing = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    changed_.notify_all();
    try {
      write_everywhere(drawing);
    } catch (...) {
      lock.lock();
      failure_ = std::current_exception();
      changed_.notify_all();
      return;
    }
  }
}

void PictureWriter::write_everywhere(const Drawing& drawing) {
  for (const Output& output : outputs_) {
    if (output.kind == Output::Kind::kPictures) write_png(drawing.image, output.picture(next_));
    if (output.kind == Output::Kind::kPasses) write_exr(drawing.passes.value(), output.picture(next_));
  }
  for (const auto& film : films_) film->write(drawing.image);
  next_ += step_;
}

}  // namespace sprung
