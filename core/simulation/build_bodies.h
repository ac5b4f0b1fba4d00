#pragma once
#include <string>
#include <vector>

#include "core/bricks/embedding.h"
#include "core/bricks/pieces.h"
#include "core/simulation/body_source.h"
#include "core/simulation/fill_report.h"
#include "core/simulation/selector.h"
#include "core/simulation/simulation.h"
#include "core/types.h"

namespace sprung {

/// Adds one body of a scene to a simulation: its solids filled with bricks, placed and pinned, once per copy; all
/// copies of a solid are consecutive.
class BodyBuilder {
 public:
  /// Body `index` of the scene. All must outlive it.
  BodyBuilder(const Scene& scene, std::size_t index, const LoadedBody& loaded, Simulation& simulation);

  /// Changes nothing but this builder, so that several may run concurrently. Throws Error(kBadInput) if a region, a pin
  /// or a cut refers to a part that does not exist.
  void fill_solids();

  /// Adds the filled solids to the simulation.
  void add_solids();

  /// Reports how well the bricks fill the body, and unpinned solids. Throws Error(kBadInput) if no pin holds a node.
  void tell(const Observer& observer) const;

 private:
  /// A solid filled with bricks.
  struct FilledBody {
    SoftBody body;
    Origin origin;
  };

  /// In the pose of its grid.
  [[nodiscard]] FilledBody fill(std::size_t solid);
  [[nodiscard]] BrickGrid make_grid(const Solid& solid);
  /// Throws Error(kBadInput) if one reaches no brick.
  void check_regions() const;
  [[nodiscard]] std::vector<PinnedNodes> find_pins(const Body& body, std::size_t solid) const;
  void put(FilledBody filled, const Pose& pose, int copy);

  [[nodiscard]] std::vector<ProbedPart> find_probed(const SoftBody& body, std::size_t solid) const;

  const Scene& scene_;
  const SceneBody& body_;
  std::size_t index_;
  const LoadedBody& loaded_;
  Simulation& simulation_;
  bool can_touch_;
  bool collides_with_itself_;
  Selector selector_;
  FillReport report_;
  int pinned_solids_ = 0;
  std::vector<int> solid_of_vertex_;  // of the mesh
  std::vector<FilledBody> filled_;    // by solid
};

}  // namespace sprung
