#include "core/mesh/repair/solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/mesh/repair/assemble_solids.h"
#include "core/mesh/repair/close_shells.h"
#include "core/mesh/repair/components.h"
#include "core/mesh/repair/weld.h"
#include "core/text.h"

namespace sprung {
namespace {

/// Below this fraction of surface times diagonal, a shell's volume is only rounding error.
constexpr double kNoVolume = 1e-12;
/// Open pieces that enclose less than this fraction of the largest one, and have a low enclosure(), are debris.
constexpr double kDebris = 0.01;

constexpr const char* kAdvice = "ask for a shell with --thickness 3mm";

bool has_volume(const WeldedMesh& mesh, const SurfaceComponent& shell) {
  return std::abs(shell.volume) > kNoVolume * given_area(mesh, shell.triangles) * shell.bounds.diagonal().norm();
}

/// Repairs one mesh and finds its solids.
class MeshRepairer {
 public:
  MeshRepairer(const SurfaceMesh& mesh, const std::string& name, const SolidOptions& options)
      : name_(name), options_(options), mesh_(weld(mesh)) {}

  Solids solids() {
    if (mesh_.triangles.rows() == 0) refuse("no triangle has an area");
    add("welded", mesh_.joined, "joined " + count_of(mesh_.joined, "vertex", "vertices") + " of equal position", true);
    add("unreferenced", mesh_.unreferenced,
        "left out " + count_of(mesh_.unreferenced, "vertex", "vertices") + " without a triangle", true);
    add("degenerate", mesh_.without_area, "dropped " + count_of(mesh_.without_area, "triangle") + " without area");
    add("duplicate", mesh_.repeated, "dropped " + count_of(mesh_.repeated, "repeated triangle"));
    if (options_.thickness > 0) {
      find_sheets();
    } else {
      refuse_flat();
      find_bodies();
    }
    if (options_.repair == RepairMode::kStrict) refuse_repairs();
    std::stable_sort(result_.solids.begin(), result_.solids.end(),
                     [](const Solid& a, const Solid& b) { return a.volume > b.volume; });
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name_, reason));
  }

  void add(const char* kind, long count, const std::string& text, bool harmless = false) {
    add_repair(result_.repairs, kind, count, text, harmless);
  }

  void refuse_repairs() const {
    std::string found;
    for (const std::string& note : notes_of(result_.repairs)) found += (found.empty() ? "" : ", ") + note;
    if (!found.empty()) refuse("the surface needs repair, which --repair strict does not allow: " + found);
  }

  void refuse_flat() const {
    const Vec3 extent = (mesh_.points.colwise().maxCoeff() - mesh_.points.colwise().minCoeff()).transpose();
    for (int axis = 0; axis < 3; ++axis) {
      if (extent[axis] > 0) continue;
      refuse(fmt::format("the surface is flat ({} extent 0) and encloses no volume; {}", "xyz"[axis], kAdvice));
    }
  }

  /// Consistently oriented components.
  void find_oriented_shells() {
    shells_ = find_shells(mesh_.points, mesh_.triangles);
    for (std::size_t t = 0; t < shells_.flipped.size(); ++t) {
      if (shells_.flipped[t]) mesh_.flipped[t] = !mesh_.flipped[t];
    }
  }

  void find_bodies() {
    find_oriented_shells();
    if (options_.repair == RepairMode::kOff) refuse_undecided();
    faults_ = shells_.faults;
    if (!shells_.open.empty()) stitch_boundaries();
    add("non_manifold_split", faults_.non_manifold,
        "cut the surface apart at " + count_of(faults_.non_manifold, "edge") +
            " with more than two triangles (non-manifold)");
    const auto flipped = std::count(mesh_.flipped.begin(), mesh_.flipped.end(), true);
    add("oriented", flipped, "turned " + count_of(flipped, "triangle") + " to agree with their neighbours");
    const std::vector<bool> encloses = close_holes();
    const double whole = std::accumulate(
        shells_.shells.begin(), shells_.shells.end(), 0.0,
        [&](double sum, const SurfaceComponent& shell) { return sum + given_area(mesh_, shell.triangles); });
    if (drop_empty(encloses) < 0.5 * whole && take_as_soup()) return;
    if (shells_.shells.empty()) refuse_empty();
    add("dropped_flat", dropped_, "dropped " + count_of(dropped_, "piece") + " of the surface without volume");
    Solids made = assemble_solids(mesh_, shells_.shells, options_.repair);
    result_.solids = std::move(made.solids);
    result_.crossing = made.crossing;
    for (Repair& repair : made.repairs) result_.repairs.push_back(std::move(repair));
    if (options_.repair != RepairMode::kOff) drop_specks();
  }

  void refuse_undecided() const {
    std::string found;
    const auto note = [&](long count, const std::string& text) {
      if (count > 0) found += (found.empty() ? "" : ", ") + text;
    };
    const EdgeFaults& faults = shells_.faults;
    const auto flipped = std::count(mesh_.flipped.begin(), mesh_.flipped.end(), true);
    note(faults.open, fmt::format("{} in {}", count_of(faults.open, "open edge"), count_of(faults.loops, "loop")));
    note(faults.one_sided, count_of(faults.one_sided, "edge") + " where inside meets outside (one-sided surface)");
    note(flipped, count_of(flipped, "triangle") + " turned against their neighbours");
    if (found.empty() && !shells_.open.empty()) found = count_of(faults.non_manifold, "edge") + " (non-manifold)";
    if (!found.empty()) refuse(fmt::format("the surface does not enclose a solid: {}; use --repair auto", found));
  }

  void stitch_boundaries() {
    const int stitched = stitch(shells_.open, mesh_);
    if (stitched == 0) return;
    add("stitched", stitched, "stitched " + count_of(stitched, "point") + " of rims that almost meet");
    find_oriented_shells();
  }

  /// A hole is small relative to its surface; one that is as large is the rim of a cloth or a bowl.
  void refuse_large_cap(double area) const {
    constexpr double kMost = 0.2;  // of the closed surface
    const double share = area / (area + given_area(mesh_, shells_.shells.front().triangles));
    if (share <= kMost) return;
    refuse(
        fmt::format("the surface is an open sheet ({} in {}): a cap on its rim would be {:.0f} % of the solid's "
                    "surface; {}, or close it",
                    count_of(faults_.open, "open edge"), count_of(faults_.loops, "loop"), 100 * share, kAdvice));
  }

  /// For each shell, whether it bounds a volume even without its caps.
  std::vector<bool> close_holes() {
    std::vector<bool> encloses(shells_.shells.size(), true);
    for (const OpenSide& side : shells_.open) encloses[side.shell] = false;
    for (std::size_t i = 0; i < encloses.size(); ++i) {
      if (encloses[i]) continue;
      encloses[i] = enclosure(mesh_.points, mesh_.triangles, shells_.shells[i].triangles) >= kEncloses;
    }
    const int holes = std::max(shells_.faults.loops, 1);
    const Closing closing = close_shells(mesh_, shells_);
    if (shells_.shells.size() == 1 && faults_.one_sided == 0) refuse_large_cap(closing.largest_cap);
    const int caps = closing.flat + closing.smooth;
    add("hole_filled", caps == 0 ? 0 : holes,
        fmt::format("filled {}{} ({} flat, {} smooth)", count_of(holes, "hole"),
                    caps == holes ? "" : fmt::format(" in {} pieces", caps), closing.flat, closing.smooth));
    for (std::size_t i = 0; i < encloses.size(); ++i) {
      if (!has_volume(mesh_, shells_.shells[i])) encloses[i] = false;
    }
    return encloses;
  }

  /// Drops shells without volume, and open ones that enclose next to nothing compared to the others; returns the area
  /// of those that enclose a volume by themselves.
  double drop_empty(const std::vector<bool>& encloses) {
    double largest = 0;
    double enclosing = 0;
    for (std::size_t i = 0; i < encloses.size(); ++i) {
      if (!encloses[i]) continue;
      largest = std::max(largest, std::abs(shells_.shells[i].volume));
      enclosing += given_area(mesh_, shells_.shells[i].triangles);
    }
    std::vector<SurfaceComponent> kept;
    for (std::size_t i = 0; i < encloses.size(); ++i) {
      SurfaceComponent& shell = shells_.shells[i];
      if (encloses[i] || (largest > 0 && std::abs(shell.volume) > kDebris * largest)) kept.push_back(std::move(shell));
    }
    dropped_ = int(shells_.shells.size() - kept.size());
    shells_.shells = std::move(kept);
    return enclosing;
  }

  /// Where the pieces enclose a volume only together: one solid of all triangles of the mesh.
  bool take_as_soup() {
    std::vector<int> rows;
    for (int t = 0; t < mesh_.triangles.rows(); ++t) {
      if (mesh_.source[t] >= 0) rows.push_back(t);
    }
    if (dropped_ < 2 || enclosure(mesh_.points, mesh_.triangles, rows) < kEncloses) return false;
    SurfaceComponent all;
    all.triangles = rows;
    measure(mesh_.points, mesh_.triangles, all);
    if (!has_volume(mesh_, all)) return false;
    Solid solid = cut_solid(mesh_, {{.outer = &all, .cavities = {}}});
    solid.closed = false;
    result_.solids.push_back(std::move(solid));
    std::erase_if(result_.repairs, [](const Repair& repair) { return repair.kind == "hole_filled"; });
    add("united", dropped_,
        "took " + count_of(dropped_, "loose piece") + " that enclose a volume only together as one solid");
    return true;
  }

  [[noreturn]] void refuse_empty() const {
    if (faults_.one_sided > 0) {
      refuse(
          fmt::format("the surface is one-sided ({} where inside meets outside, as on a Moebius band) and encloses "
                      "no volume; {}",
                      count_of(faults_.one_sided, "edge"), kAdvice));
    }
    if (faults_.open == 0) refuse(fmt::format("the surface is closed but encloses no volume; {}", kAdvice));
    if (dropped_ > 1) {
      refuse(fmt::format("the surface is {} loose pieces that enclose no volume ({}); {}", dropped_,
                         count_of(faults_.open, "open edge"), kAdvice));
    }
    refuse(fmt::format("the surface is an open sheet ({} in {}) and encloses no volume; {}",
                       count_of(faults_.open, "open edge"), count_of(faults_.loops, "loop"), kAdvice));
  }

  void drop_specks() {
    double largest = 0;
    for (const Solid& solid : result_.solids) largest = std::max(largest, solid.volume);
    const auto dropped =
        long(std::erase_if(result_.solids, [&](const Solid& solid) { return solid.volume < kSpeckShare * largest; }));
    add("dropped_speck", dropped,
        fmt::format("dropped {}, smaller than {} of the largest solid", count_of(dropped, "floating speck"),
                    kSpeckShare));
  }

  /// Every piece as it is, as a shell of the given thickness.
  void find_sheets() {
    find_oriented_shells();
    std::vector<double> rims(shells_.shells.size());
    for (const OpenSide& side : shells_.open) {
      rims[side.shell] += (mesh_.points.row(side.from) - mesh_.points.row(side.to)).norm();
    }
    const double thickness = options_.thickness;
    for (std::size_t i = 0; i < rims.size(); ++i) {
      SurfaceComponent& shell = shells_.shells[i];
      shell.volume =
          given_area(mesh_, shell.triangles) * thickness + rims[i] * std::numbers::pi / 8 * thickness * thickness;
      if (!(shell.volume > 0)) continue;
      Solid solid = cut_solid(mesh_, {{.outer = &shell, .cavities = {}}});
      solid.thickness = thickness;
      result_.solids.push_back(std::move(solid));
    }
    if (result_.solids.empty()) refuse("no triangle has an area");
    const long count = result_.solids.size();
    add("thickened", count, "made " + count_of(count, "piece") + " of the surface a shell", true);
  }

  const std::string& name_;
  const SolidOptions& options_;
  WeldedMesh mesh_;
  SurfaceComponents shells_;
  EdgeFaults faults_;  // before stitching
  int dropped_ = 0;    // shells
  Solids result_;
};

}  // namespace

Solids find_solids(const SurfaceMesh& mesh, const std::string& name, const SolidOptions& options) {
  return MeshRepairer(mesh, name, options).solids();
}

}  // namespace sprung
