#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/scene/material_library.h"
#include "app/scene/scene_render.h"
#include "core/simulation/scene.h"

namespace sprung {

inline constexpr std::string_view kDefaultMaterial = "gelatin";

/// A body that says nothing: of the default material.
[[nodiscard]] SceneBody default_body();

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

/// A scene with how it is seen, and what it is held against: all that a scene file may say.
struct Film : Scene {
  std::filesystem::path materials;                                        // absolute; a file of further ones, or empty
  std::shared_ptr<const MaterialLibrary> library = built_in_materials();  // with those of that file
  SceneCamera camera;
  SceneRender render;
  Experiment experiment;
  std::vector<Expectation> expectations;
};

/// How a body takes light: as it says, or as its material does.
[[nodiscard]] Look look_of(const SceneBody& body, const MaterialLibrary& library);

/// The film with the size and the bricks of its bodies filled in where it leaves them open, and with the looks of
/// materials that are not built in.
[[nodiscard]] Film with_defaults(Film film);
}  // namespace sprung
