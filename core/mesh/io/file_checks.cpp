#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
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

namespace {

/// Where the entry of the first model is in the directory of a zip archive; npos: nowhere.
std::size_t find_model(std::string_view bytes) {
  constexpr std::size_t kEntrySize = 46;  // without the name
  for (std::size_t at = bytes.find("PK\1\2"); at != std::string_view::npos; at = bytes.find("PK\1\2", at + 4)) {
    const std::size_t length = little_endian(bytes, at + 28, 2);
    if (at + kEntrySize + length > bytes.size()) break;
    if (bytes.substr(at + kEntrySize, length).ends_with(".model")) return at;
  }
  return std::string_view::npos;
}

/// At most `count` bytes of what a zip archive keeps deflated.
std::string inflate_start(std::string_view deflated, std::size_t count) {
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return "";
  std::string text(count, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(deflated.data()));
  stream.avail_in = uInt(std::min<std::size_t>(deflated.size(), 1 << 20));
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = uInt(count);
  inflate(&stream, Z_SYNC_FLUSH);
  text.resize(count - stream.avail_out);
  inflateEnd(&stream);
  return text;
}

}  // namespace

void check_3mf(std::string_view bytes, const std::string& name) {
  if (bytes.find("PK\5\6") == std::string_view::npos)
    refuse(name, "the 3MF archive has no directory: the file is cut short or not a 3MF");
  if (find_model(bytes) == std::string_view::npos) refuse(name, "the 3MF archive holds no model");
}

std::string start_of_3mf_model(std::string_view bytes, std::size_t count) {
  constexpr std::size_t kHeaderSize = 30;  // of an entry's own header, without the name
  const std::size_t at = find_model(bytes);
  if (at == std::string_view::npos) return "";
  const std::uint64_t method = little_endian(bytes, at + 10, 2);
  const std::uint64_t size = little_endian(bytes, at + 20, 4);
  const std::uint64_t header = little_endian(bytes, at + 42, 4);
  const std::uint64_t start = header + kHeaderSize + little_endian(bytes, header + 26, 2) +  // name
                              little_endian(bytes, header + 28, 2);                          // extra field
  if (start > bytes.size()) return "";
  const std::string_view entry = bytes.substr(start, size);
  return method == 0 ? std::string(entry.substr(0, count)) : inflate_start(entry, count);
}

}  // namespace sprung
