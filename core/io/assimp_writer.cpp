#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/appearance.h"
#include "core/error.h"
#include "core/files.h"
#include "core/io/mesh_export.h"

namespace sprung {
namespace {

aiVector3D vector_of(const Eigen::RowVector3d& row) { return {float(row[0]), float(row[1]), float(row[2])}; }

/// The vertices that a part uses, in the order of the mesh; all of them for the only part.
struct Vertices {
  std::vector<int> rows;
  std::vector<unsigned> index;  // by vertex of the mesh, into rows
};

Vertices vertices_of(const PosedMesh& mesh, const PosedPart& part, bool is_only_one) {
  std::vector<bool> is_used(mesh.positions.rows(), is_only_one);
  const auto triangles = mesh.rest->triangles.middleRows(part.first_triangle, part.triangle_count);
  for (const auto& triangle : triangles.rowwise()) {
    for (const int corner : triangle) is_used[corner] = true;
  }
  Vertices vertices;
  vertices.index.resize(is_used.size());
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    vertices.index[i] = unsigned(vertices.rows.size());
    if (is_used[i]) vertices.rows.push_back(int(i));
  }
  return vertices;
}

void fill_vertices(const PosedMesh& posed, const std::vector<int>& rows, bool is_linear, aiMesh& mesh) {
  mesh.mNumVertices = unsigned(rows.size());
  mesh.mVertices = new aiVector3D[rows.size()];
  if (posed.normals.rows() > 0) mesh.mNormals = new aiVector3D[rows.size()];
  if (posed.rest->uvs.rows() > 0) mesh.mTextureCoords[0] = new aiVector3D[rows.size()];
  if (posed.rest->uvs.rows() > 0) mesh.mNumUVComponents[0] = 2;
  if (posed.rest->colors.rows() > 0) mesh.mColors[0] = new aiColor4D[rows.size()];
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int row = rows[i];
    mesh.mVertices[i] = vector_of(posed.positions.row(row));
    if (mesh.mNormals != nullptr) mesh.mNormals[i] = vector_of(posed.normals.row(row));
    if (mesh.mTextureCoords[0] != nullptr) {
      mesh.mTextureCoords[0][i] = {posed.rest->uvs(row, 0), posed.rest->uvs(row, 1), 0};
    }
    if (mesh.mColors[0] == nullptr) continue;
    Eigen::Vector4f color = posed.rest->colors.row(row);
    if (is_linear) color.head<3>() = color.head<3>().unaryExpr(&linear_from_srgb).eval();
    mesh.mColors[0][i] = {color[0], color[1], color[2], color[3]};
  }
}

void fill_faces(const PosedMesh& posed, const PosedPart& part, const std::vector<unsigned>& index, aiMesh& mesh) {
  mesh.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh.mNumFaces = unsigned(part.triangle_count);
  mesh.mFaces = new aiFace[mesh.mNumFaces];
  for (unsigned t = 0; t < mesh.mNumFaces; ++t) {
    mesh.mFaces[t].mNumIndices = 3;
    mesh.mFaces[t].mIndices = new unsigned[3];
    for (int k = 0; k < 3; ++k) {
      const int corner = posed.rest->triangles(part.first_triangle + int(t), k);
      mesh.mFaces[t].mIndices[k] = index[corner];
    }
  }
}

/// Builds an assimp scene, which owns everything in it.
class SceneBuilder {
 public:
  SceneBuilder(const MeshFormat& format, const std::filesystem::path& file)
      : file_(file),
        has_textures_(format.keeps.textures),
        is_gltf_(format.writer.starts_with("gl")),
        is_flat_(format.is_flat) {}

  std::unique_ptr<aiScene> build(const std::vector<PosedMesh>& meshes) {
    auto scene = std::make_unique<aiScene>();
    scene->mRootNode = new aiNode("sprung");
    if (is_flat_) {
      attach_all(meshes, *scene->mRootNode);
    } else {
      scene->mRootNode->mNumChildren = unsigned(meshes.size());
      scene->mRootNode->mChildren = new aiNode*[meshes.size()];
      for (std::size_t i = 0; i < meshes.size(); ++i) scene->mRootNode->mChildren[i] = node_of(meshes[i], *scene);
    }
    transfer(meshes_, scene->mNumMeshes, scene->mMeshes);
    transfer(materials_, scene->mNumMaterials, scene->mMaterials);
    transfer(textures_, scene->mNumTextures, scene->mTextures);
    return scene;
  }

 private:
  template <class Item>
  static void transfer(const std::vector<Item*>& items, unsigned& count, Item**& list) {
    if (items.empty()) return;
    count = unsigned(items.size());
    list = new Item*[items.size()];
    std::copy(items.begin(), items.end(), list);
  }

  /// A mesh of several parts gets a node for each: in some formats only nodes have names.
  aiNode* node_of(const PosedMesh& posed, aiScene& scene) {
    auto* node = new aiNode(posed.name);
    node->mParent = scene.mRootNode;
    const std::vector<PosedPart> parts = parts_of(posed);
    if (parts.size() == 1) {
      attach({mesh_of(posed, parts.front(), true)}, *node);
      return node;
    }
    node->mNumChildren = unsigned(parts.size());
    node->mChildren = new aiNode*[parts.size()];
    for (std::size_t i = 0; i < parts.size(); ++i) {
      node->mChildren[i] = new aiNode(parts[i].name);
      node->mChildren[i]->mParent = node;
      attach({mesh_of(posed, parts[i], false)}, *node->mChildren[i]);
    }
    return node;
  }

  void attach_all(const std::vector<PosedMesh>& meshes, aiNode& node) {
    std::vector<unsigned> all;
    for (const PosedMesh& posed : meshes) {
      const std::vector<PosedPart> parts = parts_of(posed);
      for (const PosedPart& part : parts) {
        all.push_back(mesh_of(posed, part, parts.size() == 1));
        meshes_.back()->mName = parts.size() == 1 ? posed.name : posed.name + " " + part.name;
      }
    }
    attach(all, node);
  }

  static void attach(const std::vector<unsigned>& meshes, aiNode& node) {
    node.mNumMeshes = unsigned(meshes.size());
    node.mMeshes = new unsigned[meshes.size()];
    std::copy(meshes.begin(), meshes.end(), node.mMeshes);
  }

  /// Returns the index of the new mesh.
  unsigned mesh_of(const PosedMesh& posed, const PosedPart& part, bool is_only_one) {
    const Vertices vertices = vertices_of(posed, part, is_only_one);
    auto* mesh = new aiMesh;
    mesh->mName = part.name;
    mesh->mMaterialIndex = material_of(part);
    fill_vertices(posed, vertices.rows, is_gltf_, *mesh);
    fill_faces(posed, part, vertices.index, *mesh);
    meshes_.push_back(mesh);
    return unsigned(meshes_.size() - 1);
  }

  unsigned material_of(const PosedPart& part) {
    const auto known = std::find(names_.begin(), names_.end(), part.material);
    if (known != names_.end()) return unsigned(known - names_.begin());
    names_.push_back(part.material);
    auto* material = new aiMaterial;
    const aiString name(part.material);
    material->AddProperty(&name, AI_MATKEY_NAME);
    Eigen::Vector4f shade = part.color;
    if (is_gltf_) shade.head<3>() = shade.head<3>().unaryExpr(&linear_from_srgb).eval();
    const aiColor4D color(shade[0], shade[1], shade[2], shade[3]);
    material->AddProperty(&color, 1, AI_MATKEY_COLOR_DIFFUSE);
    material->AddProperty(&color, 1, AI_MATKEY_BASE_COLOR);
    const float metallic = 0;
    material->AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
    material->AddProperty(&kExportedRoughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
    add_texture(part, *material);
    materials_.push_back(material);
    return unsigned(materials_.size() - 1);
  }

  void add_texture(const PosedPart& part, aiMaterial& material) {
    if (!has_textures_ || part.source == nullptr || texture_extension(*part.source).empty()) return;
    const aiString path(is_gltf_ ? embed_texture(*part.source) : write_texture(part, file_));
    material.AddProperty(&path, AI_MATKEY_TEXTURE(aiTextureType_DIFFUSE, 0));
    material.AddProperty(&path, AI_MATKEY_TEXTURE(aiTextureType_BASE_COLOR, 0));
  }

  std::string embed_texture(const SurfaceMaterial& source) {
    auto* texture = new aiTexture;
    texture->mWidth = unsigned(source.texture.size());
    texture->pcData = new aiTexel[source.texture.size() / sizeof(aiTexel) + 1];
    std::memcpy(texture->pcData, source.texture.data(), source.texture.size());
    std::strcpy(texture->achFormatHint, texture_extension(source) == ".png" ? "png" : "jpg");
    textures_.push_back(texture);
    return fmt::format("*{}", textures_.size() - 1);
  }

  const std::filesystem::path& file_;
  bool has_textures_;
  bool is_gltf_;  // with linear colours and embedded textures
  bool is_flat_;
  std::vector<aiMesh*> meshes_;
  std::vector<aiMaterial*> materials_;
  std::vector<aiTexture*> textures_;
  std::vector<std::string> names_;  // of the materials
};

}  // namespace

void write_by_assimp(const std::vector<PosedMesh>& meshes, const MeshFormat& format,
                     const std::filesystem::path& file) {
  const std::unique_ptr<aiScene> scene = SceneBuilder(format, file).build(meshes);
  Assimp::Exporter exporter;
  Assimp::ExportProperties properties;
  properties.SetPropertyString(AI_CONFIG_EXPORT_BLOB_NAME, file.stem().string());
  const aiExportDataBlob* blob =
      exporter.ExportToBlob(scene.get(), std::string(format.writer).c_str(), 0U, &properties);
  if (blob == nullptr) {
    throw Error(ErrorKind::kFailed, fmt::format("cannot write '{}': {}", file.string(), exporter.GetErrorString()));
  }
  // The main file comes first, then those beside it.
  write_file(file, {static_cast<const char*>(blob->data), blob->size});
  for (blob = blob->next; blob != nullptr; blob = blob->next) {
    write_file(file.parent_path() / blob->name.C_Str(), {static_cast<const char*>(blob->data), blob->size});
  }
}

}  // namespace sprung
