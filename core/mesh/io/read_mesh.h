#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Reads OBJ, PLY, STL and OFF files by our own readers, in double precision and with the location of every error, all
/// other formats by assimp. Reading runs in a child process whose limits of memory and time grow with the size of the
/// file (reader_process.h), so that no file can crash, hang or exhaust this process. Several meshes in a file become
/// parts; polygons are triangulated; textures are looked up beside the file; skins and animations are left out with a
/// note. Throws Error(kBadInput) naming the file, the reason and, where known, the location: missing, a directory,
/// empty, larger than 4 GiB, not a mesh, no faces, truncated, a non-finite coordinate, an index out of range, counts
/// that exceed the file, an unsupported feature, a crash or a timeout of the reader.
[[nodiscard]] SurfaceMesh read_mesh(const std::filesystem::path& file);

/// The same in this process, without limits and without textures: for tests of the readers. assimp may crash the
/// process. Precondition: the file passes check_readable().
[[nodiscard]] SurfaceMesh read_mesh_here(const std::filesystem::path& file);

/// The unit that the file itself gives its lengths in, as metres_in() knows it: metres for glTF by its specification,
/// what the model of a 3MF says, millimetres if it says none. Empty: the format has none, or the file is damaged.
[[nodiscard]] std::string stated_unit(const std::filesystem::path& file);

/// The text of a small file that a mesh refers to, such as a material library; nothing if it is missing or too large.
[[nodiscard]] std::optional<std::string> read_companion(const std::string& name,
                                                        const std::filesystem::path& mesh_file);

/// Loads the textures that the materials refer to, looked up under the path in the mesh, then by name beside it. One
/// that cannot be found or read is left out with a note.
void read_textures(SurfaceMesh& mesh, const std::filesystem::path& mesh_file);

}  // namespace sprung
