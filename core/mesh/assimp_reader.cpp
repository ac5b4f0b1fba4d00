#include "core/mesh/assimp_reader.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/mesh/assimp_materials.h"
#include "core/mesh/file_checks.h"
#include "core/mesh/polygon.h"

namespace sprung {
namespace {

using Transform = Eigen::Matrix4d;

/// A mesh where a node puts it.
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

/// Fills one SurfaceMesh with the instances one after the other.
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
    const int n = static_cast<int>(vertices);
    mesh_.positions.setZero(n, 3);
    // Where only some meshes bring an attribute, the others get a neutral value: no normal, no offset, white.
    if (normals) mesh_.normals.setZero(n, 3);
    if (uvs) mesh_.uvs.setZero(n, 2);
    if (colors) mesh_.colors.setOnes(n, 4);
  }

  void add(const Instance& instance) {
    add_positions(instance);
    if (instance.mesh->HasNormals()) add_normals(instance);
    if (instance.mesh->HasTextureCoords(0)) add_uvs(*instance.mesh);
    if (instance.mesh->HasVertexColors(0)) add_colors(*instance.mesh);
    const auto first = static_cast<int>(triangles_.size());
    add_faces(instance);
    const auto count = static_cast<int>(triangles_.size()) - first;
    if (count > 0) mesh_.parts.push_back({instance.name, first, count, instance.material});
    first_vertex_ += static_cast<int>(instance.mesh->mNumVertices);
  }

  SurfaceMesh finish() {
    mesh_.triangles.resize(static_cast<int>(triangles_.size()), 3);
    for (int t = 0; t < mesh_.triangles.rows(); ++t) {
      const auto& corners = triangles_[static_cast<std::size_t>(t)];
      mesh_.triangles.row(t) = Eigen::Vector3i(corners[0], corners[1], corners[2]);
    }
    if (loose_ > 0) mesh_.notes.push_back(fmt::format("left out {} loose points and lines", loose_));
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
    // The cofactors are the inverse transpose times the determinant: they exist for a flattening transform, too.
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

  [[nodiscard]] int row(unsigned vertex) const { return first_vertex_ + static_cast<int>(vertex); }

  SurfaceMesh mesh_;
  std::vector<std::array<int, 3>> triangles_;
  bool linear_colors_;
  std::string name_;
  int first_vertex_ = 0;
  int loose_ = 0;
};

/// A binary PLY whose data begin with a line feed, as one in 256 does: assimp 5.2 takes that byte for a part of the
/// line end before (its issue 5341). A carriage return at the end of the header gives it a line feed to take. Empty
/// where the file is to be read as it is.
std::string repaired_ply(const std::filesystem::path& file) {
  constexpr std::string_view kEnd = "end_header\n";
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t end = bytes.find(kEnd);
  const std::size_t data = end + kEnd.size();
  if (end == std::string::npos || data >= bytes.size() || bytes[data] != '\n') return {};
  if (bytes.substr(0, end).find("format binary") == std::string::npos) return {};
  bytes.insert(data - 1, 1, '\r');
  return bytes;
}

const aiScene& read_scene(Assimp::Importer& importer, const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  if (!importer.IsExtensionSupported(extension)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: '{}' is not a mesh format that can be read; use obj, ply, stl, off, glb, gltf, 3mf, "
                            "fbx, dae, 3ds or x3d",
                            file.string(), extension));
  }
  const std::string repaired = extension == ".ply" ? repaired_ply(file) : std::string{};
  const aiScene* scene = repaired.empty() ? importer.ReadFile(file.string(), 0)
                                          : importer.ReadFileFromMemory(repaired.data(), repaired.size(), 0, "ply");
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: not a valid mesh file: {}", file.string(), importer.GetErrorString()));
  }
  return *scene;
}

}  // namespace

SurfaceMesh read_by_assimp(const std::filesystem::path& file) {
  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, file);
  const std::string extension = lower_extension(file);
  const bool is_gltf = extension == ".glb" || extension == ".gltf";

  std::vector<Instance> instances;
  collect_instances(scene, *scene.mRootNode, Transform::Identity(), instances);
  for (Instance& instance : instances) {
    const unsigned material = instance.mesh->mMaterialIndex;
    if (!is_placeholder(scene, material, is_gltf)) instance.material = static_cast<int>(material);
  }
  MeshBuilder builder(instances, is_gltf, file.string());
  for (const Instance& instance : instances) builder.add(instance);
  SurfaceMesh mesh = builder.finish();
  mesh.materials = read_materials(scene, file, is_gltf, mesh.notes);
  // The facet normals of STL only repeat its triangles; smooth ones are better made from these.
  if (extension == ".stl") mesh.normals.resize(0, 3);
  return mesh;
}

}  // namespace sprung
