#include "render/trace/light_probes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/mesh/repair/components.h"
#include "render/stage/coarse_triangles.h"
#include "render/stage/visible_sides.h"

namespace sprung {
namespace {

constexpr double kReach = 1.4;      // of a probe, in spacings
constexpr double kSpacing = 0.045;  // of a skin's radius
constexpr double kPerCell = 2.9;    // probes on a surface as large as the side of a cell

using Cell = std::array<int, 3>;

Cell cell_of(const Skin& skin, int vertex, double spacing) {
  Cell cell{};
  for (int k = 0; k < 3; ++k) cell[std::size_t(k)] = int(std::floor(skin.positions(vertex, k) / spacing));
  return cell;
}

/// The side of a cube that a vertex's normal passes through.
int side_of(const Skin& skin, int vertex) {
  Eigen::Index axis = 0;
  skin.normals.row(vertex).cwiseAbs().maxCoeff(&axis);
  return 2 * int(axis) + (skin.normals(vertex, axis) < 0 ? 1 : 0);
}

struct Entry {
  int probe;
  float weight;
};

double area(const Skin& skin) {
  double sum = 0;
  for (int t = 0; t < skin.triangles.rows(); ++t) sum += triangle_area(skin.positions, skin.triangles, t);
  return sum;
}

}  // namespace

LightProbes place_probes(const Skin& skin, double min_spacing) {
  const int count = int(skin.positions.rows());
  // Vertices that are further apart are all probes, and take their light from as many neighbours as others do.
  const double spacing = std::max(min_spacing, std::sqrt(area(skin) / std::max(count, 1)));
  std::vector<std::pair<Cell, int>> keys;
  keys.reserve(std::size_t(count));
  for (int i = 0; i < count; ++i) keys.emplace_back(cell_of(skin, i, spacing), side_of(skin, i));
  const std::vector<int> representative = first_with_same(keys);

  LightProbes result;
  std::vector<int> probe_of(std::size_t(count), 0);  // by vertex that is one
  std::map<Cell, std::vector<int>> probes_in;
  for (int i = 0; i < count; ++i) {
    if (representative[std::size_t(i)] != i) continue;
    probe_of[std::size_t(i)] = int(result.vertices.size());
    probes_in[keys[std::size_t(i)].first].push_back(int(result.vertices.size()));
    result.vertices.push_back(i);
  }

  const auto entries_of = [&](int vertex) {
    std::vector<Entry> entries;
    const Cell& cell = keys[std::size_t(vertex)].first;
    float sum = 0;
    for (int neighbor = 0; neighbor < 27; ++neighbor) {
      const auto found =
          probes_in.find({cell[0] + neighbor % 3 - 1, cell[1] + neighbor / 3 % 3 - 1, cell[2] + neighbor / 9 - 1});
      if (found == probes_in.end()) continue;
      for (const int probe : found->second) {
        const int other = result.vertices[std::size_t(probe)];
        const double distance = (skin.positions.row(other) - skin.positions.row(vertex)).norm() / (kReach * spacing);
        const double along = skin.normals.row(other).dot(skin.normals.row(vertex));
        if (distance >= 1 || along <= 0) continue;
        const double near = 1 - distance * distance;
        entries.push_back({probe, float(near * near * along * along)});
        sum += entries.back().weight;
      }
    }
    if (sum < 1e-6F) return std::vector{Entry{probe_of[std::size_t(representative[std::size_t(vertex)])], 1.0F}};
    for (Entry& entry : entries) entry.weight /= sum;
    return entries;
  };
  std::vector<std::vector<Entry>> all(static_cast<std::size_t>(count));
  tbb::parallel_for(0, count, [&](int vertex) { all[std::size_t(vertex)] = entries_of(vertex); });
  for (const std::vector<Entry>& entries : all) {
    result.first.push_back(int(result.probes.size()));
    for (const Entry& entry : entries) {
      result.probes.push_back(entry.probe);
      result.weights.push_back(entry.weight);
    }
  }
  result.first.push_back(int(result.probes.size()));
  return result;
}

std::vector<double> probe_spacings(const std::vector<const Skin*>& skins, int most) {
  double whole = 0;
  for (const Skin* skin : skins) whole += area(*skin);
  const double least = std::max(std::sqrt(kPerCell * whole / most), 1e-12);
  std::vector<double> spacings;
  spacings.reserve(skins.size());
  for (const Skin* skin : skins) {
    spacings.push_back(std::max(kSpacing * skin_radius(*skin), least));
  }
  return spacings;
}

}  // namespace sprung
