#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "core/appearance.h"
#include "core/error.h"
#include "core/files.h"
#include "core/mesh/io/polygon_soup.h"
#include "core/mesh/io/readers.h"
#include "core/text.h"

namespace sprung {
namespace {

/// Raw texels as an uncompressed TGA, whose BGRA order from the top left is that of aiTexel.
std::vector<std::byte> encode_tga(const aiTexture& texture) {
  if (texture.mWidth > 0xFFFF || texture.mHeight > 0xFFFF) return {};
  constexpr std::size_t kHeader = 18;
  const std::size_t size = std::size_t{4} * texture.mWidth * texture.mHeight;
  std::vector<std::byte> bytes(kHeader + size);
  bytes[2] = std::byte{2};
  bytes[12] = static_cast<std::byte>(texture.mWidth & 0xFF);
  bytes[13] = static_cast<std::byte>(texture.mWidth >> 8);
  bytes[14] = static_cast<std::byte>(texture.mHeight & 0xFF);
  bytes[15] = static_cast<std::byte>(texture.mHeight >> 8);
  bytes[16] = std::byte{32};
  bytes[17] = std::byte{0x28};  // 8 bits of alpha, rows from the top
  std::memcpy(&bytes[kHeader], texture.pcData, size);
  return bytes;
}

std::vector<std::byte> embedded_bytes(const aiTexture& texture) {
  if (texture.pcData == nullptr) return {};
  if (texture.mHeight > 0) return encode_tga(texture);
  const auto* bytes = reinterpret_cast<const std::byte*>(texture.pcData);
  return {bytes, bytes + texture.mWidth};
}

std::string texture_path(const aiMaterial& material) {
  aiString path;
  if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &path) != AI_SUCCESS &&
      material.GetTexture(aiTextureType_DIFFUSE, 0, &path) != AI_SUCCESS) {
    return {};
  }
  return path.C_Str();
}

void read_texture(const aiScene& scene, const std::string& path, SurfaceMaterial& material,
                  std::vector<std::string>& notes) {
  material.texture_name = path;
  const aiTexture* embedded = scene.GetEmbeddedTexture(path.c_str());
  if (embedded == nullptr) return;
  material.texture = embedded_bytes(*embedded);
  if (!material.texture.empty()) {
    if (embedded->mFilename.length > 0) material.texture_name = embedded->mFilename.C_Str();
    return;
  }
  notes.push_back(fmt::format("the texture '{}' in the file cannot be read; drawn without it", path));
  material.texture_name.clear();
}

Eigen::Vector4f base_color(const aiMaterial& material, bool linear) {
  aiColor4D given;
  if (material.Get(AI_MATKEY_BASE_COLOR, given) != AI_SUCCESS &&
      material.Get(AI_MATKEY_COLOR_DIFFUSE, given) != AI_SUCCESS) {
    return SurfaceMaterial{}.color;
  }
  Eigen::Vector4f color(given.r, given.g, given.b, given.a);
  if (!color.allFinite()) return SurfaceMaterial{}.color;
  color = color.cwiseMax(0.0F).cwiseMin(1.0F);
  if (linear) color.head<3>() = color.head<3>().unaryExpr(&srgb_from_linear).eval();
  return color;
}

/// The materials of a scene, with the bytes of embedded textures and the names of external ones. An embedded texture
/// that cannot be read is left out with a note.
std::vector<SurfaceMaterial> read_materials(const aiScene& scene, bool is_gltf, std::vector<std::string>& notes) {
  std::vector<SurfaceMaterial> materials;
  for (unsigned m = 0; m < scene.mNumMaterials; ++m) {
    const aiMaterial& given = *scene.mMaterials[m];
    SurfaceMaterial& material = materials.emplace_back();
    material.name = given.GetName().C_Str();
    material.color = base_color(given, is_gltf);
    if (const std::string path = texture_path(given); !path.empty()) {
      read_texture(scene, path, material, notes);
    }
  }
  return materials;
}

/// Whether the material is one that assimp made up because the file has none.
bool is_placeholder(const aiScene& scene, unsigned material, bool is_gltf) {
  if (material >= scene.mNumMaterials) return true;
  const aiMaterial& given = *scene.mMaterials[material];
  if (!texture_path(given).empty()) return false;
  const std::string name = given.GetName().C_Str();
  // The glTF reader appends its default material without a name; others may lack a name, too.
  if (name.empty())
    return is_gltf ? material + 1 == scene.mNumMaterials : base_color(given, false).head<3>().minCoeff() == 1;
  return name == AI_DEFAULT_MATERIAL_NAME;
}

using Transform = Eigen::Matrix4d;

/// A mesh as placed by a node.
struct Instance {
  const aiMesh* mesh;
  Transform world_from_mesh;
  std::string name;
  int material = -1;
};

Transform matrix_of(const aiMatrix4x4& m) {
  Transform matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return matrix;
}

void collect_instances(const aiScene& scene, const aiNode& node, const Transform& world_from_parent,
                       std::vector<Instance>& instances) {
  const Transform world_from_node = world_from_parent * matrix_of(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const unsigned index = node.mMeshes[i];
    if (index >= scene.mNumMeshes) continue;
    const aiMesh* mesh = scene.mMeshes[index];
    const std::string name = node.mName.length > 0 ? node.mName.C_Str() : mesh->mName.C_Str();
    instances.push_back({.mesh = mesh, .world_from_mesh = world_from_node, .name = name});
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    collect_instances(scene, *node.mChildren[i], world_from_node, instances);
  }
}

/// Concatenates the instances in one SurfaceMesh.
class MeshBuilder {
 public:
  MeshBuilder(const std::vector<Instance>& instances, bool linear_colors, const std::string& name)
      : linear_colors_(linear_colors), name_(name) {
    std::size_t vertices = 0;
    bool normals = false;
    bool uvs = false;
    bool colors = false;
    for (const Instance& instance : instances) {
      vertices += instance.mesh->mNumVertices;
      normals = normals || instance.mesh->HasNormals();
      uvs = uvs || instance.mesh->HasTextureCoords(0);
      colors = colors || instance.mesh->HasVertexColors(0);
    }
    if (vertices > std::size_t{std::numeric_limits<int>::max()}) refuse("more than 2^31 vertices; simplify the mesh");
    const int n = int(vertices);
    mesh_.positions.setZero(n, 3);
    // Where only some meshes have an attribute, the others get a neutral value: no normal, no offset, white.
    if (normals) mesh_.normals.setZero(n, 3);
    if (uvs) mesh_.uvs.setZero(n, 2);
    if (colors) mesh_.colors.setOnes(n, 4);
  }

  void add(const Instance& instance) {
    add_positions(instance);
    if (instance.mesh->HasNormals()) add_normals(instance);
    if (instance.mesh->HasTextureCoords(0)) add_uvs(*instance.mesh);
    if (instance.mesh->HasVertexColors(0)) add_colors(*instance.mesh);
    const auto first = isize(triangles_);
    add_faces(instance);
    const auto count = isize(triangles_) - first;
    if (count > 0) mesh_.parts.push_back({instance.name, first, count, instance.material});
    first_vertex_ += int(instance.mesh->mNumVertices);
  }

  SurfaceMesh finish() {
    mesh_.triangles.resize(isize(triangles_), 3);
    for (int t = 0; t < mesh_.triangles.rows(); ++t) {
      const auto& corners = triangles_[t];
      mesh_.triangles.row(t) = Eigen::Vector3i(corners[0], corners[1], corners[2]);
    }
    if (triangles_.empty()) refuse(no_faces(mesh_.positions.rows(), lines_));
    if (loose_ > 0) {
      mesh_.notes.push_back("left out " + count_of(loose_, "loose point or line", "loose points and lines"));
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name_, reason));
  }

  void add_positions(const Instance& instance) {
    for (unsigned v = 0; v < instance.mesh->mNumVertices; ++v) {
      const aiVector3D& p = instance.mesh->mVertices[v];
      const Eigen::Vector4d moved = instance.world_from_mesh * Eigen::Vector4d(p.x, p.y, p.z, 1);
      mesh_.positions.row(row(v)) = moved.head<3>();
    }
  }

  void add_normals(const Instance& instance) {
    // The cofactors are the inverse transpose times the determinant, and also exist for singular transforms.
    const Mat3 linear = instance.world_from_mesh.topLeftCorner<3, 3>();
    Mat3 cofactors;
    for (int i = 0; i < 3; ++i) cofactors.row(i) = linear.row((i + 1) % 3).cross(linear.row((i + 2) % 3));
    if (linear.determinant() < 0) cofactors = -cofactors;
    for (unsigned v = 0; v < instance.mesh->mNumVertices; ++v) {
      const aiVector3D& n = instance.mesh->mNormals[v];
      const Vec3 normal = cofactors * Vec3(n.x, n.y, n.z);
      if (normal.allFinite()) mesh_.normals.row(row(v)) = normal.normalized().cast<float>();
    }
  }

  void add_uvs(const aiMesh& mesh) {
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& uv = mesh.mTextureCoords[0][v];
      const Eigen::Vector2f given(uv.x, uv.y);
      if (given.allFinite()) mesh_.uvs.row(row(v)) = given;
    }
  }

  void add_colors(const aiMesh& mesh) {
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiColor4D& c = mesh.mColors[0][v];
      Eigen::Vector4f color(c.r, c.g, c.b, c.a);
      if (!color.allFinite()) continue;
      color = color.cwiseMax(0.0F).cwiseMin(1.0F);
      if (linear_colors_) color.head<3>() = color.head<3>().unaryExpr(&srgb_from_linear).eval();
      mesh_.colors.row(row(v)) = color;
    }
  }

  void add_faces(const Instance& instance) {
    const bool mirrored = instance.world_from_mesh.topLeftCorner<3, 3>().determinant() < 0;
    std::vector<int> corners;
    for (unsigned f = 0; f < instance.mesh->mNumFaces; ++f) {
      const aiFace& face = instance.mesh->mFaces[f];
      if (face.mNumIndices < 3) {
        ++loose_;
        if (face.mNumIndices == 2) ++lines_;
        continue;
      }
      corners.clear();
      for (unsigned i = 0; i < face.mNumIndices; ++i) corners.push_back(vertex_of(*instance.mesh, f, i));
      if (mirrored) std::reverse(corners.begin(), corners.end());
      cut_polygon(mesh_.positions, corners, triangles_);
    }
  }

  [[nodiscard]] int vertex_of(const aiMesh& mesh, unsigned face, unsigned corner) const {
    const unsigned vertex = mesh.mFaces[face].mIndices[corner];
    if (vertex >= mesh.mNumVertices) {
      refuse(fmt::format("face {} refers to vertex {} of {} (index out of range)", face + 1, vertex + 1LL,
                         mesh.mNumVertices));
    }
    return row(vertex);
  }

  [[nodiscard]] int row(unsigned vertex) const { return first_vertex_ + int(vertex); }

  SurfaceMesh mesh_;
  std::vector<std::array<int, 3>> triangles_;
  bool linear_colors_;
  std::string name_;
  int first_vertex_ = 0;
  long loose_ = 0;
  long lines_ = 0;
};

std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return text;
}

/// assimp drops glTF faces with missing corners, and only logs it.
class DroppedFaces : public Assimp::LogStream {
 public:
  void write(const char* message) override {
    if (std::string_view(message).find("out-of-range indices") != std::string_view::npos) any = true;
  }
  bool any = false;
};

const aiScene& read_scene(Assimp::Importer& importer, const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  if (!importer.IsExtensionSupported(extension)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: '{}' is not a mesh format that can be read; use obj, ply, stl, off, glb, gltf, 3mf, "
                            "fbx, dae, 3ds or x3d",
                            file.string(), extension));
  }
  auto* dropped = new DroppedFaces;  // owned by the logger
  Assimp::DefaultLogger::create(nullptr, Assimp::Logger::NORMAL, 0)->attachStream(dropped, Assimp::Logger::Warn);
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  const std::string reason = importer.GetErrorString();
  if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: not a valid mesh file: {}", file.string(), one_line(reason)));
  }
  if (dropped->any) {
    throw Error(ErrorKind::kBadInput,
                file.string() + ": faces refer to vertices that are not there (index out of range)");
  }
  return *scene;
}

/// For 3MF with textures assimp 5.2 has already freed the names and images (its issue 5328), and its colours are black.
void leave_out_materials(SurfaceMesh& mesh) {
  for (Part& part : mesh.parts) part.material = -1;
  mesh.notes.emplace_back(
      "the textures of 3MF files are not supported; drawn without them; save it as GLB to keep them");
}

/// The mesh is read in its rest state.
void note_motion(const aiScene& scene, std::vector<std::string>& notes) {
  unsigned bones = 0;
  unsigned shapes = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    bones += scene.mMeshes[m]->mNumBones;
    shapes += scene.mMeshes[m]->mNumAnimMeshes;
  }
  std::vector<std::string> ignored;
  if (scene.mNumAnimations > 0) ignored.push_back(count_of(scene.mNumAnimations, "animation"));
  if (bones > 0) ignored.push_back("a skin of " + count_of(bones, "bone"));
  if (shapes > 0) ignored.push_back(count_of(shapes, "morph target"));
  if (ignored.empty()) return;
  notes.push_back(fmt::format("ignored {}: the mesh is read at rest", fmt::join(ignored, " and ")));
}

}  // namespace

SurfaceMesh read_by_assimp(const std::filesystem::path& file) {
  // Never destroyed: it would free the textures of 3MF twice and crash (its issue 5328).
  auto* importer = new Assimp::Importer;
  const aiScene& scene = read_scene(*importer, file);
  const std::string extension = lower_extension(file);
  const bool is_gltf = extension == ".glb" || extension == ".gltf";

  std::vector<Instance> instances;
  collect_instances(scene, *scene.mRootNode, Transform::Identity(), instances);
  for (Instance& instance : instances) {
    const unsigned material = instance.mesh->mMaterialIndex;
    if (!is_placeholder(scene, material, is_gltf)) instance.material = int(material);
  }
  MeshBuilder builder(instances, is_gltf, file.string());
  for (const Instance& instance : instances) builder.add(instance);
  SurfaceMesh mesh = builder.finish();
  if (extension == ".3mf" && scene.mNumTextures > 0) {
    leave_out_materials(mesh);
  } else {
    mesh.materials = read_materials(scene, is_gltf, mesh.notes);
  }
  mesh.single_precision = true;
  note_motion(scene, mesh.notes);
  return mesh;
}

}  // namespace sprung
