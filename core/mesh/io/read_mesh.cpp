#include "core/mesh/io/read_mesh.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <exception>

#include "core/error.h"
#include "core/files.h"
#include "core/mesh/io/reader_process.h"
#include "core/mesh/io/readers.h"
#include "core/mesh/io/text_scanner.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 32;  // bytes
constexpr std::size_t kLongestModelStart = 4096;                  // bytes, in which a 3MF says its unit

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", file.string(), reason));
}

void check_size(const fs::path& file) {
  const std::uintmax_t size = fs::file_size(file);
  if (size == 0) refuse(file, "empty file");
  if (size > kLargestFile) {
    refuse(file, fmt::format("its {:.1f} GB are more than the {:.1f} GB that are read; simplify the mesh",
                             double(size) * 1e-9, double(kLargestFile) * 1e-9));
  }
}

/// The bytes that a reader loads: the file and, for a glTF, the buffers beside it.
std::uintmax_t bytes_to_read(const fs::path& file) {
  std::uintmax_t bytes = fs::file_size(file);
  if (lower_extension(file) != ".gltf") return bytes;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(fs::absolute(file).parent_path(), error)) {
    if (lower_extension(entry.path()) == ".bin" && entry.is_regular_file(error)) bytes += entry.file_size(error);
  }
  return bytes;
}

/// At least ten times what sound files take: 15 bytes per byte of XML, at 10 MB/s.
ReadingLimits limits_for(const fs::path& file) {
  constexpr std::uint64_t kBytesPerByte = 64;
  const std::uintmax_t bytes = std::min(bytes_to_read(file), kLargestFile);
  const auto physical =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  ReadingLimits limits;
  limits.memory = std::min(limits.memory + kBytesPerByte * bytes, std::max(limits.memory, physical / 4 * 3));
  limits.cpu_time += int(2 * (bytes >> 20));
  limits.wall_time = 5 * limits.cpu_time;
  return limits;
}

void refuse_utf16(std::string_view bytes, const fs::path& file) {
  if (!bytes.starts_with("\xFF\xFE") && !bytes.starts_with("\xFE\xFF")) return;
  refuse(file, "text in UTF-16; save it as UTF-8 or ASCII");
}

}  // namespace

SurfaceMesh read_mesh_here(const fs::path& file) {
  const std::string name = file.string();
  const std::string format = lower_extension(file);
  const std::string bytes = read_file(file);
  refuse_utf16(bytes, file);
  const std::string_view text = without_byte_order_mark(bytes);
  if (format == ".obj") {
    return read_obj(text, name, [&](const std::string& companion) { return read_companion(companion, file); });
  }
  if (format == ".ply") return read_ply(text, name);
  if (format == ".stl") return read_stl(text, name);
  if (format == ".off") return read_off(text, name);
  if (format == ".glb") check_glb(bytes, name);
  if (format == ".gltf") check_gltf(bytes, name);
  if (format == ".3mf") check_3mf(bytes, name);
  return read_by_assimp(file);
}

std::string stated_unit(const fs::path& file) {
  const std::string format = lower_extension(file);
  if (format == ".gltf" || format == ".glb") return "m";
  if (format != ".3mf") return "";
  const std::string model = start_of_3mf_model(read_file(file), kLongestModelStart);
  const std::size_t tag = model.find("<model");
  if (tag == std::string::npos) return "";
  const std::string_view attributes = std::string_view(model).substr(tag, model.find('>', tag) - tag);
  constexpr std::array<std::array<std::string_view, 2>, 6> kUnitsOf3mf{
      {{"micron", "um"}, {"millimeter", "mm"}, {"centimeter", "cm"}, {"inch", "in"}, {"foot", "ft"}, {"meter", "m"}}};
  for (const auto& [written, unit] : kUnitsOf3mf) {
    for (const char quote : {'"', '\''}) {
      if (attributes.find(fmt::format("unit={1}{0}{1}", written, quote)) != std::string_view::npos) {
        return std::string(unit);
      }
    }
  }
  return "mm";
}

SurfaceMesh read_mesh(const fs::path& file) {
  check_readable(file);
  check_size(file);
  SurfaceMesh mesh = read_in_child(file, limits_for(file), [&] { return read_mesh_here(file); });
  if (const std::string fault = find_fault(mesh); !fault.empty()) refuse(file, fault);
  read_textures(mesh, file);
  return mesh;
}

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestText = std::uintmax_t{1} << 26;     // bytes
constexpr std::uintmax_t kLargestTexture = std::uintmax_t{1} << 30;  // bytes, encoded

/// Decodes %20 etc. in the URIs of glTF and Collada.
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

/// The file for a path in a mesh, which may come from another system: backslashes, absolute, encoded.
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

std::optional<std::string> read_up_to(std::uintmax_t largest, const fs::path& file) {
  std::error_code error;
  if (fs::file_size(file, error) > largest) return std::nullopt;  // also on errors
  try {
    return read_file(file);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<std::string> read_companion(const std::string& name, const fs::path& mesh_file) {
  const auto file = find_companion(name, mesh_file.parent_path());
  return file ? read_up_to(kLargestText, *file) : std::nullopt;
}

void read_textures(SurfaceMesh& mesh, const fs::path& mesh_file) {
  for (SurfaceMaterial& material : mesh.materials) {
    if (material.texture_name.empty() || !material.texture.empty()) continue;
    const auto file = find_companion(material.texture_name, mesh_file.parent_path());
    if (!file) {
      mesh.notes.push_back(fmt::format("texture '{}' of material '{}' does not exist; drawn without it",
                                       material.texture_name, material.name));
    } else if (const auto bytes = read_up_to(kLargestTexture, *file); bytes && !bytes->empty()) {
      material.texture.resize(bytes->size());
      std::memcpy(material.texture.data(), bytes->data(), bytes->size());
    } else {
      mesh.notes.push_back(fmt::format("texture '{}' cannot be read; drawn without it", material.texture_name));
    }
  }
}

}  // namespace sprung
