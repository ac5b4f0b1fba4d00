#include "core/mesh/solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/count_of.h"
#include "core/error.h"
#include "core/mesh/shells.h"
#include "core/mesh/weld.h"

namespace sprung {
namespace {

/// Below this share of surface times diagonal, a shell's volume is nothing but rounding.
constexpr double kNoVolume = 1e-12;

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name, reason));
}

void refuse_flat(const Points& points, const std::string& name) {
  const Vec3 extent = (points.colwise().maxCoeff() - points.colwise().minCoeff()).transpose();
  for (int axis = 0; axis < 3; ++axis) {
    if (extent[axis] > 0) continue;
    refuse(name,
           fmt::format("the surface is flat ({} extent 0) and encloses no volume; give it a thickness", "xyz"[axis]));
  }
}

void refuse_faults(const EdgeFaults& faults, const std::string& name) {
  if (!faults.any()) return;
  std::string found;
  const auto add = [&](const std::string& text) { found += (found.empty() ? "" : ", ") + text; };
  if (faults.open > 0) {
    add(fmt::format("{} in {}", count_of(faults.open, "open edge"), count_of(faults.loops, "loop")));
  }
  if (faults.non_manifold > 0)
    add(count_of(faults.non_manifold, "edge") + " with more than two triangles (non-manifold)");
  if (faults.one_sided > 0) add(count_of(faults.one_sided, "edge") + " where inside meets outside (one-sided surface)");
  refuse(name, fmt::format("the surface does not enclose a solid: {}; {}", found,
                           faults.open > 0 ? "close the holes in a mesh editor first"
                                           : "make it manifold in a mesh editor first"));
}

double surface_area(const WeldedMesh& mesh, const Shell& shell) {
  double area = 0;
  for (const int t : shell.triangles) {
    const Vec3 a = mesh.points.row(mesh.triangles(t, 0));
    const Vec3 b = mesh.points.row(mesh.triangles(t, 1)).transpose() - a;
    const Vec3 c = mesh.points.row(mesh.triangles(t, 2)).transpose() - a;
    area += 0.5 * std::sqrt(std::max(0.0, b.squaredNorm() * c.squaredNorm() - b.dot(c) * b.dot(c)));
  }
  return area;
}

bool has_volume(const WeldedMesh& mesh, const Shell& shell) {
  return std::abs(shell.volume) > kNoVolume * surface_area(mesh, shell) * (shell.high - shell.low).norm();
}

/// True where most of three of the inner shell's corners, far apart in its list, lie inside the outer shell.
bool contains(const WeldedMesh& mesh, const Shell& outer, const Shell& inner) {
  if ((inner.low.array() < outer.low.array()).any() || (inner.high.array() > outer.high.array()).any()) return false;
  int inside = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int t = inner.triangles[i * (inner.triangles.size() - 1) / 2];
    const Vec3 corner = mesh.points.row(mesh.triangles(t, 0));
    if (std::abs(winding_number(mesh.points, mesh.triangles, outer.triangles, corner)) > 0.5) ++inside;
  }
  return inside >= 2;
}

/// A shell that bounds a solid from outside, with the cavities in it.
struct Nest {
  const Shell* outer;
  std::vector<const Shell*> cavities;
};

/// A shell is a cavity of the solid around it when it is turned the other way and in none of that solid's cavities.
/// From the largest to the smallest, so that whatever may hold a shell comes before it.
std::vector<Nest> nest_shells(const WeldedMesh& mesh, const std::vector<Shell>& shells) {
  std::vector<const Shell*> order;
  order.reserve(shells.size());
  for (const Shell& shell : shells) order.push_back(&shell);
  std::stable_sort(order.begin(), order.end(),
                   [](const Shell* a, const Shell* b) { return std::abs(a->volume) > std::abs(b->volume); });
  std::vector<Nest> nests;
  for (const Shell* shell : order) {
    const auto holds = [&](const Nest& nest) {
      const auto inside = [&](const Shell* cavity) { return contains(mesh, *cavity, *shell); };
      return (nest.outer->volume < 0) != (shell->volume < 0) && contains(mesh, *nest.outer, *shell) &&
             std::none_of(nest.cavities.begin(), nest.cavities.end(), inside);
    };
    // The smallest solid that holds it comes last.
    const auto home = std::find_if(nests.rbegin(), nests.rend(), holds);
    if (home != nests.rend()) {
      home->cavities.push_back(shell);
    } else {
      nests.push_back({shell, {}});
    }
  }
  return nests;
}

Solid make_solid(const WeldedMesh& mesh, const Nest& nest) {
  std::vector<int> rows = nest.outer->triangles;
  for (const Shell* cavity : nest.cavities) rows.insert(rows.end(), cavity->triangles.begin(), cavity->triangles.end());
  std::sort(rows.begin(), rows.end());

  Solid solid;
  solid.volume = std::abs(nest.outer->volume);
  for (const Shell* cavity : nest.cavities) solid.volume -= std::abs(cavity->volume);
  solid.triangles = mesh.triangles(rows, Eigen::all);
  if (nest.outer->volume < 0) solid.triangles.col(1).swap(solid.triangles.col(2));
  for (const int row : rows) solid.source.push_back(mesh.source[static_cast<std::size_t>(row)]);

  std::vector<int> used(solid.triangles.data(), solid.triangles.data() + solid.triangles.size());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (int& corner : solid.triangles.reshaped<Eigen::RowMajor>()) {
    corner = static_cast<int>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
  }
  solid.points = mesh.points(used, Eigen::all);
  return solid;
}

std::vector<Repair> list_repairs(const WeldedMesh& mesh, const Shells& found, const std::vector<Nest>& nests,
                                 int flat) {
  std::vector<Repair> repairs;
  const auto add = [&](const char* kind, long count, const std::string& text, bool harmless = false) {
    if (count > 0) repairs.push_back({kind, static_cast<int>(count), text, harmless});
  };
  add("degenerate", mesh.without_area, "dropped " + count_of(mesh.without_area, "triangle") + " without area");
  add("duplicate", mesh.repeated, "dropped " + count_of(mesh.repeated, "repeated triangle"));
  add("oriented", found.turned, "turned " + count_of(found.turned, "triangle") + " to agree with their neighbours");
  const auto inverted =
      std::count_if(nests.begin(), nests.end(), [](const Nest& nest) { return nest.outer->volume < 0; });
  add("inside_out", inverted, "turned " + count_of(inverted, "inside-out solid") + " outwards");
  long cavities = 0;
  for (const Nest& nest : nests) cavities += static_cast<long>(nest.cavities.size());
  add("cavity", cavities, "kept " + count_of(cavities, "cavity", "cavities"), true);
  add("dropped_flat", flat, "dropped " + count_of(flat, "closed piece") + " without volume");
  return repairs;
}

}  // namespace

Solids find_solids(const SurfaceMesh& mesh, const std::string& name) {
  WeldedMesh welded = weld(mesh);
  if (welded.triangles.rows() == 0) refuse(name, "no triangle has an area");
  refuse_flat(welded.points, name);
  Shells found = find_shells(welded.points, welded.triangles);
  refuse_faults(found.faults, name);

  const auto empty = std::stable_partition(found.shells.begin(), found.shells.end(),
                                           [&](const Shell& shell) { return has_volume(welded, shell); });
  const auto flat = static_cast<int>(found.shells.end() - empty);
  found.shells.erase(empty, found.shells.end());
  if (found.shells.empty()) refuse(name, "the surface is closed but encloses no volume");

  Solids result;
  const std::vector<Nest> nests = nest_shells(welded, found.shells);
  for (const Nest& nest : nests) result.solids.push_back(make_solid(welded, nest));
  std::stable_sort(result.solids.begin(), result.solids.end(),
                   [](const Solid& a, const Solid& b) { return a.volume > b.volume; });
  result.repairs = list_repairs(welded, found, nests, flat);
  return result;
}

}  // namespace sprung
