#include "core/bricks/winding_cells.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/mesh/winding_tree.h"

namespace sprung {
namespace {

constexpr int kBlock = 4;      // cells along a block's side
constexpr int kSamples = 4;    // along a cell's side
constexpr double kSure = 0.2;  // this far from 1/2 the winding number decides for a whole block

class Filler {
 public:
  Filler(const CellSurface& surface, CellSums& sums)
      : surface_(surface), sums_(sums), tree_(surface.points, surface.triangles), touched_(sums.weight.size(), 0) {
    for (int t = 0; t < surface.triangles.rows(); ++t) mark(t);
  }

  void fill_block(const Eigen::Vector3i& low) {
    const Eigen::Vector3i high = (low.array() + kBlock).min(surface_.counts.array());
    bool is_near = false;
    visit(low, high, [&](const Eigen::Vector3i&, std::size_t i) { is_near = is_near || touched_[i] != 0; });
    const double middle = winding(0.5 * (low + high).cast<double>());
    const bool is_sure = !is_near && std::abs(middle - 0.5) > kSure;
    visit(low, high, [&](const Eigen::Vector3i& cell, std::size_t i) {
      sums_.weight[i] = 1;
      sums_.weighted[i] = static_cast<float>(is_sure            ? (middle > 0.5 ? 1 : 0)
                                             : touched_[i] != 0 ? sampled(cell)
                                                                : inside(cell.cast<double>().array() + 0.5));
    });
  }

 private:
  [[nodiscard]] std::size_t row_of(const Eigen::Vector3i& cell) const {
    return (static_cast<std::size_t>(cell.z()) * static_cast<std::size_t>(surface_.counts.y()) +
            static_cast<std::size_t>(cell.y())) *
               static_cast<std::size_t>(surface_.counts.x()) +
           static_cast<std::size_t>(cell.x());
  }

  template <class Visit>
  void visit(const Eigen::Vector3i& low, const Eigen::Vector3i& high, const Visit& call) const {
    for (int z = low.z(); z < high.z(); ++z) {
      for (int y = low.y(); y < high.y(); ++y) {
        for (int x = low.x(); x < high.x(); ++x) call(Eigen::Vector3i(x, y, z), row_of({x, y, z}));
      }
    }
  }

  /// Cells in the triangle's box that its plane cuts.
  void mark(int t) {
    const auto corner = [&](int k) -> Vec3 { return surface_.points.row(surface_.triangles(t, k)); };
    const Vec3 a = corner(0);
    const Vec3 b = corner(1);
    const Vec3 c = corner(2);
    const Vec3 normal = (b - a).cross(c - a);
    const double reach = 0.5 * normal.cwiseAbs().sum();
    const Eigen::Array3i low = a.cwiseMin(b).cwiseMin(c).array().floor().cast<int>();
    const Eigen::Array3i high = a.cwiseMax(b).cwiseMax(c).array().floor().cast<int>() + 1;
    visit(low.max(0), high.min(surface_.counts.array()), [&](const Eigen::Vector3i& cell, std::size_t i) {
      const Vec3 middle = cell.cast<double>().array() + 0.5;
      if (std::abs(normal.dot(middle - a)) <= reach) touched_[i] = 1;
    });
  }

  [[nodiscard]] double winding(const Vec3& place) const { return std::abs(tree_.at(place)); }
  [[nodiscard]] double inside(const Vec3& place) const { return winding(place) > 0.5 ? 1 : 0; }

  [[nodiscard]] double sampled(const Eigen::Vector3i& cell) const {
    double sum = 0;
    for (int i = 0; i < kSamples * kSamples * kSamples; ++i) {
      const Eigen::Array3i place(i % kSamples, i / kSamples % kSamples, i / (kSamples * kSamples));
      sum += inside(cell.cast<double>().array() + (place.cast<double>() + 0.5) / kSamples);
    }
    return sum / (kSamples * kSamples * kSamples);
  }

  const CellSurface& surface_;
  CellSums& sums_;
  WindingTree tree_;
  std::vector<std::uint8_t> touched_;
};

}  // namespace

void fill_by_winding(const CellSurface& surface, CellSums& sums) {
  Filler filler(surface, sums);
  const Eigen::Vector3i blocks = (surface.counts.array() + kBlock - 1) / kBlock;
  tbb::parallel_for(0, blocks.prod(), [&](int block) {
    const Eigen::Vector3i place(block % blocks.x(), block / blocks.x() % blocks.y(), block / (blocks.x() * blocks.y()));
    filler.fill_block(kBlock * place);
  });
}

}  // namespace sprung
