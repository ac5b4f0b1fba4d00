#include "app/validate/mapped_block.h"

#include <fmt/format.h>

#include <map>
#include <vector>

namespace sprung {
namespace {

using Cell = std::array<int, 3>;

class BlockMesher {
 public:
  explicit BlockMesher(const Cell& divisions) : divisions_(divisions) {}

  /// A face across `axis`.
  void add_face(std::size_t axis, bool is_high) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    parts_.push_back({.name = fmt::format("{}-{}", "xyz"[axis], is_high ? "high" : "low"),
                      .first_triangle = isize(triangles_),
                      .triangle_count = 2 * divisions_[u] * divisions_[v]});
    for (int i = 0; i < divisions_[u]; ++i) {
      for (int j = 0; j < divisions_[v]; ++j) {
        const auto corner = [&](int along_u, int along_v) {
          Cell cell{};
          cell[axis] = is_high ? divisions_[axis] : 0;
          cell[u] = i + along_u;
          cell[v] = j + along_v;
          return number_of(cell);
        };
        const std::array<int, 4> round{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
        const auto [a, b, c, d] = round;
        triangles_.push_back(is_high ? Eigen::RowVector3i(a, b, c) : Eigen::RowVector3i(a, c, b));
        triangles_.push_back(is_high ? Eigen::RowVector3i(a, c, d) : Eigen::RowVector3i(a, d, c));
      }
    }
  }

  [[nodiscard]] SurfaceMesh finish(const std::function<Vec3(const Vec3&)>& map) const {
    SurfaceMesh mesh;
    mesh.positions.resize(isize(cells_), 3);
    for (int row = 0; row < isize(cells_); ++row) {
      Vec3 place;
      for (int axis = 0; axis < 3; ++axis) place[axis] = double(cells_[row][axis]) / divisions_[axis];
      mesh.positions.row(row) = map(place).transpose();
    }
    mesh.triangles.resize(isize(triangles_), 3);
    for (int row = 0; row < isize(triangles_); ++row) mesh.triangles.row(row) = triangles_[row];
    mesh.parts = parts_;
    return mesh;
  }

 private:
  int number_of(const Cell& cell) {
    const auto [place, is_new] = numbers_.try_emplace(cell, isize(cells_));
    if (is_new) cells_.push_back(cell);
    return place->second;
  }

  Cell divisions_;
  std::map<Cell, int> numbers_;
  std::vector<Cell> cells_;
  std::vector<Eigen::RowVector3i> triangles_;
  std::vector<Part> parts_;
};

}  // namespace

SurfaceMesh mapped_block(const std::array<int, 3>& divisions, const std::function<Vec3(const Vec3& position)>& map) {
  BlockMesher mesher(divisions);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    mesher.add_face(axis, false);
    mesher.add_face(axis, true);
  }
  return mesher.finish(map);
}

SurfaceMesh block_mesh(const Vec3& sides) {
  return mapped_block({1, 1, 1}, [=](const Vec3& p) { return Vec3(p.cwiseProduct(sides)); });
}

}  // namespace sprung
