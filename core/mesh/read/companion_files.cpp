#include "core/mesh/read/companion_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>

namespace sprung {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestText = std::uintmax_t{1} << 26;     // bytes
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
std::optional<fs::path> find_companion(std::string path, const fs::path& folder) {
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

std::optional<std::string> read_all(const fs::path& file, std::uintmax_t largest) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream || size > largest) return std::nullopt;
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) return std::nullopt;
  return bytes;
}

}  // namespace

std::optional<std::string> read_companion(const std::string& name, const fs::path& mesh_file) {
  const auto file = find_companion(name, mesh_file.parent_path());
  return file ? read_all(*file, kLargestText) : std::nullopt;
}

void read_textures(SurfaceMesh& mesh, const fs::path& mesh_file) {
  for (SurfaceMaterial& material : mesh.materials) {
    if (material.texture_name.empty() || !material.texture.empty()) continue;
    const auto file = find_companion(material.texture_name, mesh_file.parent_path());
    if (!file) {
      mesh.notes.push_back(fmt::format("texture '{}' of material '{}' is not there; drawn without it",
                                       material.texture_name, material.name));
    } else if (const auto bytes = read_all(*file, kLargestTexture); bytes && !bytes->empty()) {
      material.texture.resize(bytes->size());
      std::memcpy(material.texture.data(), bytes->data(), bytes->size());
    } else {
      mesh.notes.push_back(fmt::format("texture '{}' cannot be read; drawn without it", material.texture_name));
    }
  }
}

}  // namespace sprung
