#include "core/mesh/read/assimp_materials.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>

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

}  // namespace

float srgb_from_linear(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

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

bool is_placeholder(const aiScene& scene, unsigned material, bool is_gltf) {
  if (material >= scene.mNumMaterials) return true;
  const aiMaterial& given = *scene.mMaterials[material];
  if (!texture_path(given).empty()) return false;
  const std::string name = given.GetName().C_Str();
  // The glTF reader appends its default without a name; in glTF others may lack one, too.
  if (name.empty())
    return is_gltf ? material + 1 == scene.mNumMaterials : base_color(given, false).head<3>().minCoeff() == 1;
  return name == AI_DEFAULT_MATERIAL_NAME;
}

}  // namespace sprung
