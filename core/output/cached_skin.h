#pragma once
#include <span>
#include <string>

#include "core/error.h"
#include "core/output/hdf5_file.h"
#include "core/skin/skin.h"

namespace sprung {

/// A matrix stored row by row, as numbers in a row.
template <class Matrix>
[[nodiscard]] std::span<const typename Matrix::Scalar> flat_values(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

template <class Matrix>
void write_matrix(Hdf5Writer& hdf5, const std::string& name, const Matrix& matrix) {
  hdf5.write(name, flat_values(matrix),
             {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())});
}

/// Throws Error(kBadInput) where the file has another number of columns.
template <class Matrix>
[[nodiscard]] Matrix matrix_from(const Array<typename Matrix::Scalar>& array, const std::string& name) {
  const std::size_t columns = array.shape.size() == 2 ? array.shape[1] : 1;
  constexpr int kColumns = Matrix::ColsAtCompileTime;
  if (array.shape.empty() || columns != kColumns) {
    throw Error(ErrorKind::kBadInput, name + ": the cache is damaged: not the shape it should have");
  }
  return Eigen::Map<const Matrix>(array.values.data(), static_cast<Eigen::Index>(array.shape[0]), kColumns);
}

template <class Matrix>
[[nodiscard]] Matrix read_matrix(const Hdf5Reader& hdf5, const std::string& name) {
  return matrix_from<Matrix>(hdf5.read<typename Matrix::Scalar>(name), name);
}

/// A skin in a folder of a cache: "folder/positions", "folder/triangles" and so on.
void write_skin(Hdf5Writer& hdf5, const std::string& folder, const Skin& skin);
[[nodiscard]] Skin read_skin(const Hdf5Reader& hdf5, const std::string& folder);

}  // namespace sprung
