#pragma once
#include "app/build_world.h"
#include "app/copies.h"
#include "app/fill_report.h"
#include "app/selector.h"

namespace sprung {

/// Adds one body of a scene to a production: its solids filled with bricks, placed, with what is held of them; as many
/// times as it has copies, all of one solid one after the other.
class BodyBuilder {
 public:
  /// Body `index` of the scene. All have to outlive it.
  BodyBuilder(const Scene& scene, std::size_t index, const LoadedBody& loaded, Production& production);

  /// ContactList nothing but this builder: those of other bodies may be filled at the same time. Throws
  /// Error(kBadInput) where a region, a pin or a cut speaks of what is not there.
  void fill_solids();

  /// What was filled, into the production.
  void add_solids();

  /// Says how well the bricks fill the body, and what is not held.
  /// Throws Error(kBadInput) where no pin holds a node.
  void tell(const Console& console) const;

 private:
  /// A solid filled with bricks, still where its grid is.
  struct Filled {
    Actor actor;
    DrawnSkin drawn;
    CarriedVertices carried;
    std::vector<int> regions;       // Origin has it
    std::vector<PinnedNodes> pins;  // their centres too
    std::vector<ForcedPart> forces;
    std::vector<MusclePart> muscles;
  };
  [[nodiscard]] Filled fill(std::size_t solid);
  [[nodiscard]] BrickGrid make_grid(const Solid& solid);
  [[nodiscard]] std::vector<PinnedNodes> find_pins(const Body& body, std::size_t solid) const;
  void put(Filled filled, const Pose& pose, int copy);

  const SceneBody& body_;
  std::size_t index_;
  const LoadedBody& loaded_;
  Production& production_;
  bool touches_itself_;
  Selector selector_;
  FillReport report_;
  int held_solids_ = 0;
  std::vector<int> solid_of_vertex_;  // of the mesh
  std::vector<Filled> filled_;        // by solid
};

}  // namespace sprung
