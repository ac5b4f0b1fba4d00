#include "app/load/part_study.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "app/load/load_answer_text.h"
#include "app/load/part_modes.h"
#include "app/scene/resting_pose.h"
#include "core/error.h"
#include "core/files.h"
#include "core/mesh/io/read_mesh.h"
#include "core/mesh/query/thickness.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr double kLargeDisplacement = 0.1;  // of the longest side, at which linear theory is 1 % off in a cantilever
constexpr double kTooLarge = 0.2;           // likewise, from which a linear solution warns
constexpr double kFewBricks = 10000;
constexpr double kMaxBricks = 250000;    // of the finest grid, by default: some seconds
constexpr double kMaxNonlinear = 60000;  // since each takes some ten solves

/// Passes each warning on once: the mesh is read anew for every grid.
class OnceObserver : public Observer {
 public:
  explicit OnceObserver(const Observer& observer) : observer_(observer) {}
  void warn(std::string_view message) const override {
    if (said_.emplace(message).second) observer_.warn(message);
  }
  void note(std::string_view message) const override { observer_.note(message); }
  void detail(std::string_view message) const override { observer_.detail(message); }
  void check_interrupt() const override { observer_.check_interrupt(); }
  void show(const Progress& progress) const override { observer_.show(progress); }
  void finish(const Progress& progress, std::string_view result) const override { observer_.finish(progress, result); }
  void clear(const Progress& progress) const override { observer_.clear(progress); }

 private:
  const Observer& observer_;
  mutable std::set<std::string, std::less<>> said_;
};

struct FileUnit {
  std::string name;
  bool is_guess = false;
};

/// Millimetres, as is usual in design and printing, unless the file says otherwise.
FileUnit usual_unit(const std::filesystem::path& file) {
  const std::string stated = stated_unit(file);
  return stated.empty() ? FileUnit{"mm", true} : FileUnit{stated, false};
}

LoadPart read_part(const PartQuestion& question, const Observer& observer) {
  LoadPart part{.body = question.body};
  const FileUnit usual = question.body.surface ? FileUnit{"mm", question.unit.empty()} : usual_unit(question.body.mesh);
  part.unit_name = question.unit.empty() ? usual.name : question.unit;
  part.unit = metres_in(part.unit_name);
  if (part.body.size && !question.unit.empty()) throw Error(ErrorKind::kUsage, "give --unit or --size, not both");
  if (!part.body.size) part.body.scale = part.unit;
  if (question.is_z_up) part.body.rotation = Vec3(-90, 0, 0);
  part.world_from_file = rotation_matrix(part.body.rotation);
  part.loaded = load_body(part.body, observer);
  if (part.body.size) {
    part.unit = part.loaded.extent.norm() / (part.loaded.file_from_rest.linear() * part.loaded.extent).norm();
    part.unit_name = "of the file";
  }
  if (usual.is_guess && question.unit.empty() && !part.body.size) {
    observer.note(fmt::format("unit: {} is taken to be in mm, {}; --unit cm, m, in for another", part.loaded.name,
                              sides_text(part.loaded.extent)));
  }
  return part;
}

void check_size(const LoadPart& part, const Observer& observer) {
  const double longest = part.loaded.extent.maxCoeff();
  const std::string other = part.unit_name != "mm" ? "mm" : longest > 1 ? "um" : "m";
  if (longest > 1e3 || longest < 1e-6) {
    throw Error(ErrorKind::kUsage, fmt::format("{} is {:.4g} m long if its unit is {}; --unit {} would make it {}",
                                               part.loaded.name, longest, part.unit_name, other,
                                               readable(longest / part.unit * metres_in(other), Dimension::kLength)));
  }
  if (longest < 100 && longest > 1e-4) return;
  observer.warn(fmt::format("{} is {} long in {}: is that its unit? --unit mm, cm, m, in", part.loaded.name,
                            readable(longest, Dimension::kLength), part.unit_name));
}

void check_case(const PartQuestion& question) {
  if (question.fixes.empty()) {
    throw Error(ErrorKind::kUsage,
                "the part has no support: --fix WHERE, one of x-low, x-high, y-low, y-high, z-low, z-high, "
                "face=X,Y,Z, or the name of a part of the mesh");
  }
  if (question.loads.empty()) {
    throw Error(ErrorKind::kUsage, "the part has no load: --load WHERE:50N, --load y-high:2MPa, --load weight");
  }
}

PartBricks bricks_for(const LoadPart& part, bool linear) {
  const double longest = part.loaded.extent.maxCoeff();
  if (part.body.brick_size) return part_bricks_from(part.loaded, *part.body.brick_size);
  if (part.body.bricks && !part.body.bricks->is_auto()) {
    return part_bricks_from(part.loaded, longest / part.body.bricks->along);
  }
  return choose_part_bricks(part.loaded, linear ? kMaxBricks : kMaxNonlinear);
}

/// Whether linear theory is requested or, according to the coarsest grid, suffices.
bool is_small(const PartQuestion& question, const LoadPart& part, const LoadCase& loads, const Observer& observer) {
  if (question.analysis == PartAnalysis::kAuto && question.buckling) return true;  // which requires it
  if (question.analysis != PartAnalysis::kAuto) return question.analysis == PartAnalysis::kLinear;
  PartBricks coarse = choose_part_bricks(part.loaded, kFewBricks);
  coarse.sizes = {coarse.sizes.back()};
  const PartAnswer answer =
      answer_of(solve_part(part, loads, coarse, true, QuietObserver(observer, false)), part, loads, coarse);
  const double share = answer.displacement.value / answer.extent.maxCoeff();
  if (share < kLargeDisplacement) return true;
  observer.note(
      fmt::format("the part moves by some {}, {:.2g} % of its length: solved for large displacements; "
                  "--analysis linear for small ones",
                  readable(answer.displacement.value, Dimension::kLength), 100 * share));
  return false;
}

double surface_of(const LoadPart& part) {
  double area = 0;
  for (const Solid& solid : part.loaded.solids) area += surface_area(solid);
  return area;
}

/// Warns of likely mistakes: faces that are most of the surface, and loads on supports.
void warn_of_faces(const LoadPart& part, const LoadCase& loads, const Observer& observer) {
  constexpr double kMost = 0.5;  // of the surface
  constexpr double kSame = 1e-3;
  const double surface = surface_of(part);
  const auto check = [&](const char* option, const std::string& text, const PartFace& face) {
    if (face.area < kMost * surface) return;
    observer.warn(
        fmt::format("{} '{}' takes {:.0f} % of the part's surface; a smaller part of it: ball=X,Y,Z,R or "
                    "box=X,Y,Z,X,Y,Z",
                    option, text, 100 * face.area / surface));
  };
  for (const PartFix& fix : loads.fixes) {
    check("--fix", fix.text, fix.face);
    const std::array<bool, 3>& fixed = fix.pin.axes.fixed;
    for (const PartLoad& load : loads.loads) {
      if (!load.face || fix.pin.normal || !(fixed[0] && fixed[1] && fixed[2])) continue;
      const double apart = (load.face->centre - fix.face.centre).norm();
      if (apart > kSame * std::sqrt(surface) || std::abs(load.face->area - fix.face.area) > kSame * surface) continue;
      observer.warn(fmt::format("--load '{}' acts on what --fix '{}' holds, and does nothing", load.text, fix.text));
    }
  }
  for (const PartLoad& load : loads.loads) {
    if (load.face && load.dimension != Dimension::kPressure) check("--load", load.text, *load.face);
  }
}

}  // namespace

PartStudy study_part(const PartQuestion& question, const Observer& listener) {
  const OnceObserver observer(listener);
  check_case(question);
  LoadPart part = read_part(question, observer);
  check_size(part, observer);
  LoadCase loads = parse_load_case(question.fixes, question.loads, part);
  warn_of_faces(part, loads, observer);
  const bool is_linear = is_small(question, part, loads, observer);
  const PartBricks bricks = bricks_for(part, is_linear);
  std::vector<PartSolution> solutions = solve_part(part, loads, bricks, is_linear, observer);
  PartAnswer answer = answer_of(solutions, part, loads, bricks);
  if (is_linear && answer.displacement.value > kTooLarge * answer.extent.maxCoeff()) {
    observer.warn(
        fmt::format("the part moves by {}, {:.0f} % of its length, which small displacements are not for: "
                    "--analysis nonlinear",
                    readable(answer.displacement.value, Dimension::kLength),
                    100 * answer.displacement.value / answer.extent.maxCoeff()));
  }
  answer.points = answers_at(question.points, solutions, part);
  if (question.modes > 0) answer.frequencies = frequencies_of(solutions, question.modes, observer);
  answer.has_buckling = question.buckling;
  if (question.buckling) answer.buckling_factor = buckling_factor_of(solutions, observer);
  return {std::move(part), std::move(loads), std::move(solutions), std::move(answer)};
}

}  // namespace sprung
