#pragma once
#include <chrono>
#include <string>
#include <string_view>

namespace sprung {

class Progress;
struct Crossings;
struct World;

/// Receives the messages of long operations, and may interrupt them. This one ignores them.
class Observer {
 public:
  virtual ~Observer() = default;

  /// Messages of decreasing importance.
  virtual void warn(std::string_view) const {}
  virtual void note(std::string_view) const {}
  virtual void detail(std::string_view) const {}

  /// Called often; throws to interrupt the operation.
  virtual void check_interrupt() const {}

  /// Frame `frame` (from 0) is done, at `progress`: time (s), or share of the load, or number of the mode. Of a run
  /// that is resumed, those of this run only.
  virtual void finish_frame(int /*frame*/, double /*progress*/, const World&) const {}

  /// How skins cross in a frame of a motion; called before it is finished.
  virtual void look_at(const Crossings&) const {}

  /// A stage has begun or advanced, has finished, or has ended without a result.
  virtual void show(const Progress&) const {}
  virtual void finish(const Progress&, std::string_view) const {}
  virtual void clear(const Progress&) const {}
};

/// The progress of one stage of a long operation.
class Progress {
 public:
  /// `total` units of work, 0: unknown; the rate is shown as `scale` times units per second, for example 1e-6 and "M
  /// brick-steps/s". The observer must outlive it.
  Progress(const Observer& observer, std::string name, double total = 0, double scale = 1, std::string rate_unit = "")
      : observer_(observer), name_(std::move(name)), total_(total), scale_(scale), rate_unit_(std::move(rate_unit)) {
    observer_.show(*this);
  }
  ~Progress() { observer_.clear(*this); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` units so far.
  void update(double done) {
    done_ = done;
    observer_.show(*this);
  }
  /// Ends the stage with its result.
  void finish(std::string_view result) { observer_.finish(*this, result); }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] double total() const { return total_; }
  [[nodiscard]] double done() const { return done_; }
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// At the rate so far; 0 if unknown.
  [[nodiscard]] double seconds_to_go() const { return done_ > 0 ? seconds() * (total_ - done_) / done_ : 0; }
  /// Times `scale`, per second; 0 if unknown or without a unit.
  [[nodiscard]] double rate() const { return rate_unit_.empty() || done_ <= 0 ? 0 : scale_ * done_ / seconds(); }
  [[nodiscard]] const std::string& rate_unit() const { return rate_unit_; }

 private:
  const Observer& observer_;
  std::string name_;
  double total_;
  double scale_;
  std::string rate_unit_;
  double done_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace sprung
