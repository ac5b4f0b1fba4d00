#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/load/load_case.h"
#include "app/load/part_answer.h"

namespace sprung {

/// Decides whether displacements are assumed to be small.
enum class PartAnalysis {
  kAuto,  // kLinear, unless the part moves by more than a tenth of its length
  kLinear,
  kNonlinear
};

inline constexpr const char* kUsualPartMaterial = "abs";

/// A request for an analysis; texts as parse_load_case() expects them.
struct PartQuestion {
  SceneBody body{};      // its mesh and material; bricks if they are chosen
  std::string unit{};    // of the file; empty: m for glTF, else mm
  bool is_z_up = false;  // the vertical of the file, else y
  std::vector<std::string> fixes{};
  std::vector<std::string> loads{};
  std::vector<Vec3> points{};  // of the file
  PartAnalysis analysis = PartAnalysis::kAuto;
  int modes = 0;  // number of vibration modes
  bool buckling = false;
};

/// A part, its loads and its response.
struct PartStudy {
  LoadPart part;
  LoadCase loads;
  std::vector<PartSolution> solutions;  // finest first
  PartAnswer answer;
};

/// Reads, loads and solves a part. Throws Error(kUsage) if a text, a unit or a point is wrong or the part has no
/// support or no load, Error(kBadInput) for a mesh that cannot be used or is not supported, Error(kDiverged),
/// Interrupted.
[[nodiscard]] PartStudy study_part(const PartQuestion& question, const Observer& observer);

}  // namespace sprung
