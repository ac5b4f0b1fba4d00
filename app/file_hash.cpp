#include "app/file_hash.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <span>
#include <vector>

namespace sprung {

std::string file_hash(const std::filesystem::path& file) {
  std::ifstream bytes(file, std::ios::binary);
  std::uint64_t hash = 0xcbf29ce484222325U;
  std::vector<char> block(1 << 20);
  while (bytes.read(block.data(), static_cast<std::streamsize>(block.size())) || bytes.gcount() > 0) {
    for (const char byte : std::span(block.data(), bytes.gcount())) {
      hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
    }
  }
  return fmt::format("{:016x}", hash);
}

std::string build_of_this_program() { return file_hash("/proc/self/exe"); }

}  // namespace sprung
