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

/// Counts along each axis, the slowest first.
using ArrayShape = std::vector<std::size_t>;

/// Numbers as a file holds them, the last axis running fastest.
template <class Value>
struct Array {
  ArrayShape shape;
  std::vector<Value> values;
};

/// A new HDF5 file of arrays (compressed without loss), texts, and series: arrays that grow row by row. From
/// start_series() on the file is in HDF5's single-writer mode: whoever opens it, at whatever moment the writer was
/// killed, finds every row that was appended. Folders in names ("/bodies/1/cells") come by themselves.
/// Value: double, float, int, std::uint8_t or std::uint64_t. Everything throws Error(kFailed) with the file and the
/// system's reason.
class Hdf5Writer {
 public:
  /// Replaces the file.
  explicit Hdf5Writer(std::filesystem::path file);
  /// Closes; what fails then is lost without a word.
  ~Hdf5Writer();
  Hdf5Writer(Hdf5Writer&&) noexcept;
  Hdf5Writer& operator=(Hdf5Writer&&) noexcept;

  template <class Value>
  void write(const std::string& name, std::span<const Value> values, const ArrayShape& shape);
  void write_text(const std::string& name, const std::string& text);
  void write_texts(const std::string& name, const std::vector<std::string>& texts);

  /// A series without rows; a row has that shape.
  template <class Value>
  void make_series(const std::string& name, const ArrayShape& row);
  /// Numbers that are written again and again, in rows that stay where they are in the file.
  void make_slots(const std::string& name, std::size_t rows, std::size_t columns);

  /// Nothing new can be made from here on.
  void start_series();
  /// One more row of a series, on its way to the disk when this returns.
  template <class Value>
  void append(const std::string& name, std::span<const Value> row);
  void fill_slot(const std::string& name, std::size_t row, std::span<const double> values);

  void close();
  /// After the file was renamed: for messages.
  void rename(std::filesystem::path file);

 private:
  struct Open;
  std::unique_ptr<Open> open_;
};

/// Throws Error(kBadInput) where the file is none of HDF5 or lacks what is asked for.
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
  /// One row along the first axis; the shape is that of the row.
  template <class Value>
  [[nodiscard]] Array<Value> read_row(const std::string& name, std::size_t row) const;
  [[nodiscard]] std::string read_text(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> read_texts(const std::string& name) const;

 private:
  struct Open;
  std::unique_ptr<Open> open_;
};

/// A matrix stored row by row, as numbers in a row.
template <class Matrix>
[[nodiscard]] std::span<const typename Matrix::Scalar> flat_values(const Matrix& matrix) {
  return {matrix.data(), std::size_t(matrix.size())};
}

template <class Matrix>
void write_matrix(Hdf5Writer& hdf5, const std::string& name, const Matrix& matrix) {
  hdf5.write(name, flat_values(matrix), {std::size_t(matrix.rows()), std::size_t(matrix.cols())});
}

/// Throws Error(kBadInput) where the file has another number of columns.
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
