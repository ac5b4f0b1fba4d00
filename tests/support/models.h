#pragma once
#include <filesystem>
#include <string>

namespace sprung::test {

/// A file of assets/models.
inline std::filesystem::path model(const std::string& name) {
  return std::filesystem::path(SPRUNG_SOURCE_DIR "/assets/models") / name;
}

}  // namespace sprung::test
