#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>

#include "core/appearance.h"
#include "core/io/mesh_export.h"
#include "tests/support/meshes.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

/// The smallest PNG: one pixel.
constexpr std::array<unsigned char, 67> kPixel{
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
    0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00,
    0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x68, 0x00, 0x00, 0x00, 0x82, 0x00, 0x81,
    0x77, 0xcd, 0x72, 0xb6, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

/// A strip of n squares with everything that a mesh can have, in two parts of two materials; and two coincident
/// vertices, which no writer may merge.
Skin strip(int n) {
  std::srand(1);  // where Eigen's random numbers come from
  Skin skin;
  skin.positions = Points::Random(2 * n + 2, 3);
  for (int i = 0; i <= n; ++i) {
    skin.positions.row(2 * i).head(2) << i, 0;
    skin.positions.row(2 * i + 1).head(2) << i, 1;
  }
  skin.positions.row(3) = skin.positions.row(1);
  skin.normals = Points::Random(2 * n + 2, 3);
  skin.normals.rowwise().normalize();
  skin.uvs = Floats2::Random(2 * n + 2, 2).cwiseAbs();
  skin.colors = Floats4::Random(2 * n + 2, 4).cwiseAbs();
  skin.colors.col(3).setOnes();
  skin.triangles.resize(2 * n, 3);
  for (int i = 0; i < n; ++i) {
    skin.triangles.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 1;
    skin.triangles.row(2 * i + 1) << 2 * i + 1, 2 * i + 2, 2 * i + 3;
  }
  skin.parts = {{.name = "front", .first_triangle = 0, .triangle_count = n, .material = 0},
                {.name = "back", .first_triangle = n, .triangle_count = n, .material = 1}};
  skin.materials = {{.name = "red", .color = {0.8F, 0.1F, 0.2F, 1}, .texture = {}, .texture_name = ""},
                    {.name = "blue", .color = {0.1F, 0.2F, 0.7F, 1}, .texture = {}, .texture_name = "pixel.png"}};
  for (const unsigned char byte : kPixel) skin.materials[1].texture.push_back(std::byte{byte});
  return skin;
}

/// A file as assimp sees it: corner after corner of all triangles, in the world; 0 rows: it has none.
struct Reread {
  Points positions;
  Points normals;
  Points uvs;
  Points colors;
  std::vector<std::string> names;  // of meshes and nodes
  std::vector<Eigen::Vector3f> diffuse;
  std::vector<std::vector<std::byte>> textures;
};

aiMatrix4x4 placement_of(const aiNode& node, unsigned mesh, const aiMatrix4x4& above, bool& has_converged) {
  const aiMatrix4x4 here = above * node.mTransformation;
  has_converged = std::find(node.mMeshes, node.mMeshes + node.mNumMeshes, mesh) != node.mMeshes + node.mNumMeshes;
  for (unsigned i = 0; i < node.mNumChildren && !has_converged; ++i) {
    const aiMatrix4x4 below = placement_of(*node.mChildren[i], mesh, here, has_converged);
    if (has_converged) return below;
  }
  return here;
}

void collect_names(const aiNode& node, std::vector<std::string>& names) {
  names.emplace_back(node.mName.C_Str());
  for (unsigned i = 0; i < node.mNumChildren; ++i) collect_names(*node.mChildren[i], names);
}

void add_row(Points& rows, const aiVector3D& vector) {
  rows.conservativeResize(rows.rows() + 1, 3);
  rows.row(rows.rows() - 1) << vector.x, vector.y, vector.z;
}

void add_corner(const aiMesh& mesh, unsigned vertex, const aiMatrix4x4& placement, Reread& read) {
  add_row(read.positions, placement * mesh.mVertices[vertex]);
  if (mesh.HasNormals()) add_row(read.normals, (aiMatrix3x3(placement) * mesh.mNormals[vertex]).NormalizeSafe());
  if (mesh.HasTextureCoords(0)) add_row(read.uvs, mesh.mTextureCoords[0][vertex]);
  if (!mesh.HasVertexColors(0)) return;
  const aiColor4D color = mesh.mColors[0][vertex];
  add_row(read.colors, {color.r, color.g, color.b});
}

void add_material(const aiScene& scene, const aiMaterial& material, const std::filesystem::path& folder, Reread& read) {
  aiColor4D color;
  if (material.Get(AI_MATKEY_BASE_COLOR, color) != AI_SUCCESS) material.Get(AI_MATKEY_COLOR_DIFFUSE, color);
  read.diffuse.emplace_back(color.r, color.g, color.b);
  aiString path;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &path) != AI_SUCCESS) return;
  if (const aiTexture* embedded = scene.GetEmbeddedTexture(path.C_Str())) {
    const auto* bytes = reinterpret_cast<const std::byte*>(embedded->pcData);
    read.textures.emplace_back(bytes, bytes + embedded->mWidth);
    return;
  }
  const std::string bytes = text_of(folder / path.C_Str());
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  read.textures.emplace_back(first, first + bytes.size());
}

Reread reread(const std::filesystem::path& file) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  Reread read;
  if (scene == nullptr) {
    ADD_FAILURE() << importer.GetErrorString();
    return read;
  }
  collect_names(*scene->mRootNode, read.names);
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& mesh = *scene->mMeshes[i];
    read.names.emplace_back(mesh.mName.C_Str());
    bool has_converged = false;
    const aiMatrix4x4 placement = placement_of(*scene->mRootNode, i, {}, has_converged);
    for (unsigned t = 0; t < mesh.mNumFaces; ++t) {
      for (unsigned k = 0; k < 3; ++k) add_corner(mesh, mesh.mFaces[t].mIndices[k], placement, read);
    }
  }
  for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
    add_material(*scene, *scene->mMaterials[i], file.parent_path(), read);
  }
  return read;
}

template <class Matrix>
Points corners_of(const Matrix& rows, const Triangles& triangles) {
  Points corners = Points::Zero(triangles.size(), 3);
  const Eigen::Index columns = std::min<Eigen::Index>(3, rows.cols());
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    corners.row(i).head(columns) = rows.row(triangles.data()[i]).head(columns).template cast<double>();
  }
  return corners;
}

bool is_near(const Points& a, const Points& b, double error) {
  return a.rows() == b.rows() && (a - b).cwiseAbs().maxCoeff() < error;
}

bool has_color(const Reread& read, const Eigen::Vector3f& color) {
  return std::any_of(read.diffuse.begin(), read.diffuse.end(),
                     [&](const Eigen::Vector3f& found) { return (found - color).cwiseAbs().maxCoeff() < 0.01F; });
}

class Reading : public testing::TestWithParam<MeshFormat> {};

TEST_P(Reading, ByAssimpFindsBodiesInTheirOrder) {
  const TempFolder folder;
  std::vector<Skin> skins;
  for (int i = 0; i < 12; ++i) skins.push_back(strip(2 + i));
  std::vector<PosedMesh> meshes;
  for (const Skin& skin : skins) {
    const auto number = double(meshes.size());
    meshes.push_back({.name = "strip" + std::to_string(meshes.size()),
                      .rest = &skin,
                      .positions = skin.positions.array() + number,
                      .normals = skin.normals});
  }
  const auto file = folder.path() / ("strips" + std::string(GetParam().extension));
  export_meshes(meshes, file);
  const Reread read = reread(file);
  Eigen::Index first = 0;
  for (const PosedMesh& mesh : meshes) {
    const Points expected = corners_of(mesh.positions, mesh.rest->triangles);
    ASSERT_GE(read.positions.rows(), first + expected.rows());
    EXPECT_LT((read.positions.middleRows(first, expected.rows()) - expected).cwiseAbs().maxCoeff(), 2e-5) << mesh.name;
    first += expected.rows();
  }
}

TEST_P(Reading, ByAssimpFindsWhatTheFormatKeepsAndNothingElse) {
  const TempFolder folder;
  const Skin skin = strip(6);
  PosedMesh mesh{.name = "strip", .rest = &skin, .positions = skin.positions * 0.37, .normals = skin.normals};
  const auto file = folder.path() / ("strip" + std::string(GetParam().extension));
  export_meshes({mesh}, file);
  const Reread read = reread(file);
  const bool is_linear = GetParam().writer.starts_with("gl");
  const Eigen::Matrix<float, Eigen::Dynamic, 3> colors =
      skin.colors.leftCols<3>().unaryExpr([&](float value) { return is_linear ? linear_from_srgb(value) : value; });
  const Eigen::Vector3f red = skin.materials[0].color.head<3>().unaryExpr(
      [&](float value) { return is_linear ? linear_from_srgb(value) : value; });
  EXPECT_TRUE(is_near(read.positions, corners_of(mesh.positions, skin.triangles), 3e-6));
  const auto has_name = [&](const std::string& name) {
    return std::find(read.names.begin(), read.names.end(), name) != read.names.end();
  };
  const MeshContent found{.normals = is_near(read.normals, corners_of(mesh.normals, skin.triangles), 1e-4),
                          .uvs = is_near(read.uvs, corners_of(skin.uvs, skin.triangles), 1e-5),
                          .colors = is_near(read.colors, corners_of(colors, skin.triangles), 0.005),
                          .materials = has_color(read, red),
                          .textures = read.textures.size() == 1 && read.textures[0] == skin.materials[1].texture,
                          .part_names = has_name("front") && has_name("back")};
  EXPECT_EQ(describe(found), describe(GetParam().keeps));
}

INSTANTIATE_TEST_SUITE_P(Formats, Reading, testing::ValuesIn(mesh_formats().begin(), mesh_formats().end()),
                         [](const auto& test) { return "ending_" + std::string(test.param.extension.substr(1)); });

}  // namespace
}  // namespace sprung
