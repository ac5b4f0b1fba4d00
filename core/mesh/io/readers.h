#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Returns the text of a file that another one refers to; nothing if it is missing.
using FindText = std::function<std::optional<std::string>(const std::string& name)>;

/// The mesh in the text of an OBJ file: polygons with UVs, normals and colours of vertices; a part for each object or
/// group and material; materials from the libraries it names. `name` is that of the file, for messages. Throws
/// Error(kBadInput) with the line and the number of the vertex or the face, counted from 1.
[[nodiscard]] SurfaceMesh read_obj(std::string_view text, const std::string& name, const FindText& find_text);

/// The materials of an MTL file (the material library of an OBJ): name, diffuse colour and texture name. Malformed
/// lines are skipped.
[[nodiscard]] std::vector<SurfaceMaterial> read_mtl(std::string_view text);

/// The mesh in the text of an OFF file, including the vertex attributes of COFF, NOFF and STOFF. `name` is that of the
/// file, for messages. Throws Error(kBadInput) with the line, before allocating more than the text can hold.
[[nodiscard]] SurfaceMesh read_off(std::string_view text, const std::string& name);

/// The mesh in the bytes of a PLY file, text or binary: positions, normals, UVs of vertices or of the corners of faces,
/// colours, triangle strips, and the name of a texture. Other elements and properties are skipped. `name` is that of
/// the file, for messages. Throws Error(kBadInput) naming vertex or face, before allocating more than the bytes can
/// hold.
[[nodiscard]] SurfaceMesh read_ply(std::string_view bytes, const std::string& name);

/// The mesh in the bytes of an STL file, text or binary, whatever its first word is: a binary file may begin with
/// "solid", too. Each solid of a text file becomes a part; facet colours of binary files are kept, normals are not,
/// since they are redundant. Triangles share no vertices. `name` is that of the file, for messages. Throws
/// Error(kBadInput).
[[nodiscard]] SurfaceMesh read_stl(std::string_view bytes, const std::string& name);

/// Reads a mesh by assimp without any of its post-processing, which asserts or crashes on damaged input: node
/// transforms are applied and polygons triangulated here. Every instance of a mesh becomes a part. Linear colours of
/// glTF are encoded to sRGB. Animations, skins and morph targets are left out with a note. Its memory is never freed
/// and damaged files may crash it: call it through read_in_child(). Throws Error(kBadInput), or std::bad_alloc.
[[nodiscard]] SurfaceMesh read_by_assimp(const std::filesystem::path& file);

/// Rejects a GLB file shorter than its header says, and GLB and glTF files that require an extension which assimp would
/// ignore and read a wrong shape. `bytes`: the whole file. Throws Error(kBadInput).
void check_glb(std::string_view bytes, const std::string& name);
void check_gltf(std::string_view bytes, const std::string& name);

/// Rejects a 3MF archive that is truncated or contains no model. Throws Error(kBadInput).
void check_3mf(std::string_view bytes, const std::string& name);

/// The first bytes, at most `count`, of the model in a 3MF archive; empty if there is none or it is damaged.
[[nodiscard]] std::string start_of_3mf_model(std::string_view bytes, std::size_t count);

}  // namespace sprung
