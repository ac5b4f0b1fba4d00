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

namespace sprung {

struct ContactSurface;

/// A node whose velocity is prescribed along some axes of the world.
struct KinematicNode {
  int node = 0;
  std::array<bool, 3> axes{true, true, true};
  Vec3 velocity = Vec3::Zero();  // m/s
};

/// The nodes of a body that a pin of the scene holds.
struct PinnedNodes {
  std::size_t pin = 0;  // row in SceneBody::pins
  std::vector<int> nodes;
  Vec3 centre = Vec3::Zero();  // m, in the world: the pin's centre of rotation
};

/// The part of a body's skin that a pin of the scene holds on the surface: one point for each triangle.
struct PinnedSkin {
  std::size_t pin = 0;  // row in SceneBody::pins
  Embedding points{};
  Eigen::VectorXd areas{};     // m^2, for which the points stand
  Vec3 centre = Vec3::Zero();  // m, in the world: the pin's centre of rotation
};

/// Where a force of the scene acts on a body.
struct ForcedPart {
  std::size_t force = 0;                   // row in SceneBody::forces
  Eigen::VectorXd shares{};                // per node: of the volume of the part, m^3, or of the area of its skin, m^2
  Points arms{};                           // m x 3, m^3: of the area times positions; 0 rows: not of an area
  Mat3 second = Mat3::Zero();              // m^4: position position^T over the area
  std::shared_ptr<const SkinPart> skin{};  // of a pressure, instead of these
};

/// The bricks of a body that form a muscle of the scene.
struct MusclePart {
  std::size_t muscle = 0;  // row in SceneBody::muscles
  Muscle full;             // at full strength
};

/// The part of a body that a probe of the scene measures.
struct ProbedPart {
  std::size_t probe = 0;         // row in Scene::probes
  std::vector<int> bricks;       // ascending
  std::vector<int> skin_points;  // vertices of the skin that these bricks carry, ascending
};

/// The body of the scene from which a soft body was made.
struct Origin {
  std::size_t body = 0;  // row in Scene::bodies
  int copy = 0;          // index of the copy
  Mat3 bricks_from_rest = Mat3::Identity();
  std::vector<int> regions;       // per brick: row in SceneBody::regions, counted from 1; 0: of the body's own material
  std::vector<PinnedNodes> pins;  // those that hold any of its nodes
  std::vector<PinnedSkin> pinned_skins;
  std::vector<ForcedPart> forces;
  std::vector<MusclePart> muscles;
  std::vector<ProbedPart> probed;  // those that have any of its bricks

  /// All nodes that pins hold, ascending, each once.
  [[nodiscard]] std::vector<int> pinned_nodes() const;
};

/// A solid filled with bricks: its mechanics (Body), contacts, pins, loads, drawing and export.
struct SoftBody : Body {
  Embedding contacts;                                       // points of the skin, each position once
  Triangles contact_triangles{};                            // rows of contacts; none: contact with obstacles only
  std::shared_ptr<const ContactSurface> contact_surface{};  // of the contacts when first used; see there
  double friction = 0.5;                                    // on another body: the geometric mean of both
  bool collides_with_itself = true;                         // not if it overlaps itself at rest
  std::vector<KinematicNode> pinned;                        // each node once; no contact can push it
  Loads loads{};

  Skin skin{};                                   // what is drawn, at rest, in the frame of the bricks
  Embedding skin_embedding{};                    // of its vertices
  std::shared_ptr<const SurfaceMesh> surface{};  // that the skin was made of, shared by copies; none: unknown
  Color color{};                                 // where the skin has no colours
  std::vector<int> file_vertices{};  // of the mesh in its file (Simulation::meshes), those embedded in this body
  Embedding file_embedding{};
  Origin origin{};

  SoftBody() = default;
  explicit SoftBody(Body body) : Body(std::move(body)) {}

  /// The skin's vertices for these node positions (m x 3, m), m.
  [[nodiscard]] Points skin_positions(const Points& nodes) const;
};

struct World {
  std::vector<SoftBody> bodies;
  Vec3 gravity{0, -9.81, 0};  // m/s^2
  std::vector<Obstacle> obstacles;
  bool bodies_collide = true;     // with each other
  bool guards_crossings = false;  // see CrossingGuard
  Wind wind{};
  std::vector<GluedPoint> glue{};
};

}  // namespace sprung
