#pragma once
#include <string>
#include <vector>

namespace sprung {

/// A repair of a surface, or a defect that was found and left.
///
/// Kinds, one word each, in the order in which they are looked for:
///   welded              vertices at the same place became one point                             (harmless)
///   unreferenced        vertices that no triangle uses were left out                            (harmless)
///   degenerate          triangles without area were dropped
///   duplicate           triangles with the corners of another one were dropped
///   non_manifold_split  edges of more than two triangles, or points where surfaces touch, were cut apart
///   oriented            triangles were turned to agree with their neighbours
///   stitched            pairs of open edges at the same place were joined
///   hole_filled         loops of open edges were closed by new triangles
///   dropped_flat        pieces that enclose no volume were dropped
///   inside_out          shells were turned outwards
///   cavity              shells inside a solid, turned the other way, bound hollows in it         (harmless)
///   united              shells that overlap or lie in one another became one solid
///   dropped_speck       solids much smaller than the largest one were dropped
///   thickened           pieces of surface without volume became shells of the thickness asked for
///   self_intersection   pairs of triangles cross; what overlaps is filled once
struct Repair {
  std::string kind;
  int count = 0;
  std::string text;       // a phrase with the count: "filled 5 holes"
  bool harmless = false;  // usual in sound files: no warning, and no reason to refuse
};

/// Appends a repair if count > 0.
inline void add_repair(std::vector<Repair>& repairs, const char* kind, long count, const std::string& text,
                       bool harmless = false) {
  if (count > 0) repairs.push_back({kind, int(count), text, harmless});
}

/// How to treat a surface that does not bound solids as it is.
enum class RepairMode {
  kOff,    // take it as it is; refuse if its inside is ambiguous
  kAuto,   // repair it and report the repairs
  kStrict  // refuse whatever needs repair
};

/// The texts of all repairs that are not harmless.
[[nodiscard]] inline std::vector<std::string> notes_of(const std::vector<Repair>& repairs) {
  std::vector<std::string> notes;
  for (const Repair& repair : repairs) {
    if (!repair.harmless) notes.push_back(repair.text);
  }
  return notes;
}

}  // namespace sprung
