#pragma once
#include <optional>
#include <vector>

#include "core/types.h"

namespace sprung {

/// What a motion carries on from frame to frame beside positions and velocities, as a row of numbers: one function of
/// a motion passes all it has, in the same order whether it puts it in or takes it out.
class IntegratorState {
 public:
  /// Puts in.
  IntegratorState() = default;
  /// Takes out. Asserts that there is as much as is asked for.
  explicit IntegratorState(std::vector<double> row) : row_(std::move(row)), next_(0) {}

  void serialize(double& value) {
    if (!next_) {
      row_.push_back(value);
    } else {
      value = row_.at((*next_)++);
    }
  }
  template <class Number>
  void serialize_as_double(Number& number) {
    auto value = double(number);
    serialize(value);
    number = static_cast<Number>(value);
  }
  /// The count of rows is known on both sides.
  void serialize(Points& points) {
    for (double& value : points.reshaped<Eigen::RowMajor>()) serialize(value);
  }
  void serialize(Vec3& vector) {
    for (double& value : vector) serialize(value);
  }

  [[nodiscard]] const std::vector<double>& row() const { return row_; }

 private:
  std::vector<double> row_;
  std::optional<std::size_t> next_;  // to take out
};

}  // namespace sprung
