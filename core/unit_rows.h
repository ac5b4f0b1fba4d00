#pragma once
#include <Eigen/Core>
#include <cmath>

namespace sprung {

/// Each row divided by its length; zero if that is 0 or NaN.
template <class Rows>
[[nodiscard]] typename Rows::PlainObject unit_rows(const Eigen::MatrixBase<Rows>& rows) {
  typename Rows::PlainObject units = rows;
  for (auto row : units.rowwise()) {
    const auto length = row.norm();
    if (length > 0 && std::isfinite(length)) {
      row /= length;
    } else {
      row.setZero();
    }
  }
  return units;
}

}  // namespace sprung
