#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/mesh/io/readers.h"

namespace sprung {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name, reason));
}

/// The little-endian number of `size` bytes at `offset`; 0 beyond the end.
std::uint64_t little_endian(std::string_view bytes, std::size_t offset, std::size_t size) {
  if (offset + size > bytes.size()) return 0;
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

}  // namespace

void check_glb(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with("glTF")) refuse(name, "is not a GLB file (it does not begin with 'glTF')");
  const std::uint64_t declared = little_endian(bytes, 8, 4);
  if (bytes.size() < 20 || declared > bytes.size()) {
    refuse(name, fmt::format("file is shorter ({}) than its header says ({}); fetch or export it again", bytes.size(),
                             declared));
  }
  check_gltf(bytes.substr(20, little_endian(bytes, 12, 4)), name);
}

void check_gltf(std::string_view bytes, const std::string& name) {
  constexpr std::string_view kKey = "\"extensionsRequired\"";
  const std::size_t key = bytes.find(kKey);
  if (key == std::string_view::npos) return;
  const std::string_view list = bytes.substr(key, bytes.find(']', key) - key);
  for (const std::string_view extension :
       {"EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_mesh_quantization"}) {
    if (list.find(extension) == std::string_view::npos) continue;
    refuse(name, fmt::format("needs the glTF extension {}, which is not supported; export it without compression or "
                             "quantisation",
                             extension));
  }
}

void check_3mf(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kEntrySize = 46;  // of the zip directory, without the name
  if (bytes.find("PK\5\6") == std::string_view::npos)
    refuse(name, "the 3MF archive has no directory: the file is cut short or not a 3MF");
  for (std::size_t at = bytes.find("PK\1\2"); at != std::string_view::npos; at = bytes.find("PK\1\2", at + 4)) {
    const std::size_t length = little_endian(bytes, at + 28, 2);
    if (at + kEntrySize + length > bytes.size()) break;
    if (bytes.substr(at + kEntrySize, length).ends_with(".model")) return;
  }
  refuse(name, "the 3MF archive holds no model");
}

}  // namespace sprung
