#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/types.h"

namespace sprung {

/// Counts along each axis, slowest first.
using ArrayShape = std::vector<std::size_t>;

/// Row-major.
template <class Value>
struct Array {
  ArrayShape shape;
  std::vector<Value> values;
};

/// Writes an HDF5 file of arrays (losslessly compressed), strings, and series: arrays that grow row by row. From
/// start_series() on the file is in HDF5's single-writer mode: a reader finds every appended row, whenever the writer
/// is killed. Groups in names ("/bodies/1/cells") are created as needed.
/// Value: double, float, int, std::uint8_t or std::uint64_t. All functions throw Error(kFailed) with the file and the
/// system's reason.
class Hdf5Writer {
 public:
  /// Replaces an existing file.
  explicit Hdf5Writer(std::filesystem::path file);
  /// Closes; errors are ignored.
  ~Hdf5Writer();
  Hdf5Writer(Hdf5Writer&&) noexcept;
  Hdf5Writer& operator=(Hdf5Writer&&) noexcept;

  template <class Value>
  void write(const std::string& name, std::span<const Value> values, const ArrayShape& shape);
  void write_text(const std::string& name, const std::string& text);
  void write_texts(const std::string& name, const std::vector<std::string>& texts);

  /// An empty series of rows of that shape.
  template <class Value>
  void make_series(const std::string& name, const ArrayShape& row);
  /// A matrix whose rows are overwritten in place.
  void make_slots(const std::string& name, std::size_t rows, std::size_t columns);

  /// No datasets can be created from here on.
  void start_series();
  /// Appends a row to a series and flushes it.
  template <class Value>
  void append(const std::string& name, std::span<const Value> row);
  /// `values`: as many as there are columns.
  void fill_slot(const std::string& name, std::size_t row, std::span<const double> values);

  void close();
  /// Call after the file was renamed; for messages.
  void rename(std::filesystem::path file);

 private:
  struct Open;
  std::unique_ptr<Open> open_;
};

/// All functions throw Error(kBadInput) if the file is not HDF5 or lacks the dataset.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::filesystem::path file);
  ~Hdf5Reader();
  Hdf5Reader(Hdf5Reader&&) noexcept;
  Hdf5Reader& operator=(Hdf5Reader&&) noexcept;

  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] ArrayShape shape_of(const std::string& name) const;
  template <class Value>
  [[nodiscard]] Array<Value> read(const std::string& name) const;
  /// One row along the first axis, in the shape of a row.
  template <class Value>
  [[nodiscard]] Array<Value> read_row(const std::string& name, std::size_t row) const;
  [[nodiscard]] std::string read_text(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> read_texts(const std::string& name) const;

 private:
  struct Open;
  std::unique_ptr<Open> open_;
};

/// The values of a row-major matrix.
template <class Matrix>
[[nodiscard]] std::span<const typename Matrix::Scalar> flat_values(const Matrix& matrix) {
  return {matrix.data(), std::size_t(matrix.size())};
}

template <class Matrix>
void write_matrix(Hdf5Writer& hdf5, const std::string& name, const Matrix& matrix) {
  hdf5.write(name, flat_values(matrix), {std::size_t(matrix.rows()), std::size_t(matrix.cols())});
}

/// Throws Error(kBadInput) if the number of columns differs.
template <class Matrix>
[[nodiscard]] Matrix matrix_from(const Array<typename Matrix::Scalar>& array, const std::string& name) {
  const std::size_t columns = array.shape.size() == 2 ? array.shape[1] : 1;
  constexpr int kColumns = Matrix::ColsAtCompileTime;
  if (array.shape.empty() || columns != kColumns) {
    throw Error(ErrorKind::kBadInput, name + ": the cache is damaged: not the shape it should have");
  }
  return Eigen::Map<const Matrix>(array.values.data(), array.shape[0], kColumns);
}

template <class Matrix>
[[nodiscard]] Matrix read_matrix(const Hdf5Reader& hdf5, const std::string& name) {
  return matrix_from<Matrix>(hdf5.read<typename Matrix::Scalar>(name), name);
}

}  // namespace sprung
