#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/law/brick_law.h"
#include "core/law/material.h"
#include "core/mesh/repair/repair.h"
#include "core/mesh/surface_mesh.h"
#include "core/appearance.h"
#include "core/types.h"
#include "core/world/keyframes.h"

namespace sprung {

/// In fractions of a body's bounding box.
struct Box {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Ones();
};

struct Ball {
  Vec3 centre = Vec3::Constant(0.5);  // in fractions of a body's bounding box
  double radius = 0;                  // in longest sides of it
};

/// What lies on that side of a plane to which the normal points.
struct HalfSpace {
  Vec3 point = Vec3::Constant(0.5);  // in fractions of a body's bounding box
  Vec3 normal = Vec3::UnitY();       // of any length
};

/// A part of a body, as it is at rest and before it is turned: exactly one of these.
struct Selection {
  std::optional<Box> box;
  std::optional<Ball> sphere;
  std::optional<HalfSpace> half_space;
  std::string part;              // what lies nearest to the triangles of that name in the mesh
  std::optional<Color> painted;  // what lies nearest to vertices of this colour
  std::optional<Vec3> nearest;   // the one node or brick nearest to a point in fractions of the bounding box
  std::filesystem::path mesh;    // absolute; what a mesh encloses, in the units and frame of the body's own
};

/// Whether it names no part, but means all of a body.
[[nodiscard]] bool is_whole(const Selection& selection);

inline constexpr double kDefaultSize = 0.2;  // m, longest side of a body whose scene names neither size nor scale
inline constexpr int kDefaultBricks = 24;    // along the longest side

/// How the skin rides on the bricks.
enum class SkinInterpolation {
  kBricks,  // trilinear in each brick: creases where bricks bend
  kSmooth   // smooth across bricks, see SmoothEmbedding
};

/// Directions of the world, x y z.
struct Axes {
  std::array<bool, 3> held{true, true, true};
};

/// The nodes of a part are held along some directions, and carried along those: through keyframes, or by a movement
/// that grows evenly from nothing at the start to `translate` and `rotate` at the end of the film. They turn and grow
/// about the middle of the part, then comes the shift. The directions are those of the world. Before and after its time
/// the pin leaves the nodes free.
struct Pin : Selection {
  std::string name;
  Axes axes;
  std::optional<Vec3> translate;  // m
  std::optional<Vec3> rotate;     // degrees about x, then y, then z
  std::vector<Keyframe> keyframes;
  Interpolation interpolation = Interpolation::kLinear;
  double from = 0;              // s, when it takes the nodes, where they then are
  std::optional<double> until;  // s, when it lets go; never
};

/// How strong something is at a time, times what it is at full strength.
struct Strength {
  double time = 0;  // s
  double strength = 1;
};

/// How strong something is over the film: as its keyframes say, before the first as at the first; without any, always
/// at full strength.
struct StrengthCurve {
  std::vector<Strength> keyframes;
  Interpolation interpolation = Interpolation::kLinear;
};

/// A force on a part of a body, or on all of it: one of the three.
struct BodyForce : Selection, StrengthCurve {
  std::optional<Vec3> total;       // N, shared out by volume
  std::optional<Vec3> per_volume;  // N/m^3
  std::optional<double> pressure;  // Pa, on the skin, inward
};

/// A part of a body, or all of it, that contracts along a direction and keeps its volume.
struct BodyMuscle : Selection, StrengthCurve {
  Vec3 direction = Vec3::UnitX();  // of any length, in the body before it is turned
  double contraction = 0;          // share of the length
};

/// Young's modulus and density change evenly along a line, from those of the region at one end to these at the other,
/// and stay the same before and behind it.
struct Gradient {
  Vec3 from = Vec3::Zero();  // in fractions of the bounding box
  Vec3 to = Vec3::Ones();
  Material material;
};

/// A part of a body made of another material: the bricks whose middles are in the part; with a gradient and no part the
/// whole body.
struct Region : Selection {
  Material material;
  std::optional<Gradient> gradient;
};

/// A part taken out of a box: the bricks whose middles are in it.
struct Cut : Selection {};

struct SphereShape {
  double radius = 0;  // m
};

/// Its axis is vertical.
struct CylinderShape {
  double radius = 0;  // m
  double height = 0;  // m
};

/// Lies flat.
struct TorusShape {
  double radius = 0;  // m, of the circle in the middle of the tube
  double tube = 0;    // m, radius of the tube
};

/// A body many times, in rows along the axes of the world; the first is where the body is put.
struct Copies {
  std::array<int, 3> count{1, 1, 1};
  Vec3 spacing = Vec3::Zero();  // m
  double scatter = 0;           // m; each is moved at random by up to this along each axis ...
  double turn = 0;              // degrees; ... and turned by up to this about an axis at random
  int seed = 1;
};

/// Bricks along the longest side; or (0) as fine as the thinnest part that counts asks for, see choose_brick_size().
struct BrickCount {
  int along = kDefaultBricks;
  BrickCount(int count = kDefaultBricks) : along(count) {}  // NOLINT(google-explicit-constructor): it is a number
  [[nodiscard]] bool is_auto() const { return along == 0; }
  bool operator==(const BrickCount&) const = default;
};

/// A mesh file or a built-in shape, and how it enters the scene. Every solid in a file becomes a soft body of its own.
struct SceneBody {
  std::shared_ptr<const SurfaceMesh> surface;  // a mesh in memory, in place of that in a file; or
  std::filesystem::path mesh;                  // absolute; or
  std::optional<Vec3> box;                     // m, sides of a box that is exactly as many bricks as fit in it; or
  std::optional<SphereShape> sphere;
  std::optional<CylinderShape> cylinder;
  std::optional<TorusShape> torus;
  std::filesystem::path texture;  // absolute; a picture on the whole skin, in place of what the file names
  std::vector<Cut> cuts;          // of a box
  std::optional<double> size;     // m, longest side of the bounding box; or
  std::optional<double> scale;    // m per unit of the file
  RepairMode repair = RepairMode::kAuto;
  std::optional<double> thickness;     // m; makes the mesh a shell
  Vec3 position = Vec3::Zero();        // m; where the middle of the bottom of the bounding box goes, after the rotation
  Vec3 rotation = Vec3::Zero();        // degrees about x, then y, then z, around the middle of the bounding box
  std::optional<BrickCount> bricks;    // or
  std::optional<double> brick_size;    // m
  Vec3 brick_rotation = Vec3::Zero();  // degrees, about x, then y, then z: how the bricks are turned in the body
  Material material;
  Model model = Model::kCalibrated;
  std::optional<Color> color;  // of what the file leaves without colour
  std::optional<Look> look;    // as the material has it
  SkinInterpolation skin = SkinInterpolation::kBricks;
  Vec3 velocity = Vec3::Zero();  // m/s
  Vec3 spin = Vec3::Zero();      // degrees/s about the axes of the world through the middle of the bounding box
  double friction = 0.5;         // on other bodies: the geometric mean of both
  std::optional<Copies> copies;
  std::vector<Pin> pins;
  std::vector<Region> regions;
  std::vector<BodyForce> forces;
  std::vector<BodyMuscle> muscles;
};

/// How many times the body is there.
[[nodiscard]] int copy_count(const SceneBody& body);

/// How the frames come about.
enum class Solver {
  kEuler,          // motion in time, symplectic Euler
  kVerlet,         // motion in time, velocity Verlet
  kImplicitEuler,  // motion in time by long steps, backward Euler
  kBdf2,           // the same, second order
  kAuto,           // kEuler or kBdf2, whichever is forecast to be quicker
  kStatic,         // equilibrium, the load (gravity and the pins' movements) growing from frame to frame
  kLinear,         // the same for small displacements
  kModes           // the slowest natural vibrations, one after the other
};

struct SceneSolver {
  Solver scheme = Solver::kEuler;
  std::optional<int> load_steps;  // of kStatic and kLinear, one a frame; as many as the film has time for
  int modes = 6;
  double time_limit = 24 * 3600;  // s of computing that a motion may take by its forecast
};

/// What is measured in every frame: where a point of a body goes, or what a pin does.
struct Probe {
  std::string name;
  int body = 1;               // counted from 1
  std::optional<Vec3> point;  // m, from the middle of the bounding box of the body at rest, before it is turned; or
  std::string pin;            // the name of one of the body's pins
};

struct Plane {
  double y = 0;          // m, above the obstacle's position
  Vec3 normal{0, 1, 0};  // out of the solid; any length
};

/// Along y, with round ends.
struct CapsuleShape {
  double radius = 0;  // m
  double height = 0;  // m, between the middles of the ends
};

/// Something solid that is not soft: one of the shapes, in its place, and how it moves from there.
struct SceneObstacle {
  std::optional<Plane> plane;  // the half-space behind it; or
  std::optional<Vec3> box;     // m, sides; or
  std::optional<SphereShape> sphere;
  std::optional<CapsuleShape> capsule;
  std::optional<CylinderShape> cylinder;
  std::filesystem::path mesh;    // absolute, closed
  std::optional<double> size;    // m, longest side of the mesh; or
  std::optional<double> scale;   // m per unit of the file
  Vec3 position = Vec3::Zero();  // m, of the middle
  Vec3 rotation = Vec3::Zero();  // degrees about x, then y, then z, around the middle
  std::vector<Keyframe> keyframes;
  Interpolation interpolation = Interpolation::kLinear;
  double friction = 0.5;
  double restitution = 0;
  std::optional<Color> color;
};

struct GravityKeyframe {
  double time = 0;  // s
  Vec3 gravity{0, -9.81, 0};
};

/// Air that moves past all bodies.
struct SceneWind : StrengthCurve {
  Vec3 velocity = Vec3::Zero();  // m/s
  double density = 1.2;          // kg/m^3
  double drag = 1;
};

/// Two bodies of the scene, or the copies of one, stay together where their skins are near each other at the start.
struct SceneGlue {
  std::array<int, 2> bodies{1, 2};  // counted from 1
  std::optional<double> distance;   // m; half the smaller bricks
};

/// What touches what, beside obstacles.
struct SceneContact {
  bool bodies = true;  // each other
  bool self = true;    // a body itself
};

/// What moves, what it meets and what acts on it, for how long. SI units.
struct Scene {
  double duration = 3;  // s
  double fps = 24;
  Vec3 gravity{0, -9.81, 0};
  std::vector<GravityKeyframe> gravity_keyframes;  // in place of gravity
  std::optional<SceneWind> wind;
  SceneSolver solver;
  SceneContact contact;
  std::vector<SceneBody> bodies;
  std::vector<SceneObstacle> obstacles;
  std::vector<SceneGlue> glue;
  std::vector<Probe> probes;
};

/// Whether the scene is moved through time; else its frames are states of rest or shapes.
[[nodiscard]] bool is_motion(const Scene& scene);

/// Pictures of the film: frame i (from 0) shows t = i / fps. At least 1; with load steps one more than those.
[[nodiscard]] int frame_count(const Scene& scene);

/// When a frame (from 0) is, s: in a motion frame / fps; where frames are states of rest they share the duration
/// evenly, the last of them at its end.
[[nodiscard]] double time_of(const Scene& scene, int frame);

/// A part of a scene that only a motion can have.
struct MotionOnly {
  std::string_view key;   // of the scene, where it stands ...
  std::size_t row = 0;    // ... and in which of its tables
  std::string_view what;  // "a wind"
};

/// What of a scene states of rest cannot have; modes know no forces at all.
[[nodiscard]] std::vector<MotionOnly> motion_only(const Scene& scene);

}  // namespace sprung
