#pragma once
#include "app/scene/material_library.h"
#include "app/scene/scene_keys.h"

namespace sprung {

/// What a file of materials says.
struct MaterialFile {
  std::vector<LibraryMaterial> materials;
};

template <>
struct KeyTypes<LibraryMaterial> : Types<std::string, MaterialClass, double, Look> {};
template <>
struct KeyTypes<MaterialFile> : Types<std::vector<LibraryMaterial>> {};

template <>
std::span<const Key<LibraryMaterial>> keys();
template <>
std::span<const Key<MaterialFile>> keys();

}  // namespace sprung
