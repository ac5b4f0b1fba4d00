#pragma once
#include <filesystem>
#include <string>

namespace sprung {

/// The ending of a file's name in lower case, with its dot: ".obj".
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);

/// Throws Error(kBadInput) naming file and reason where it is missing, a folder, a pipe, a device or closed to us.
void check_readable(const std::filesystem::path& file);

/// Refuses what a reader would crash, hang or stay silent on, before it sees the file: missing, a directory, empty; GLB
/// and binary STL shorter than their header says; OFF and PLY that declare more than the file can hold; PLY without an
/// end of its header; 3MF cut short or with textures; OBJ faces that refer to vertices that are not there, vertices
/// that are not finite. Throws Error(kBadInput) naming file, place and remedy.
void check_mesh_file(const std::filesystem::path& file);

}  // namespace sprung
