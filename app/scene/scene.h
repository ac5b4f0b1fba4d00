#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/law/brick_law.h"
#include "core/law/material.h"
#include "core/mesh/repair.h"
#include "core/types.h"
#include "core/world/keyframes.h"

namespace sprung {

inline constexpr double kDefaultSize = 0.2;  // m, longest side of a body whose scene names neither size nor scale
inline constexpr int kDefaultBricks = 24;    // along the longest side
inline constexpr std::string_view kDefaultMaterial = "gelatin";

/// sRGB, 8 bits a channel.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// A part of a body, in fractions of the bounding box it has before it is turned.
struct Box {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Ones();
};

/// Directions of the world, x y z.
struct Axes {
  std::array<bool, 3> held{true, true, true};
};

/// The nodes in the box are held along some directions, and carried along those: through keyframes, or by a movement
/// that grows evenly from nothing at the start to `translate` and `rotate` at the end of the film. They turn and grow
/// about the middle of the box, then comes the shift. The box is placed in the body at rest, the directions are those
/// of the world. Before and after its time the pin leaves the nodes free.
struct Pin {
  std::string name{};
  Box box{};
  Axes axes{};
  Vec3 translate = Vec3::Zero();  // m
  Vec3 rotate = Vec3::Zero();     // degrees about x, then y, then z
  std::vector<Keyframe> keyframes;
  Interpolation interpolation = Interpolation::kLinear;
  double from = 0;              // s, when it takes the nodes, where they then are
  std::optional<double> until;  // s, when it lets go; never
};

/// A part of a body made of another material: the bricks whose middles are in the box.
struct Region {
  Box box;
  Material material;
};

/// A part taken out of a box: the bricks whose middles are in it.
struct Cut {
  Box box;
};

/// Bricks along the longest side; or (0) as fine as the thinnest part that counts asks for, see choose_brick_size().
struct BrickCount {
  int along = kDefaultBricks;
  BrickCount(int count = kDefaultBricks) : along(count) {}  // NOLINT(google-explicit-constructor): it is a number
  [[nodiscard]] bool is_auto() const { return along == 0; }
  bool operator==(const BrickCount&) const = default;
};

/// A mesh file or a box, and how it enters the scene. Every solid in a file becomes a soft body of its own.
struct SceneBody {
  std::filesystem::path mesh;     // absolute; or
  std::filesystem::path texture;  // absolute; a picture on the whole skin, in place of what the file names
  std::optional<Vec3> box;        // m, sides of a box that is exactly as many bricks as fit in it
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
  Material material = find_material(kDefaultMaterial);
  Model model = Model::kCalibrated;
  std::optional<Color> color;    // of what the file leaves without colour
  Vec3 velocity = Vec3::Zero();  // m/s
  std::vector<Pin> pins;
  std::vector<Region> regions;
};

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
  double y = 0;  // m
};

/// Solid ground below a plane.
struct Obstacle {
  Plane plane;
  double friction = 0.5;
  double restitution = 0;
};

/// Where the film is seen from; distance and target follow from what is to be seen.
struct SceneCamera {
  double azimuth = 30;    // degrees about y; 0 looks along -z
  double elevation = 14;  // degrees above the horizon
  double orbit = 0;       // degrees that the azimuth grows over the film
};

struct SceneRender {
  std::array<int, 2> resolution{1280, 720};
  int samples = 4;
};

/// Everything a film is made from. SI units.
struct Scene {
  double duration = 3;  // s
  double fps = 24;
  Vec3 gravity{0, -9.81, 0};
  SceneSolver solver;
  SceneCamera camera;
  SceneRender render;
  std::vector<SceneBody> bodies;
  std::vector<Obstacle> obstacles;
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

/// The scene with the size and the bricks of its bodies filled in where it leaves them open.
[[nodiscard]] Scene with_defaults(Scene scene);

enum class Scenario {
  kDrop,  // falls, a little tilted, from 0.4 of its size
  kHang   // held by its top 8 %, released under gravity
};

/// What a mesh without a scene file does. The size has to be set before.
void stage_scenario(Scene& scene, Scenario scenario);

}  // namespace sprung
