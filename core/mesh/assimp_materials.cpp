#include "core/mesh/assimp_materials.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>

namespace sprung {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestTexture = std::uintmax_t{1} << 30;  // bytes, encoded

/// %20 and the like, which stand in the URIs of glTF and Collada.
std::string decode_percent(const std::string& text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    const char* digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      decoded += static_cast<char>(code);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

/// The file a path in a mesh means, which may come from another system: backslashes, absolute, encoded.
std::optional<fs::path> find_texture(std::string path, const fs::path& folder) {
  std::replace(path.begin(), path.end(), '\\', '/');
  if (path.starts_with("file://")) path.erase(0, 7);
  for (const std::string& spelling : {path, decode_percent(path)}) {
    const fs::path given(spelling);
    for (const fs::path& candidate : {folder / given, folder / given.filename()}) {
      std::error_code error;
      if (fs::is_regular_file(candidate, error)) return candidate;
    }
  }
  return std::nullopt;
}

std::vector<std::byte> read_all(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream || size > kLargestTexture) return {};
  std::vector<std::byte> bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) return {};
  return bytes;
}

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

void read_texture(const aiScene& scene, const fs::path& mesh_file, const std::string& path, SurfaceMaterial& material,
                  std::vector<std::string>& notes) {
  material.texture_name = path;
  if (const aiTexture* embedded = scene.GetEmbeddedTexture(path.c_str())) {
    if (embedded->mFilename.length > 0) material.texture_name = embedded->mFilename.C_Str();
    material.texture = embedded_bytes(*embedded);
  } else if (const auto file = find_texture(path, mesh_file.parent_path())) {
    material.texture = read_all(*file);
  } else {
    notes.push_back(fmt::format("texture '{}' of material '{}' is not there; drawn without it", path, material.name));
    return;
  }
  if (material.texture.empty()) notes.push_back(fmt::format("texture '{}' cannot be read; drawn without it", path));
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

std::vector<SurfaceMaterial> read_materials(const aiScene& scene, const fs::path& mesh_file, bool is_gltf,
                                            std::vector<std::string>& notes) {
  std::vector<SurfaceMaterial> materials;
  for (unsigned m = 0; m < scene.mNumMaterials; ++m) {
    const aiMaterial& given = *scene.mMaterials[m];
    SurfaceMaterial& material = materials.emplace_back();
    material.name = given.GetName().C_Str();
    material.color = base_color(given, is_gltf);
    if (const std::string path = texture_path(given); !path.empty()) {
      read_texture(scene, mesh_file, path, material, notes);
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
