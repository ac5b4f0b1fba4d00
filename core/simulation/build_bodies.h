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

/// `grid` are the bricks of one solid of the mesh (m). The body is at rest where its grid is, and touches by its skin,
/// as finely as its bricks can follow. Deterministic.
[[nodiscard]] SoftBody make_soft_body(const SurfaceMesh& mesh, const Solid& solid, BrickGrid grid, Model model,
                                      const Material& material);

/// Where the forces of a body of the scene act on one of its solids, which is still where its grid is: those that act
/// there at all. Throws Error(kBadInput) where a part speaks of what is not there.
[[nodiscard]] std::vector<ForcedPart> place_forces(const std::vector<BodyForce>& forces, const Selector& selector,
                                                   const SoftBody& actor, std::size_t solid);

/// The same of its muscles. `bricks_from_rest`: how the body was turned so that its bricks are straight.
[[nodiscard]] std::vector<MusclePart> place_muscles(const std::vector<BodyMuscle>& muscles, const Selector& selector,
                                                    const SoftBody& actor, std::size_t solid,
                                                    const Mat3& bricks_from_rest);

/// Throws Error(kBadInput) where a force or a muscle of a body of the scene acts on none of its bodies.
void check_loads(const Scene& scene, std::size_t body, const World& world);

/// Where a body and its copies are (from a body at rest, turned as its bricks are, the middle of its bounding box at
/// the origin), x first, then y, then z. What is random in it depends on its seed only.
[[nodiscard]] std::vector<Pose> poses_of(const SceneBody& body, const LoadedBody& loaded);

/// Gathers what came of filling the solids of one body with bricks, to tell it at once.
class FillReport {
 public:
  /// The body and its density (kg/m^3). It has to outlive this.
  FillReport(const LoadedBody& body, double density) : body_(body), density_(density) {}

  void add(const PieceReport& pieces, int slivers);
  void add(const Embedding& skin);
  /// How well bricks hold a solid's volume. Largest solids first.
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

/// Adds one body of a scene to a simulation: its solids filled with bricks, placed, with what is held of them; as many
/// times as it has copies, all of one solid one after the other.
class BodyBuilder {
 public:
  /// Body `index` of the scene. All have to outlive it.
  BodyBuilder(const Scene& scene, std::size_t index, const LoadedBody& loaded, Simulation& simulation);

  /// Touches nothing but this builder: those of other bodies may be filled at the same time. Throws
  /// Error(kBadInput) where a region, a pin or a cut speaks of what is not there.
  void fill_solids();

  /// What was filled, into the simulation.
  void add_solids();

  /// Says how well the bricks fill the body, and what is not held.
  /// Throws Error(kBadInput) where no pin holds a node.
  void tell(const Observer& observer) const;

 private:
  /// Still where its grid is.
  [[nodiscard]] SoftBody fill(std::size_t solid);
  [[nodiscard]] BrickGrid make_grid(const Solid& solid);
  [[nodiscard]] std::vector<PinnedNodes> find_pins(const Body& body, std::size_t solid) const;
  void put(SoftBody body, const Pose& pose, int copy);

  const SceneBody& body_;
  std::size_t index_;
  const LoadedBody& loaded_;
  Simulation& simulation_;
  bool collides_with_itself_;
  Selector selector_;
  FillReport report_;
  int held_solids_ = 0;
  std::vector<int> solid_of_vertex_;  // of the mesh
  std::vector<SoftBody> filled_;      // by solid
};

}  // namespace sprung
