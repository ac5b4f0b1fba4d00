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

/// A body of kAutoMaterial.
[[nodiscard]] SceneBody default_body();

/// The parameters that an experiment varies; empty members stay as in the scene.
struct Experiment {
  std::string title;
  std::string about;            // sentences for the report
  std::filesystem::path nodes;  // absolute; table of displacements known node by node, or empty
  std::vector<Model> models;
  std::vector<double> poisson;
  std::vector<int> bricks;  // along the longest side
};

/// The accuracy with which these models (none: calibrated) have to meet an expectation on these grids (none: all).
struct Gate {
  std::vector<Model> models;
  std::vector<int> bricks;
  std::optional<double> tolerance;     // relative; absolute if 0 is expected; or
  std::optional<Model> no_worse_than;  // the error that this model makes on the same grid
};

/// The expected value of a quantity in the last frame: "tip.displacement.y", "end.torque.x", "frequency.1". If it lists
/// Poisson's ratios, grids or models, it holds for those only.
struct Expectation {
  std::string quantity;
  double value = 0;  // SI
  std::string source;
  std::vector<double> poisson;
  std::vector<int> bricks;
  std::vector<Model> models;
  std::vector<Gate> gates;
};

/// Everything that a scene file may say: the scene, how it is drawn, and what its results are compared with.
struct Film : Scene {
  std::filesystem::path materials;                                        // absolute; a file of further ones, or empty
  std::shared_ptr<const MaterialLibrary> library = built_in_materials();  // with those of that file
  SceneCamera camera;
  SceneRender render;
  Experiment experiment;
  std::vector<Expectation> expectations;
};

/// The look of a body: its own, or that of its material.
[[nodiscard]] Look look_of(const SceneBody& body, const MaterialLibrary& library);

/// The colour of a body whose mesh file gives none: its own, or that of its material; none if neither has one.
[[nodiscard]] std::optional<Color> color_of(const SceneBody& body, const MaterialLibrary& library);

/// Mean free path of light inside the body, m; 0: no light enters. That of its material, or of gelatin if the body is
/// to look like it.
[[nodiscard]] double mean_free_path_of(const SceneBody& body, const MaterialLibrary& library);

/// The film with the size, the bricks and the material of its bodies filled in where it leaves them open, and with the
/// looks and colours of materials that are not built in.
[[nodiscard]] Film with_defaults(Film film);
}  // namespace sprung
