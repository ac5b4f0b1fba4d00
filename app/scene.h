#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/law/brick_law.h"
#include "core/law/material.h"
#include "core/motion/integrator.h"
#include "core/types.h"

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

/// The nodes in the box are held where they start.
struct Pin {
  Box box;
};

/// A mesh file and how it enters the scene. Every solid in the file becomes a soft body of its own.
struct SceneBody {
  std::filesystem::path mesh;        // absolute
  std::optional<double> size;        // m, longest side of the bounding box; or
  std::optional<double> scale;       // m per unit of the file
  Vec3 position = Vec3::Zero();      // m; where the middle of the bottom of the bounding box goes, after the rotation
  Vec3 rotation = Vec3::Zero();      // degrees about x, then y, then z, around the middle of the bounding box
  std::optional<int> bricks;         // along the longest side; or
  std::optional<double> brick_size;  // m
  Material material = find_material(kDefaultMaterial);
  Model model = Model::kCalibrated;
  std::optional<Color> color;    // of what the file leaves without colour
  Vec3 velocity = Vec3::Zero();  // m/s
  std::vector<Pin> pins;
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
  Scheme scheme = Scheme::kSymplecticEuler;
  SceneCamera camera;
  SceneRender render;
  std::vector<SceneBody> bodies;
  std::vector<Obstacle> obstacles;
};

/// Pictures of the film: frame i (from 0) shows t = i / fps. At least 1.
[[nodiscard]] int frame_count(const Scene& scene);

/// The scene with the size and the bricks of its bodies filled in where it leaves them open.
[[nodiscard]] Scene with_defaults(Scene scene);

enum class Scenario {
  kDrop,  // falls, a little tilted, from 0.4 of its size
  kHang   // held by its top 8 %, released under gravity
};

/// What a mesh without a scene file does. The size has to be set before.
void stage_scenario(Scene& scene, Scenario scenario);

}  // namespace sprung
