#include "tests/soak/mesh_corpus.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Exporter.hpp>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "tests/support/meshes.h"

namespace sprung::test {
namespace {

aiVector3D vector_of(const Eigen::Ref<const Eigen::RowVector3d>& v) {
  return {static_cast<ai_real>(v[0]), static_cast<ai_real>(v[1]), static_cast<ai_real>(v[2])};
}

aiMesh* assimp_mesh(const SurfaceMesh& mesh) {
  auto* made = new aiMesh;
  made->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  const auto vertices = std::size_t(mesh.positions.rows());
  made->mNumVertices = unsigned(vertices);
  made->mVertices = new aiVector3D[vertices];
  made->mNormals = new aiVector3D[vertices];
  made->mTextureCoords[0] = new aiVector3D[vertices];
  made->mNumUVComponents[0] = 2;
  made->mColors[0] = new aiColor4D[vertices];
  for (std::size_t v = 0; v < vertices; ++v) {
    const Eigen::RowVector3d position = mesh.positions.row(v);
    made->mVertices[v] = vector_of(position);
    made->mNormals[v] = vector_of(position.stableNormalized());
    made->mTextureCoords[0][v] = aiVector3D(made->mVertices[v].x, made->mVertices[v].y, 0);
    made->mColors[0][v] = aiColor4D(1, 0.5F, 0.25F, 1);
  }
  made->mNumFaces = unsigned(mesh.triangles.rows());
  made->mFaces = new aiFace[made->mNumFaces];
  for (unsigned f = 0; f < made->mNumFaces; ++f) {
    made->mFaces[f].mNumIndices = 3;
    made->mFaces[f].mIndices = new unsigned[3];
    for (unsigned k = 0; k < 3; ++k) {
      made->mFaces[f].mIndices[k] = unsigned(mesh.triangles(f, k));
    }
  }
  return made;
}

/// Without a texture for X3D, whose textures assimp writes so that it cannot read them.
aiMaterial* red_material(bool has_texture) {
  auto* material = new aiMaterial;
  const aiString name("red");
  const aiString texture("skin.png");
  const aiColor3D color(0.8F, 0.1F, 0.1F);
  material->AddProperty(&name, AI_MATKEY_NAME);
  material->AddProperty(&color, 1, AI_MATKEY_COLOR_DIFFUSE);
  if (has_texture) material->AddProperty(&texture, AI_MATKEY_TEXTURE_DIFFUSE(0));
  return material;
}

/// Two instances of each mesh, one moved. The scene owns all that it points to.
void fill_scene(const std::vector<SurfaceMesh>& meshes, bool has_texture, aiScene& scene) {
  scene.mNumMaterials = 1;
  scene.mMaterials = new aiMaterial* [1] { red_material(has_texture) };
  scene.mNumMeshes = unsigned(meshes.size());
  scene.mMeshes = new aiMesh*[scene.mNumMeshes];
  scene.mRootNode = new aiNode("root");
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    scene.mMeshes[m] = assimp_mesh(meshes[m]);
    for (const float shift : {0.0F, 5.0F}) {
      auto* node = new aiNode(fmt::format("part{}_{:.0f}", m, shift));
      node->mTransformation.d4 = 1;
      node->mTransformation.a4 = shift;
      node->mNumMeshes = 1;
      node->mMeshes = new unsigned[1]{m};
      scene.mRootNode->addChildren(1, &node);
    }
  }
}

void write_off(const SurfaceMesh& mesh, const std::filesystem::path& file) {
  std::ofstream text(file);
  text << "OFF\n" << mesh.positions.rows() << ' ' << mesh.triangles.rows() << " 0\n" << mesh.positions << '\n';
  for (const auto& triangle : mesh.triangles.rowwise()) text << "3 " << triangle << '\n';
}

/// Here, since assimp declares bytes for colours and then writes floats.
void write_binary_ply(const SurfaceMesh& mesh, const std::filesystem::path& file) {
  std::ofstream bytes(file, std::ios::binary);
  bytes << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.positions.rows()
        << "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nproperty uchar green\n"
           "property uchar blue\nelement face "
        << mesh.triangles.rows() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& p : mesh.positions.rowwise()) {
    const Eigen::RowVector3d position = p;
    bytes.write(reinterpret_cast<const char*>(position.data()), sizeof position).write("\xFF\x80\x40", 3);
  }
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::RowVector3i triangle = t;
    bytes.put(3).write(reinterpret_cast<const char*>(triangle.data()), sizeof triangle);
  }
}

void export_by_assimp(const aiScene& scene, const char* format, const std::filesystem::path& file) {
  Assimp::Exporter exporter;
  if (exporter.Export(&scene, format, file.string()) == aiReturn_SUCCESS) return;
  throw std::runtime_error(fmt::format("cannot write {}: {}", file.string(), exporter.GetErrorString()));
}

}  // namespace

std::vector<std::filesystem::path> write_mesh_corpus(const std::filesystem::path& folder) {
  const std::vector<SurfaceMesh> meshes{box_mesh(-Vec3::Ones(), Vec3::Ones()), torus_mesh(1, 0.4, 8, 5)};
  std::vector<std::filesystem::path> files{folder / "shapes.off", folder / "binary.ply"};
  write_off(meshes.at(1), files.at(0));
  write_binary_ply(meshes.at(1), files.at(1));
  const std::vector<std::pair<const char*, const char*>> formats{
      {"obj", "shapes.obj"},  {"ply", "text.ply"},      {"stl", "text.stl"},       {"stlb", "binary.stl"},
      {"glb2", "shapes.glb"}, {"gltf2", "shapes.gltf"}, {"collada", "shapes.dae"}, {"fbxa", "shapes.fbx"},
      {"3ds", "shapes.3ds"},  {"x", "shapes.x"},        {"x3d", "shapes.x3d"},     {"3mf", "shapes.3mf"}};
  for (const auto& [format, name] : formats) {
    aiScene scene;
    fill_scene(meshes, std::string_view(format) != "x3d", scene);
    files.push_back(folder / name);
    export_by_assimp(scene, format, files.back());
  }
  return files;
}

}  // namespace sprung::test
