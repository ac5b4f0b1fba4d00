#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Reads any mesh format that assimp knows, but OBJ, PLY, STL and OFF by readers of our own: in double precision, with
/// the place of every fault, and right where assimp is not. It does so in a child process with limits of memory and
/// time that grow with the size of the file (core/mesh/read/reading_child.h): no file can crash, hang or fill up this
/// one. Several meshes in a file become parts; polygons are cut into triangles; textures are looked for beside the
/// file; skins and animations are left out with a note. Throws Error(kBadInput) naming file, reason and, where known,
/// the place in it: missing, a directory, empty, larger than 4 GiB, not a mesh, no faces, cut short, a coordinate that
/// is not finite, an index out of range, counts that the file cannot hold, a feature that is not supported, a crash or
/// too long a time of the reader.
[[nodiscard]] SurfaceMesh read_mesh(const std::filesystem::path& file);

/// The same in this process, without limits and without textures: for tests of the readers. assimp may take the process
/// down. Precondition: check_readable.
[[nodiscard]] SurfaceMesh read_mesh_here(const std::filesystem::path& file);

/// The text of a small file that a mesh names, as a material library; nothing where it is not there, or too large.
[[nodiscard]] std::optional<std::string> read_companion(const std::string& name,
                                                        const std::filesystem::path& mesh_file);

/// Reads the pictures that the materials name and do not hold. They are looked for where the mesh says, then by name
/// beside it. One that cannot be found or read is left out with a note.
void read_textures(SurfaceMesh& mesh, const std::filesystem::path& mesh_file);

}  // namespace sprung
