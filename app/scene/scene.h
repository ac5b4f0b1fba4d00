#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/materials/material_library.h"
#include "app/scene/scene_body.h"
#include "app/scene/scene_render.h"

namespace sprung {

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

/// What to vary where a scene is used as an experiment; empty: as the scene has it.
struct Experiment {
  std::string title;
  std::string about;            // sentences for the report
  std::filesystem::path nodes;  // absolute; table of displacements known node by node, or empty
  std::vector<Model> models;
  std::vector<double> poisson;
  std::vector<int> bricks;  // along the longest side
};

/// How near an expectation has to be met, by these models (none: calibrated) on these grids (none: all).
struct Gate {
  std::vector<Model> models;
  std::vector<int> bricks;
  std::optional<double> tolerance;     // relative; absolute where 0 is expected; or
  std::optional<Model> no_worse_than;  // the error that this model makes on the same grid
};

/// What a quantity should be in the last frame: "tip.displacement.y", "end.torque.x", "frequency.1". Where it speaks
/// of Poisson's ratios, grids or models, for those only.
struct Expectation {
  std::string quantity;
  double value = 0;  // SI
  std::string source;
  std::vector<double> poisson;
  std::vector<int> bricks;
  std::vector<Model> models;
  std::vector<Gate> gates;
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

/// Everything a film is made from. SI units.
struct Scene {
  std::filesystem::path materials;                                        // absolute; a file of further ones, or empty
  std::shared_ptr<const MaterialLibrary> library = built_in_materials();  // with those of that file
  double duration = 3;                                                    // s
  double fps = 24;
  Vec3 gravity{0, -9.81, 0};
  std::vector<GravityKeyframe> gravity_keyframes;  // in place of gravity
  std::optional<SceneWind> wind;
  SceneSolver solver;
  SceneContact contact;
  SceneCamera camera;
  SceneRender render;
  std::vector<SceneBody> bodies;
  std::vector<SceneObstacle> obstacles;
  std::vector<SceneGlue> glue;
  std::vector<Probe> probes;
  Experiment experiment;
  std::vector<Expectation> expectations;
};

/// Whether the scene is moved through time; else its frames are states of rest or shapes.
[[nodiscard]] bool is_motion(const Scene& scene);

/// Pictures of the film: frame i (from 0) shows t = i / fps. At least 1; with load steps one more than those.
[[nodiscard]] int frame_count(const Scene& scene);

/// When a frame (from 0) is, s: in a motion frame / fps; where frames are states of rest they share the duration
/// evenly, the last of them at its end.
[[nodiscard]] double time_of(const Scene& scene, int frame);

/// How a body takes light: as it says, or as its material does.
[[nodiscard]] Look look_of(const SceneBody& body, const MaterialLibrary& library);

/// The scene with the size and the bricks of its bodies filled in where it leaves them open, and with the looks of
/// materials that are not built in.
[[nodiscard]] Scene with_defaults(Scene scene);

}  // namespace sprung
