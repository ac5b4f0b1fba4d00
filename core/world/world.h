#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/body/body.h"
#include "core/bricks/embedding.h"
#include "core/appearance.h"
#include "core/skin/skin.h"
#include "core/world/loads.h"
#include "core/world/obstacle.h"

namespace sprung {

struct ContactSurface;

/// A node that is held along some axes of the world: there it moves with the velocity given, whatever pulls at it.
struct KinematicNode {
  int node = 0;
  std::array<bool, 3> axes{true, true, true};
  Vec3 velocity = Vec3::Zero();  // m/s
};

/// The nodes of a body that a pin of the scene holds.
struct PinnedNodes {
  std::size_t pin = 0;  // row in SceneBody::pins
  std::vector<int> nodes;
  Vec3 centre = Vec3::Zero();  // m, in the world: what the pin turns about
};

/// Where a force of the scene acts on a body.
struct ForcedPart {
  std::size_t force = 0;       // row in SceneBody::forces
  Eigen::VectorXd volumes;     // per node, m^3: its share of the bricks of the part
  std::vector<int> triangles;  // of a pressure: rows of SoftBody::contact_triangles
};

/// Which bricks of a body a muscle of the scene is made of.
struct MusclePart {
  std::size_t muscle = 0;  // row in SceneBody::muscles
  Muscle full;             // at full strength
};

/// Which body of the scene a soft body is made from, and how.
struct Origin {
  std::size_t body = 0;  // row in Scene::bodies
  int copy = 0;          // of the body, which one
  Mat3 bricks_from_rest = Mat3::Identity();
  std::vector<int> regions;       // per brick: row in SceneBody::regions, counted from 1; 0: of the body's own material
  std::vector<PinnedNodes> pins;  // those that hold any of its nodes
  std::vector<ForcedPart> forces;
  std::vector<MusclePart> muscles;

  /// All nodes that pins hold, ascending, each once.
  [[nodiscard]] std::vector<int> pinned_nodes() const;
};

/// A solid filled with bricks, as it moves (Body), touches, is held, is drawn, and is exported.
struct SoftBody : Body {
  Embedding contacts;                                       // points of the skin, each position once
  Triangles contact_triangles{};                            // rows of contacts; none: it touches obstacles only
  std::shared_ptr<const ContactSurface> contact_surface{};  // of the contacts as they are first used; see there
  double friction = 0.5;                                    // on another body: the geometric mean of both
  bool collides_with_itself = true;                         // not for what overlaps itself at rest
  std::vector<KinematicNode> pinned;                        // each node once; no contact can push it
  Loads loads{};

  Skin skin{};                 // what is drawn, at rest, in the frame of the bricks
  Embedding skin_embedding{};  // of its vertices
  Color color{};               // of what the skin leaves without colour
  std::vector<int>
      file_vertices{};  // of the mesh as its file has it (Simulation::meshes), those that this body carries
  Embedding file_embedding{};
  Origin origin{};

  SoftBody() = default;
  explicit SoftBody(Body body) : Body(std::move(body)) {}

  /// Vertices of the skin where the nodes are there (m x 3, m), m.
  [[nodiscard]] Points skin_positions(const Points& nodes) const;
};

struct World {
  std::vector<SoftBody> bodies;
  Vec3 gravity{0, -9.81, 0};  // m/s^2
  std::vector<Obstacle> obstacles;
  bool bodies_collide = true;  // each other
  Wind wind{};
  std::vector<GluedPoint> glue{};
};

}  // namespace sprung
