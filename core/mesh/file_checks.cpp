#include "core/mesh/file_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "core/mesh/obj_check.h"

namespace sprung {
namespace {

constexpr std::size_t kLongestHeader = 1 << 16;  // bytes; of the text headers of OFF and PLY

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", file.string(), reason));
}

std::string read_bytes(const std::filesystem::path& file, std::size_t most) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(most, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(most));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

/// The little-endian number of `size` bytes at `offset`; 0 where the bytes end before.
std::uint64_t little_endian(std::string_view bytes, std::size_t offset, std::size_t size) {
  if (offset + size > bytes.size()) return 0;
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

void check_glb(const std::filesystem::path& file, std::uintmax_t size) {
  const std::string head = read_bytes(file, 12);
  if (head.size() < 12 || head.compare(0, 4, "glTF") != 0)
    refuse(file, "is not a GLB file (it does not begin with 'glTF')");
  const std::uint64_t declared = little_endian(head, 8, 4);
  if (declared > size) {
    refuse(file,
           fmt::format("file is shorter ({}) than its header says ({}); fetch or export it again", size, declared));
  }
}

/// A binary STL that is cut short would pass for an empty text one.
void check_stl(const std::filesystem::path& file, std::uintmax_t size) {
  const std::string head = read_bytes(file, 84);
  if (head.find('\0') == std::string::npos) return;
  const std::uint64_t declared = 84 + 50 * little_endian(head, 80, 4);
  if (head.size() < 84 || declared > size) {
    refuse(file,
           fmt::format("file is shorter ({}) than its header says ({}); fetch or export it again", size, declared));
  }
}

/// The first lines of an OFF file as words, comments left out.
std::istringstream off_words(const std::string& head) {
  std::istringstream lines(head);
  std::string words;
  for (std::string line; std::getline(lines, line);) words += line.substr(0, line.find('#')) + ' ';
  return std::istringstream(words);
}

void check_off(const std::filesystem::path& file, std::uintmax_t size) {
  std::istringstream words = off_words(read_bytes(file, kLongestHeader));
  std::string word;
  words >> word;
  if (word.size() < 3 || word.compare(word.size() - 3, 3, "OFF") != 0)
    refuse(file, "is not an OFF file (it does not begin with 'OFF')");
  words >> word;
  if (word == "BINARY") refuse(file, "is a binary OFF file, which is not supported; save it as text, PLY or OBJ");
  double vertices = -1;
  double faces = -1;
  std::istringstream(word) >> vertices;
  words >> faces;
  if (!words || vertices < 0 || faces < 0) refuse(file, "the header holds no counts of vertices and faces");
  // A vertex or a face takes at least 6 bytes: three one-digit numbers and what stands between them.
  const double most = static_cast<double>(size) / 6;
  if (vertices > most) {
    refuse(file,
           fmt::format("header declares {:.0f} vertices, more than the file can hold ({} bytes)", vertices, size));
  }
  if (faces > static_cast<double>(size) / 4) {
    refuse(file, fmt::format("header declares {:.0f} faces, more than the file can hold ({} bytes)", faces, size));
  }
}

void check_ply(const std::filesystem::path& file, std::uintmax_t size) {
  const std::string head = read_bytes(file, kLongestHeader);
  if (head.compare(0, 3, "ply") != 0) refuse(file, "is not a PLY file (it does not begin with 'ply')");
  const std::size_t end = head.find("end_header");
  if (end == std::string::npos) refuse(file, "the PLY header has no 'end_header': the file is cut short");
  const std::uintmax_t body = size - end - 10;
  std::istringstream lines(head.substr(0, end));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword;
    std::string element;
    double count = 0;
    words >> keyword >> element >> count;
    if (keyword != "element") continue;
    if (count > static_cast<double>(body)) {
      refuse(file, fmt::format("header declares {:.0f} of '{}', more than the file can hold ({} bytes)", count, element,
                               size));
    }
    if (element == "face" && count == 0) refuse(file, "no faces (a point cloud)");
  }
  if (head.substr(0, end).find("element face") == std::string::npos) refuse(file, "no faces (a point cloud)");
}

bool is_texture_name(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string extension = std::filesystem::path(name).extension().string();
  return (extension == ".png" || extension == ".jpg" || extension == ".jpeg") &&
         name.find("thumbnail") == std::string::npos;
}

/// assimp 5.2 frees the textures of a 3MF archive twice and ends the process (its issue 5328).
void check_3mf(const std::filesystem::path& file, std::uintmax_t size) {
  constexpr std::size_t kEntrySize = 46;  // of the zip directory, without the name
  const std::string bytes = read_bytes(file, size);
  if (bytes.find("PK\5\6") == std::string::npos)
    refuse(file, "the 3MF archive has no directory: the file is cut short or not a 3MF");
  bool has_model = false;
  for (std::size_t at = bytes.find("PK\1\2"); at != std::string::npos; at = bytes.find("PK\1\2", at + 4)) {
    const std::size_t name_length = little_endian(bytes, at + 28, 2);
    if (at + kEntrySize + name_length > bytes.size()) break;
    const std::string name = bytes.substr(at + kEntrySize, name_length);
    if (is_texture_name(name)) {
      refuse(file, fmt::format("3MF with textures is not supported ('{}'); save it as GLB or OBJ", name));
    }
    has_model = has_model || std::filesystem::path(name).extension() == ".model";
  }
  if (!has_model) refuse(file, "the 3MF archive holds no model");
}

void check_obj_file(const std::filesystem::path& file, std::uintmax_t size) {
  if (const std::string reason = find_obj_fault(read_bytes(file, size)); !reason.empty()) refuse(file, reason);
}

}  // namespace

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void check_readable(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::status_known(status)) refuse(file, error.message());
  if (!std::filesystem::exists(status)) refuse(file, "no such file");
  if (std::filesystem::is_directory(status)) refuse(file, "is a directory, not a file");
  if (!std::filesystem::is_regular_file(status)) refuse(file, "is a pipe or a device, not a regular file");
  if (!std::ifstream(file)) refuse(file, "cannot be opened for reading; check its permissions");
}

void check_mesh_file(const std::filesystem::path& file) {
  check_readable(file);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) refuse(file, error.message());
  if (size == 0) refuse(file, "empty file");

  using Check = void (*)(const std::filesystem::path&, std::uintmax_t);
  static const std::map<std::string, Check> kChecks{{".glb", check_glb}, {".off", check_off}, {".ply", check_ply},
                                                    {".stl", check_stl}, {".3mf", check_3mf}, {".obj", check_obj_file}};
  if (const auto check = kChecks.find(lower_extension(file)); check != kChecks.end()) check->second(file, size);
}

}  // namespace sprung
