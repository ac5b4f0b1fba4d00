#include "core/skin/refine.h"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sprung {
namespace {

/// One pass: every long edge of the skin is halved once.
class Refiner {
 public:
  Refiner(const Skin& skin, double max_edge) : skin_(skin), max_squared_(max_edge * max_edge) {}

  /// False where no edge was too long.
  bool run(Skin& refined) {
    for (const Part& part : skin_.parts) {
      const auto first = static_cast<int>(triangles_.size());
      for (int t = 0; t < part.triangle_count; ++t) split_triangle(part.first_triangle + t);
      refined.parts.push_back(part);
      refined.parts.back().first_triangle = first;
      refined.parts.back().triangle_count = static_cast<int>(triangles_.size()) - first;
    }
    if (ends_.empty()) return false;
    refined.materials = skin_.materials;
    refined.positions = with_midpoints(skin_.positions);
    refined.normals = with_midpoints(skin_.normals);
    refined.normals.bottomRows(static_cast<int>(ends_.size())).rowwise().normalize();
    if (skin_.uvs.rows() > 0) refined.uvs = with_midpoints(skin_.uvs);
    if (skin_.colors.rows() > 0) refined.colors = with_midpoints(skin_.colors);
    refined.triangles.resize(static_cast<int>(triangles_.size()), 3);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (int c = 0; c < 3; ++c)
        refined.triangles(static_cast<int>(t), c) = triangles_[t][static_cast<std::size_t>(c)];
    }
    return true;
  }

 private:
  template <class Rows>
  [[nodiscard]] Rows with_midpoints(const Rows& rows) const {
    Rows all(rows.rows() + static_cast<int>(ends_.size()), rows.cols());
    all.topRows(rows.rows()) = rows;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      all.row(rows.rows() + static_cast<int>(i)) = (rows.row(ends_[i][0]) + rows.row(ends_[i][1])) / 2;
    }
    return all;
  }

  /// The middle vertex of an edge, or -1 where the edge is short enough.
  int middle(int a, int b) {
    if ((skin_.positions.row(a) - skin_.positions.row(b)).squaredNorm() <= max_squared_) return -1;
    if (a > b) std::swap(a, b);
    const std::uint64_t key = static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    const int next = static_cast<int>(skin_.positions.rows()) + static_cast<int>(ends_.size());
    const auto [entry, is_new] = middles_.try_emplace(key, next);
    if (is_new) ends_.push_back({a, b});
    return entry->second;
  }

  void split_triangle(int triangle) {
    std::array<int, 3> v{};
    std::array<int, 3> m{};  // m[i]: middle of the edge from v[i] to v[i + 1]
    for (std::size_t i = 0; i < 3; ++i) v[i] = skin_.triangles(triangle, static_cast<int>(i));
    std::size_t halved = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      m[i] = middle(v[i], v[(i + 1) % 3]);
      halved += m[i] >= 0 ? 1 : 0;
    }
    if (halved == 0) {
      triangles_.push_back(v);
      return;
    }
    if (halved == 3) {
      for (std::size_t i = 0; i < 3; ++i) triangles_.push_back({v[i], m[i], m[(i + 2) % 3]});
      triangles_.push_back(m);
      return;
    }
    split_partly(v, m, halved);
  }

  void split_partly(std::array<int, 3> v, std::array<int, 3> m, std::size_t halved) {
    // Turn the triangle until edge 0 is halved and, of two halved edges, the other one is edge 1.
    while (m[0] < 0 || (halved == 2 && m[1] < 0)) {
      v = {v[1], v[2], v[0]};
      m = {m[1], m[2], m[0]};
    }
    if (halved == 1) {
      triangles_.push_back({v[0], m[0], v[2]});
      triangles_.push_back({m[0], v[1], v[2]});
      return;
    }
    triangles_.push_back({m[0], v[1], m[1]});
    triangles_.push_back({v[0], m[0], m[1]});
    triangles_.push_back({v[0], m[1], v[2]});
  }

  const Skin& skin_;
  double max_squared_;
  std::unordered_map<std::uint64_t, int> middles_;
  std::vector<std::array<int, 2>> ends_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace

void refine(Skin& skin, double max_edge) {
  for (bool again = true; again;) {
    Skin refined;
    again = Refiner(skin, max_edge).run(refined);
    if (again) skin = std::move(refined);
  }
}

}  // namespace sprung
