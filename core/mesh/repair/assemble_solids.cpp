#include "core/mesh/repair/assemble_solids.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/mesh/query/self_intersections.h"
#include "core/mesh/query/winding_tree.h"
#include "core/text.h"

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

/// Tests whether shells contain one another.
class Containment {
 public:
  Containment(const Points& points, const Triangles& triangles) : points_(points), triangles_(triangles) {}

  /// Whether at least two of three corners of the inner shell, far apart in its list, lie inside the outer shell.
  bool contains(const SurfaceComponent& outer, const SurfaceComponent& inner) {
    if (!outer.bounds.contains(inner.bounds)) return false;
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

/// The nest of each triangle, or -1.
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
  // Shells come after any that may contain them.
  std::stable_sort(order.begin(), order.end(), [](const SurfaceComponent* a, const SurfaceComponent* b) {
    return std::abs(a->volume) > std::abs(b->volume);
  });
  Containment containment(points, triangles);
  std::vector<NestedComponents> nests;
  for (const SurfaceComponent* shell : order) {
    // The smallest nest that contains it comes last.
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

namespace {

using Crossings = std::vector<std::array<int, 2>>;  // pairs of rows of the triangles

/// Intersections of all triangles except those of dropped pieces.
Crossings crossings_of(const WeldedMesh& mesh, const std::vector<SurfaceComponent>& shells) {
  std::vector<bool> is_kept(mesh.triangles.rows(), false);
  for (const SurfaceComponent& shell : shells) {
    for (const int t : shell.triangles) is_kept[t] = true;
  }
  Crossings crossings = find_self_intersections(mesh.points, mesh.triangles);
  std::erase_if(crossings, [&](const auto& pair) { return !is_kept[pair[0]] || !is_kept[pair[1]]; });
  return crossings;
}

std::vector<NestGroup> group_nests(const WeldedMesh& mesh, const std::vector<NestedComponents>& nests,
                                   const Crossings& crossings, RepairMode repair) {
  if (repair != RepairMode::kOff) return unite_nests(mesh.points, mesh.triangles, nests, crossings);
  std::vector<NestGroup> groups;
  groups.reserve(nests.size());
  for (const NestedComponents& nest : nests) groups.push_back({nest});
  return groups;
}

/// Whether a triangle of the group intersects another.
bool overlaps(const NestGroup& group, const std::vector<bool>& crosses) {
  const auto any = [&](const SurfaceComponent* shell) {
    return std::any_of(shell->triangles.begin(), shell->triangles.end(), [&](int t) { return crosses[t]; });
  };
  return std::any_of(group.begin(), group.end(), [&](const NestedComponents& nest) {
    return any(nest.outer) || std::any_of(nest.cavities.begin(), nest.cavities.end(), any);
  });
}

void note_nests(const std::vector<NestedComponents>& nests, std::vector<Repair>& repairs) {
  const auto inverted =
      std::count_if(nests.begin(), nests.end(), [](const NestedComponents& nest) { return nest.outer->volume < 0; });
  add_repair(repairs, "inside_out", inverted, "turned " + count_of(inverted, "inside-out solid") + " outwards");
  long cavities = 0;
  for (const NestedComponents& nest : nests) cavities += long(nest.cavities.size());
  add_repair(repairs, "cavity", cavities, "kept " + count_of(cavities, "cavity", "cavities"), true);
}

void note_union(const std::vector<NestGroup>& groups, std::vector<Repair>& repairs) {
  long united = 0;
  for (const NestGroup& group : groups) united += group.size() > 1 ? long(group.size()) : 0;
  add_repair(repairs, "united", united,
             fmt::format("united {} that overlap, touch or lie in one another ({} left)",
                         count_of(united, "body", "bodies"), count_of(groups.size(), "solid")));
}

/// Caps may intersect nearby triangles; only intersections of the mesh's own triangles are reported.
void note_crossings(const WeldedMesh& mesh, Crossings crossings, Solids& made) {
  std::erase_if(crossings, [&](const auto& pair) { return mesh.source[pair[0]] < 0 || mesh.source[pair[1]] < 0; });
  if (crossings.empty()) return;
  made.crossing = mesh.points(mesh.triangles.row(crossings.front()[0]), Eigen::all).colwise().mean();
  const long pairs = crossings.size();
  add_repair(made.repairs, "self_intersection", pairs,
             fmt::format("the surface intersects itself: {}; overlaps are filled once",
                         count_of(pairs, "pair of triangles", "pairs of triangles")));
}

}  // namespace

Solids assemble_solids(const WeldedMesh& mesh, const std::vector<SurfaceComponent>& shells, RepairMode repair) {
  const Crossings crossings = crossings_of(mesh, shells);
  const std::vector<NestedComponents> nests = nest_shells(mesh.points, mesh.triangles, shells);
  const std::vector<NestGroup> groups = group_nests(mesh, nests, crossings, repair);
  std::vector<bool> crosses(mesh.triangles.rows(), false);
  for (const auto& [a, b] : crossings) crosses[a] = true;
  Solids made;
  for (const NestGroup& group : groups) {
    made.solids.push_back(cut_solid(mesh, group));
    made.solids.back().overlaps = overlaps(group, crosses);
  }
  note_nests(nests, made.repairs);
  note_union(groups, made.repairs);
  note_crossings(mesh, crossings, made);
  return made;
}

namespace {

/// A triangle, and whether it is to be flipped.
using Row = std::pair<int, bool>;

void take_triangles(const WeldedMesh& mesh, const std::vector<Row>& rows, Solid& solid) {
  solid.triangles.resize(isize(rows), 3);
  for (int t = 0; t < solid.triangles.rows(); ++t) {
    const auto [row, turn] = rows[t];
    solid.triangles.row(t) = mesh.triangles.row(row);
    if (turn) std::swap(solid.triangles(t, 1), solid.triangles(t, 2));
    solid.source.push_back(mesh.source[row]);
    solid.flipped.push_back(mesh.flipped[row] != turn);
  }
}

void take_points(const WeldedMesh& mesh, Solid& solid) {
  std::vector<int> used(solid.triangles.data(), solid.triangles.data() + solid.triangles.size());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (int& corner : solid.triangles.reshaped<Eigen::RowMajor>()) {
    corner = int(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
  }
  solid.points = mesh.points(used, Eigen::all);
}

}  // namespace

Solid cut_solid(const WeldedMesh& mesh, const NestGroup& group) {
  std::vector<Row> rows;
  Solid solid;
  for (const NestedComponents& nest : group) {
    const bool inverted = nest.outer->volume < 0;
    double volume = std::abs(nest.outer->volume);
    for (const int t : nest.outer->triangles) rows.emplace_back(t, inverted);
    for (const SurfaceComponent* cavity : nest.cavities) {
      volume -= std::abs(cavity->volume);
      for (const int t : cavity->triangles) rows.emplace_back(t, inverted);
    }
    if (!nest.is_buried) solid.volume += volume;
  }
  std::sort(rows.begin(), rows.end());
  take_triangles(mesh, rows, solid);
  take_points(mesh, solid);
  return solid;
}

double given_area(const WeldedMesh& mesh, const std::vector<int>& rows) {
  double area = 0;
  for (const int t : rows) {
    if (mesh.source[t] >= 0) area += triangle_area(mesh.points, mesh.triangles, t);
  }
  return area;
}

}  // namespace sprung
