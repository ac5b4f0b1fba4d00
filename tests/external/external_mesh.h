#pragma once
#include <filesystem>
#include <string>

namespace sprung::test {

/// A file of the folder that the CMake variable SPRUNG_TEST_MESHES names: meshes from elsewhere, which are no part of
/// the project. The tests of this folder are built where there is one.
inline std::filesystem::path external_mesh(const std::string& name) {
  return std::filesystem::path(SPRUNG_TEST_MESHES) / name;
}

}  // namespace sprung::test
