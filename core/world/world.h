#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/appearance.h"
#include "core/body/body.h"
#include "core/bricks/embedding.h"
#include "core/skin/skin.h"
#include "core/world/loads.h"
#include "core/world/obstacle.h"
#include "core/world/spring_support.h"

namespace sprung {

struct ContactSurface;

/// A node whose velocity is prescribed along some axes of the world.
struct KinematicNode {
  int node = 0;
  std::array<bool, 3> axes{true, true, true};
  Vec3 velocity = Vec3::Zero();  // m/s
};

/// How a body touches: points of its skin and the triangles between them.
struct ContactSkin {
  Embedding points{};                               // each position once
  Triangles triangles{};                            // rows of points; none: contact with obstacles only
  std::vector<int> beneath{};                       // by vertex of what is drawn: the triangle under it; -1, or none
  std::shared_ptr<const ContactSurface> surface{};  // of these, when first used; see there
  std::shared_ptr<const ContactSurface> outline{};  // of what is drawn, likewise
  double friction = 0.5;                            // on another body: the geometric mean of both
  bool with_itself = true;                          // not if it overlaps itself at rest
};

/// The skin with which a body is drawn.
struct BodySkin {
  Skin skin{};                                // at rest, in the frame of the bricks
  Embedding embedding{};                      // of its vertices
  std::shared_ptr<const SurfaceMesh> mesh{};  // that the skin was made of, shared by copies; none: unknown
  Color color{};                              // where the skin has no colours
};

/// A solid filled with bricks, which moves, touches and is drawn.
struct SoftBody : Body {
  std::vector<KinematicNode> pinned;  // each node once; no contact can push it
  /// Springs that hold parts of its skin, by part; none while one is released.
  std::vector<std::vector<SpringSupport>> foundations{};
  Loads loads{};
  ContactSkin contact{};
  BodySkin drawn{};

  SoftBody() = default;
  explicit SoftBody(Body body) : Body(std::move(body)) {}

  /// The skin's vertices for these node positions (m x 3, m), m.
  [[nodiscard]] Points skin_positions(const Points& nodes) const;
  /// The springs of all foundations, as they will be after `time` (s).
  [[nodiscard]] std::vector<SpringSupport> supports_after(double time) const;
};

struct World {
  std::vector<SoftBody> bodies;
  Vec3 gravity{0, -9.81, 0};  // m/s^2
  std::vector<Obstacle> obstacles;
  bool bodies_collide = true;  // with each other
  Wind wind{};
  std::vector<GluedPoint> glue{};
};

/// Moves by `time` (s) what moves by itself: obstacles, and the positions that foundations hold skin at.
void move_prescribed(World& world, double time);

}  // namespace sprung
