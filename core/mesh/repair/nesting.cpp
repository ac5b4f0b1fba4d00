#include "core/mesh/repair/nesting.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/mesh/query/winding_tree.h"

namespace sprung {

double enclosure(const Points& points, const Triangles& triangles, const std::vector<int>& rows) {
  constexpr std::size_t kSamples = 1000;
  const WindingTree tree(points, triangles, rows);
  std::vector<double> windings;
  for (std::size_t i = 0; i < rows.size(); i += 1 + rows.size() / kSamples) {
    const Vec3 middle = points(triangles.row(rows[i]), Eigen::all).colwise().mean();
    windings.push_back(tree.at(middle));
  }
  const auto median = windings.begin() + std::ptrdiff_t(windings.size() / 2);
  std::nth_element(windings.begin(), median, windings.end());
  return std::abs(*median);
}

namespace {

/// Which shells lie in which.
class Containment {
 public:
  Containment(const Points& points, const Triangles& triangles) : points_(points), triangles_(triangles) {}

  /// True where most of three of the inner shell's corners, far apart in its list, lie inside the outer shell.
  bool contains(const SurfaceComponent& outer, const SurfaceComponent& inner) {
    if ((inner.low.array() < outer.low.array()).any() || (inner.high.array() > outer.high.array()).any()) return false;
    const WindingTree& tree = trees_.try_emplace(&outer, points_, triangles_, outer.triangles).first->second;
    int inside = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int t = inner.triangles[i * (inner.triangles.size() - 1) / 2];
      if (std::abs(tree.at(points_.row(triangles_(t, 0)))) > 0.5) ++inside;
    }
    return inside >= 2;
  }

  /// In the outer shell and in none of its cavities.
  bool is_in_matter(const NestedComponents& nest, const SurfaceComponent& inner) {
    return contains(*nest.outer, inner) &&
           std::none_of(nest.cavities.begin(), nest.cavities.end(),
                        [&](const SurfaceComponent* cavity) { return contains(*cavity, inner); });
  }

 private:
  const Points& points_;
  const Triangles& triangles_;
  std::map<const SurfaceComponent*, WindingTree> trees_;
};

/// For each triangle the nest that it is of, or -1.
std::vector<int> nest_of_triangles(const std::vector<NestedComponents>& nests, Eigen::Index triangles) {
  std::vector<int> number(triangles, -1);
  const auto mark = [&](const SurfaceComponent& shell, std::size_t nest) {
    for (const int t : shell.triangles) number[t] = int(nest);
  };
  for (std::size_t i = 0; i < nests.size(); ++i) {
    mark(*nests[i].outer, i);
    for (const SurfaceComponent* cavity : nests[i].cavities) mark(*cavity, i);
  }
  return number;
}

}  // namespace

std::vector<NestedComponents> nest_shells(const Points& points, const Triangles& triangles,
                                          const std::vector<SurfaceComponent>& shells) {
  std::vector<const SurfaceComponent*> order;
  order.reserve(shells.size());
  for (const SurfaceComponent& shell : shells) order.push_back(&shell);
  // So that whatever may hold a shell comes before it.
  std::stable_sort(order.begin(), order.end(), [](const SurfaceComponent* a, const SurfaceComponent* b) {
    return std::abs(a->volume) > std::abs(b->volume);
  });
  Containment containment(points, triangles);
  std::vector<NestedComponents> nests;
  for (const SurfaceComponent* shell : order) {
    // The smallest nest that holds it comes last.
    const auto home = std::find_if(nests.rbegin(), nests.rend(), [&](const NestedComponents& nest) {
      return (nest.outer->volume < 0) != (shell->volume < 0) && containment.is_in_matter(nest, *shell);
    });
    if (home != nests.rend()) {
      home->cavities.push_back(shell);
    } else {
      nests.push_back({shell, {}});
    }
  }
  return nests;
}

std::vector<NestGroup> unite_nests(const Points& points, const Triangles& triangles,
                                   std::vector<NestedComponents> nests,
                                   const std::vector<std::array<int, 2>>& crossings) {
  DisjointSets sets(nests.size());
  const std::vector<int> number = nest_of_triangles(nests, triangles.rows());
  std::vector<bool> crosses(nests.size(), false);
  for (const auto& [a, b] : crossings) {
    const int nest_a = number[a];
    const int nest_b = number[b];
    if (nest_a < 0 || nest_b < 0 || nest_a == nest_b) continue;
    sets.merge(nest_a, nest_b);
    crosses[nest_a] = crosses[nest_b] = true;
  }
  Containment containment(points, triangles);
  for (std::size_t inner = 0; inner < nests.size(); ++inner) {
    for (std::size_t outer = 0; outer < inner; ++outer) {
      if (!containment.is_in_matter(nests[outer], *nests[inner].outer)) continue;
      sets.merge(int(outer), int(inner));
      nests[inner].is_buried = !crosses[inner];
    }
  }
  std::map<int, NestGroup> groups;
  for (std::size_t i = 0; i < nests.size(); ++i) {
    groups[sets.find(int(i))].push_back(std::move(nests[i]));
  }
  std::vector<NestGroup> list;
  list.reserve(groups.size());
  for (auto& [root, group] : groups) list.push_back(std::move(group));
  return list;
}

}  // namespace sprung
