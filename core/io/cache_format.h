#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "core/error.h"
#include "core/io/hdf5_file.h"
#include "core/skin/skin.h"

namespace sprung {

/// Where things are in a cache. Whoever changes it counts kCacheLayout up.
inline constexpr int kCacheLayout = 4;
inline constexpr const char* kLayoutName = "/layout";
inline constexpr const char* kProgressName = "/frames/progress";  // written last: a frame is there when its time is
inline constexpr const char* kProbesName = "/frames/probes";
inline constexpr const char* kHashName = "/frames/state_hash";
inline constexpr const char* kSecondsName = "/frames/seconds";
inline constexpr const char* kMemoryName = "/frames/memory";  // of frame f in row f % 2

/// In the folder of an actor: positions, then velocities of all nodes to the last bit, of frame f in row f % 2; without
/// columns where the frames themselves are kept so.
inline constexpr const char* kExactName = "/exact_state";

/// Counted from 1.
[[nodiscard]] inline std::string actor_folder(std::size_t actor) { return "/actors/" + std::to_string(actor + 1); }
[[nodiscard]] inline std::string mesh_folder(std::size_t body) { return "/meshes/" + std::to_string(body + 1); }
[[nodiscard]] inline std::string obstacle_folder(std::size_t obstacle) {
  return "/obstacles/" + std::to_string(obstacle + 1);
}

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

/// A skin in a folder of a cache: "folder/positions", "folder/triangles" and so on.
void write_skin(Hdf5Writer& hdf5, const std::string& folder, const Skin& skin);
[[nodiscard]] Skin read_skin(const Hdf5Reader& hdf5, const std::string& folder);

}  // namespace sprung
