#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/materials/material_library.h"
#include "app/scene/selection.h"
#include "core/law/brick_law.h"
#include "core/law/material.h"
#include "core/mesh/repair/repair.h"
#include "core/skin/appearance.h"
#include "core/world/keyframes.h"

namespace sprung {

inline constexpr double kDefaultSize = 0.2;  // m, longest side of a body whose scene names neither size nor scale
inline constexpr int kDefaultBricks = 24;    // along the longest side
inline constexpr std::string_view kDefaultMaterial = "gelatin";

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
  std::filesystem::path mesh;  // absolute; or
  std::optional<Vec3> box;     // m, sides of a box that is exactly as many bricks as fit in it; or
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
  Material material = built_in_materials()->find(kDefaultMaterial).material();
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

}  // namespace sprung
