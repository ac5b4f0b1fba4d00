#pragma once
#include <string>
#include <vector>

#include "core/bricks/embedding.h"
#include "core/bricks/pieces.h"
#include "core/simulation/body_source.h"
#include "core/simulation/selector.h"
#include "core/simulation/simulation.h"
#include "core/types.h"

namespace sprung {

/// `grid`: the bricks of one solid of the mesh (m). The body is at rest at the position of its grid; its contact points
/// are those of its skin, as fine as its bricks can follow; none without `can_touch`. Deterministic.
[[nodiscard]] SoftBody make_soft_body(const SurfaceMesh& mesh, const Solid& solid, BrickGrid grid, Model model,
                                      const Material& material, bool can_touch = true);

/// A skin at rest, in the frame of the bricks, and where its vertices are in them.
struct EmbeddedSkin {
  Skin skin;
  Embedding embedding;
};

/// The body's skin for drawing: where its mesh is coarse, edges become curves, to within `tolerance` (m).
/// Deterministic.
[[nodiscard]] EmbeddedSkin smooth_skin(const SoftBody& body, double tolerance);

/// The poses of a body and its copies (from a LoadedBody at rest), x first, then y, then z. Random placements depend on
/// their seed only.
[[nodiscard]] std::vector<Pose> poses_of(const SceneBody& body, const LoadedBody& loaded);

/// Collects the results of filling the solids of one body with bricks, for a single report.
class FillReport {
 public:
  /// The body, which must outlive this, and its density (kg/m^3).
  FillReport(const LoadedBody& body, double density) : body_(body), density_(density) {}

  void add(const PieceReport& pieces, int slivers);
  void add(const Embedding& skin);
  /// How well the bricks represent a solid's volume. Largest solids first.
  void add_volume(const BrickGrid& grid, const Solid& solid);

  void tell(const Observer& observer) const;

 private:
  void tell_pieces(const Observer& observer) const;

  const LoadedBody& body_;
  double density_;
  int outside_ = 0;              // vertices of the skin
  double furthest_outside_ = 0;  // bricks
  int slivers_ = 0;
  PieceReport pieces_;
  int wrong_volumes_ = 0;       // solids
  std::string volume_warning_;  // of the first of them
};

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
  /// Still at the position of its grid.
  [[nodiscard]] SoftBody fill(std::size_t solid);
  [[nodiscard]] BrickGrid make_grid(const Solid& solid);
  /// Throws Error(kBadInput) if one reaches no brick.
  void check_regions() const;
  [[nodiscard]] std::vector<PinnedNodes> find_pins(const Body& body, std::size_t solid) const;
  void put(SoftBody body, const Pose& pose, int copy);

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
  std::vector<SoftBody> filled_;      // by solid
};

}  // namespace sprung
