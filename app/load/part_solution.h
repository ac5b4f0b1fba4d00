#pragma once
#include <functional>
#include <vector>

#include "app/load/load_case.h"
#include "app/load/part_bricks.h"
#include "app/scene/film.h"
#include "core/simulation/observer.h"
#include "core/simulation/recorder.h"
#include "core/simulation/simulation.h"
#include "core/simulation/skin_supports.h"

namespace sprung {

/// The equilibrium of a loaded part at one brick size.
struct PartSolution {
  Film scene;
  Simulation simulation{};
  Recording recording{};
  double brick_size = 0;  // m
  bool is_linear = true;

  [[nodiscard]] long brick_count() const;
};

/// The skins of all bodies of a solution, one after the other.
struct PartSkin {
  Points positions;        // n x 3, m: at rest, in the frame of LoadedBody
  Points displacements;    // n x 3, m, likewise
  StressTensors stresses;  // n x 6, Pa, likewise
};

/// The scene of a part under a load case, with bricks of that size.
[[nodiscard]] Film scene_of(const LoadPart& part, const LoadCase& loads, double brick_size, bool linear);

/// Hides the stages of each grid, and all warnings but those of the finest.
class QuietObserver : public Observer {
 public:
  QuietObserver(const Observer& observer, bool warns) : observer_(observer), warns_(warns) {}
  void warn(std::string_view message) const override {
    if (warns_) observer_.warn(message);
  }
  void detail(std::string_view message) const override { observer_.detail(message); }
  void check_interrupt() const override { observer_.check_interrupt(); }

 private:
  const Observer& observer_;
  bool warns_;
};

/// Fills the part with bricks of each size, finest first, and finds its equilibria: by linear statics, or with large
/// displacements. Throws Error(kBadInput) if it is not supported, and what simulate() throws.
[[nodiscard]] std::vector<PartSolution> solve_part(const LoadPart& part, const LoadCase& loads,
                                                   const PartBricks& bricks, bool linear, const Observer& observer);

/// Converts points of a solution at rest (n x 3, m) from the world to the frame of LoadedBody.
[[nodiscard]] Points part_from_world(const PartSolution& solution, const LoadPart& part, const Points& points);

/// Rotates stresses from the axes of the world to those of the file.
[[nodiscard]] StressTensors turned_back(StressTensors stresses, const Mat3& world_from_file);

/// Stresses at the vertices of a body's skin (n x 6, Pa), in the axes of the world.
[[nodiscard]] StressTensors skin_stress(const PartSolution& solution, const SoftBody& body);

[[nodiscard]] PartSkin skin_of(const PartSolution& solution, const LoadPart& part);

}  // namespace sprung
