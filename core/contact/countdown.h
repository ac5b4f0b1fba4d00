#pragma once

namespace sprung {

/// Counts down the time steps to the next update; the first is due at once.
class Countdown {
 public:
  [[nodiscard]] bool is_due() const { return steps_ <= 0; }
  [[nodiscard]] int steps() const { return steps_; }
  void restart(int steps) { steps_ = steps; }
  void tick() { --steps_; }

 private:
  int steps_ = 0;
};

}  // namespace sprung
