#pragma once
#include <optional>
#include <vector>

#include "core/types.h"

namespace sprung {

/// The state of a motion besides positions and velocities, as a row of numbers: one function of a motion serializes all
/// of it, in the same order for writing and reading.
class IntegratorState {
 public:
  /// For writing.
  IntegratorState() = default;
  /// For reading. Asserts that the row is long enough.
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
  std::optional<std::size_t> next_;  // of the number to read next
};

}  // namespace sprung
