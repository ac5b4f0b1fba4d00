#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/scenarios.h"
#include "core/simulation/observer.h"

namespace sprung {

/// One option that stands for a key of the scene, as it was typed.
struct Setting {
  std::string option;  // "--young"
  std::string key;     // "body.material.young"
  std::string value;
};

/// Sets the key of the scene. Throws Error(kUsage) naming the option.
void apply(const Setting& setting, Film& film);

/// The vertical axis that files of this kind usually have: z for STL, 3MF and BLEND, else y.
[[nodiscard]] UpAxis usual_up(const std::filesystem::path& mesh);

struct SceneRequest;

/// A scene of one body, its mesh oriented as in its file, with the settings and the materials they name. Throws as
/// make_scene() does.
[[nodiscard]] Film make_part_scene(const SceneRequest& request);

/// The direction from which the camera looks.
struct CameraDirection {
  double azimuth = 0;               // degrees
  std::optional<double> elevation;  // degrees; none: as the scene has it
};

/// The scene that a mesh file or a scene file and options mean.
struct SceneRequest {
  std::string input;
  std::vector<Setting> settings{};
  std::vector<Setting> defaults{};        // for what neither the settings nor a scene file state
  std::optional<Scenario> scenario{};     // of a bare mesh
  std::optional<UpAxis> up{};             // of a bare mesh; none: z for STL, 3MF and BLEND, else y
  std::optional<CameraDirection> view{};  // from where the camera looks
};

/// In order of priority: options, scene file, the request's defaults, those of all scenes. Throws Error(kUsage) naming
/// the option whose value is wrong, Error(kBadInput) for what is wrong in the scene file or the mesh and for an unknown
/// material. Bodies for which no material is named get the softest elastomer in which they keep their shape, and a bare
/// mesh that is dropped and would tip over is laid down; both are reported to the observer.
[[nodiscard]] Film make_scene(const SceneRequest& request, const Observer& observer = {});

}  // namespace sprung
