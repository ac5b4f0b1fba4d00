#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "app/scene/film.h"

namespace sprung {

/// True if the file's name ends in .toml.
[[nodiscard]] bool is_scene_file(const std::filesystem::path& file);

/// The scene in a TOML file. Throws one Error(kBadInput) with a line "file:line:column: key: what is wrong" for every
/// mistake in it. `library`: the materials known by name, in addition to those of a file that the scene itself names.
[[nodiscard]] Film read_scene(const std::filesystem::path& file,
                              const MaterialLibrary& library = *built_in_materials());

/// Says whether the files that a scene names have to exist.
enum class SceneFiles { kPresent, kAnywhere };

/// The same for text read from (or standing for) a file; mesh paths are relative to the file's folder.
[[nodiscard]] Film parse_scene(std::string_view text, const std::filesystem::path& file,
                               SceneFiles files = SceneFiles::kPresent,
                               const MaterialLibrary& library = *built_in_materials());

/// The scene as TOML in SI units that parses to the same scene. A built-in material is written by its name.
[[nodiscard]] std::string print_scene(const Film& film);

/// Sets one key by its path and the words for its value: "render.resolution", "1280x720". Below "body" the key of
/// every body is set; "body.material.young" makes the material a custom one. Of two keys that exclude each other the
/// one set here stays. Throws Error(kBadInput).
/// If the last key of the path, or one that excludes it, `is_given`, the scene is left unchanged.
using KeyIsGiven = std::function<bool(std::string_view key)>;
void set_scene_key(Film& film, std::string_view path, std::string_view text, const KeyIsGiven& is_given = {});

/// The same for a scene as read from that file, if the file states neither the key nor one that excludes it; decided
/// for each body separately.
void set_if_unset(Film& film, const std::filesystem::path& file, std::string_view path, std::string_view text);

}  // namespace sprung
