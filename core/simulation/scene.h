#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/appearance.h"
#include "core/body/stress.h"
#include "core/law/brick_law.h"
#include "core/law/material.h"
#include "core/mesh/repair/repair.h"
#include "core/mesh/surface_mesh.h"
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

/// The side of a plane to which the normal points.
struct HalfSpace {
  Vec3 point = Vec3::Constant(0.5);  // in fractions of a body's bounding box
  Vec3 normal = Vec3::UnitY();       // of any length
};

/// A part of a body at rest, before its rotation: exactly one of these.
struct Selection {
  std::optional<Box> box;
  std::optional<Ball> sphere;
  std::optional<HalfSpace> half_space;
  std::string part;              // the points nearest to the mesh's triangles of that name
  std::optional<Color> painted;  // the points nearest to vertices of this colour
  std::optional<Vec3> face;      // the points nearest to one face of the mesh: that nearest to a point in fractions of
                                 // the bounding box, as far as it is flat, else up to its sharp edges
  std::optional<Vec3> nearest;   // the one node or brick nearest to a point in fractions of the bounding box
  std::filesystem::path mesh;    // absolute; the inside of a mesh, in the units and frame of the body's mesh
};

/// Returns whether it selects the whole body.
[[nodiscard]] bool is_whole(const Selection& selection);

inline constexpr double kDefaultSize = 0.2;  // m, longest side of a body whose scene names neither size nor scale
inline constexpr int kDefaultBricks = 24;    // along the longest side

/// How the skin follows the bricks.
enum class SkinInterpolation {
  kBricks,  // trilinear in each brick: creases where bricks bend
  kSmooth   // smooth across bricks, see SmoothEmbedding
};

/// Axes of the world.
struct Axes {
  std::array<bool, 3> fixed{true, true, true};
};

/// Holds the nodes of a part along some axes of the world and moves them along these: through keyframes, or linearly in
/// time from zero at the start to `translate` and `rotate` at the end of the film. Rotation and scaling about the
/// centre of the part come before the translation. Outside its time interval the pin leaves the nodes free.
///
/// On the surface a pin holds the skin of the part, wherever the bricks lie, by a stiff foundation (PinnedSkin).
struct Pin : Selection {
  std::string name;
  Axes axes;
  bool on_surface = false;
  std::optional<Vec3> normal;     // of a plane along which the skin slides: held along the normal only
  std::optional<Vec3> translate;  // m
  std::optional<Vec3> rotate;     // degrees about x, then y, then z
  std::vector<Keyframe> keyframes;
  Interpolation interpolation = Interpolation::kLinear;
  double from = 0;              // s; the nodes are caught where they are then
  std::optional<double> until;  // s; none: never released
};

/// The strength of a load at a time, relative to full strength.
struct Strength {
  double time = 0;  // s
  double strength = 1;
};

/// The strength of a load over the film, by keyframes; constant before the first one, and always full without any.
struct StrengthCurve {
  std::vector<Strength> keyframes;
  Interpolation interpolation = Interpolation::kLinear;
};

/// A force on a body or a part of it: one of total, per_volume, traction, moment and pressure. All but pressure keep
/// their directions.
struct BodyForce : Selection, StrengthCurve {
  std::optional<Vec3> total;       // N, distributed by volume, or ...
  bool on_surface = false;         // ... by area of the skin; that of flat boxes always is
  std::optional<Vec3> per_volume;  // N/m^3
  std::optional<Vec3> traction;    // Pa, on the skin
  std::optional<Vec3> moment;      // N m, by tractions on the skin that grow with the distance from its centroid
  std::optional<double> pressure;  // Pa, on the skin, inward
};

/// A body or a part of it that contracts along a direction at constant volume.
struct BodyMuscle : Selection, StrengthCurve {
  Vec3 direction = Vec3::UnitX();  // of any length, in the body before its rotation
  double contraction = 0;          // fraction of the length
};

/// Young's modulus and density vary linearly along a line, from those of the region at one end to these at the other,
/// and are constant beyond both ends.
struct Gradient {
  Vec3 from = Vec3::Zero();  // in fractions of the bounding box
  Vec3 to = Vec3::Ones();
  Material material;
};

/// A part of a body made of another material: the bricks with centres in the part; with a gradient and no part the
/// whole body.
struct Region : Selection {
  Material material;
  std::optional<Gradient> gradient;
};

/// A part cut out of a box: the bricks with centres in it.
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
  double radius = 0;  // m, of the tube's centre line
  double tube = 0;    // m, radius of the tube
};

/// Copies of a body, in rows along the axes of the world; the first is at the body's position.
struct Copies {
  std::array<int, 3> count{1, 1, 1};
  Vec3 spacing = Vec3::Zero();  // m
  double scatter = 0;           // m; each is displaced at random by up to this along each axis ...
  double turn = 0;              // degrees; ... and rotated by up to this about a random axis
  int seed = 1;
};

/// Bricks along the longest side; 0: chosen by the thinnest relevant part, see choose_brick_size().
struct BrickCount {
  int along = kDefaultBricks;
  BrickCount(int count = kDefaultBricks) : along(count) {}  // NOLINT(google-explicit-constructor): it is a number
  [[nodiscard]] bool is_auto() const { return along == 0; }
  bool operator==(const BrickCount&) const = default;
};

/// A mesh file or a built-in shape, and how it enters the scene. Every solid in a file becomes a soft body of its own.
struct SceneBody {
  std::shared_ptr<const SurfaceMesh> surface;  // a mesh in memory, instead of that in a file; or
  std::filesystem::path mesh;                  // absolute; or
  std::optional<Vec3> box;                     // m, sides of a box, each a whole number of bricks; or
  std::optional<SphereShape> sphere;
  std::optional<CylinderShape> cylinder;
  std::optional<TorusShape> torus;
  std::filesystem::path texture;  // absolute; an image for the whole skin, instead of the file's
  std::vector<Cut> cuts;          // of a box
  std::optional<double> size;     // m, longest side of the bounding box; or
  std::optional<double> scale;    // m per unit of the file
  RepairMode repair = RepairMode::kAuto;
  std::optional<double> thickness;     // m; makes the mesh a shell
  Vec3 position = Vec3::Zero();        // m, of the bottom centre of the bounding box after the rotation
  Vec3 rotation = Vec3::Zero();        // degrees about x, then y, then z, around the centre of the bounding box
  std::optional<BrickCount> bricks;    // or
  std::optional<double> brick_size;    // m
  Vec3 brick_rotation = Vec3::Zero();  // degrees about x, then y, then z: of the bricks in the body
  Material material;
  Model model = Model::kCalibrated;
  std::optional<Color> color;  // where the file has no colours
  std::optional<Look> look;    // none: of the material
  SkinInterpolation skin = SkinInterpolation::kBricks;
  Vec3 velocity = Vec3::Zero();  // m/s
  Vec3 spin = Vec3::Zero();      // degrees/s about the axes of the world through the centre of the bounding box
  double friction = 0.5;         // on other bodies: the geometric mean of both
  std::optional<Copies> copies;
  std::vector<Pin> pins;
  std::vector<Region> regions;
  std::vector<BodyForce> forces;
  std::vector<BodyMuscle> muscles;
};

/// The number of copies of the body, itself included.
[[nodiscard]] int copy_count(const SceneBody& body);

/// How the frames are computed.
enum class Solver {
  kEuler,          // motion in time, symplectic Euler
  kVerlet,         // motion in time, velocity Verlet
  kImplicitEuler,  // motion in time, backward Euler with long steps
  kBdf2,           // the same, second order
  kAuto,           // kEuler or kBdf2, whichever is expected to be faster
  kStatic,         // equilibrium, with the load (gravity and pin movements) growing from frame to frame
  kLinear,         // the same for small displacements
  kModes           // the slowest natural vibrations, one after the other
};

struct SceneSolver {
  Solver scheme = Solver::kEuler;
  std::optional<int> load_steps;  // of kStatic and kLinear, one per frame; none: as many as the film has time for
  int modes = 6;
  double time_limit = 24 * 3600;  // s of computing time that a motion may be forecast to take
};

/// The object of a measurement: a point of a body, one of its pins, or a part of it.
enum class ProbeKind { kPoint, kPin, kPart };

/// Quantities recorded in every frame: of a point of a body, of a pin, or of a part of a body, else of all of it.
struct Probe {
  std::string name;
  int body = 1;               // counted from 1
  std::optional<Vec3> point;  // m, from the centre of the bounding box of the unrotated body at rest; or
  std::string pin;            // the name of one of the body's pins; or
  Selection selection;

  [[nodiscard]] ProbeKind kind() const {
    if (point) return ProbeKind::kPoint;
    return pin.empty() ? ProbeKind::kPart : ProbeKind::kPin;
  }
};

struct Plane {
  double y = 0;          // m, above the obstacle's position
  Vec3 normal{0, 1, 0};  // out of the solid; any length
};

/// Along y, with round ends.
struct CapsuleShape {
  double radius = 0;  // m
  double height = 0;  // m, between the centres of the ends
};

/// A rigid obstacle: one of the shapes, its placement and its keyframes.
struct SceneObstacle {
  std::optional<Plane> plane;  // the half-space behind it; or
  std::optional<Vec3> box;     // m, sides; or
  std::optional<SphereShape> sphere;
  std::optional<CapsuleShape> capsule;
  std::optional<CylinderShape> cylinder;
  std::filesystem::path mesh;    // absolute, closed
  std::optional<double> size;    // m, longest side of the mesh; or
  std::optional<double> scale;   // m per unit of the file
  Vec3 position = Vec3::Zero();  // m, of the centre
  Vec3 rotation = Vec3::Zero();  // degrees about x, then y, then z, around the centre
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

/// Uniform wind on all bodies.
struct SceneWind : StrengthCurve {
  Vec3 velocity = Vec3::Zero();  // m/s
  double density = 1.2;          // kg/m^3
  double drag = 1;
};

/// Two bodies of the scene, or the copies of one, are glued where their skins are near each other at the start.
struct SceneGlue {
  std::array<int, 2> bodies{1, 2};  // counted from 1
  std::optional<double> distance;   // m; none: half the smaller brick size
};

/// Which contacts are handled besides those with obstacles.
struct SceneContact {
  bool bodies = true;  // between bodies
  bool self = true;    // of a body with itself
};

/// The bodies, obstacles, loads and duration of a simulation. SI units.
struct Scene {
  double duration = 3;                // s
  std::optional<double> until_still;  // s: from then on a motion ends before that, once it has come to rest
  double fps = 24;
  Vec3 gravity{0, -9.81, 0};
  std::vector<GravityKeyframe> gravity_keyframes;  // instead of gravity
  std::optional<SceneWind> wind;
  SceneSolver solver;
  SceneContact contact;
  std::vector<SceneBody> bodies;
  std::vector<SceneObstacle> obstacles;
  std::vector<SceneGlue> glue;
  std::vector<Probe> probes;
};

/// Returns whether the frames are a motion in time; else they are equilibria or vibration modes.
[[nodiscard]] bool is_motion(const Scene& scene);
/// What the bricks of a body are made of: with the ratio of motions in these.
[[nodiscard]] Material simulated_material(const Scene& scene, const SceneBody& body);

/// The strain measure of the results: displacements of linear statics and of modes are small.
[[nodiscard]] StrainMeasure strain_measure(const Scene& scene);

/// The number of frames of the film: frame i (from 0) is at t = i / fps. At least 1; one more than the load steps.
[[nodiscard]] int frame_count(const Scene& scene);

/// The time of a frame (from 0), s: frame / fps in a motion; otherwise frames are spaced evenly over the duration, the
/// last one at its end.
[[nodiscard]] double time_of(const Scene& scene, int frame);

/// A part of a scene that only a motion supports.
struct MotionOnly {
  std::string_view key;   // of the scene file ...
  std::size_t row = 0;    // ... and the row of its table
  std::string_view what;  // "a wind"
};

/// The parts of a scene that equilibria do not support; modes support no forces at all.
[[nodiscard]] std::vector<MotionOnly> motion_only(const Scene& scene);

}  // namespace sprung
