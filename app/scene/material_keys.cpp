#include "app/scene/material_keys.h"

namespace sprung {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kPositive{.low = 0, .without_low = true};
constexpr Range kShare{.low = 0, .high = kInfinity};

const Key<LibraryMaterial> kMaterial[] = {
    {{"name", "by which scenes and --material know it", Dimension::kNone, {}, true}, &LibraryMaterial::name},
    {{"class", "gelatin, silicone, rubber, foam, wood, tissue, plastic, metal or other"},
     &LibraryMaterial::material_class},
    {{"about", "what it is"}, &LibraryMaterial::about},
    {{"young", "Young's modulus", Dimension::kPressure, kPositive, true}, &LibraryMaterial::young},
    {{"young_uncertainty", "how far off it may be, as a share", Dimension::kRatio, kShare},
     &LibraryMaterial::young_uncertainty},
    {{"young_source", "where it is from"}, &LibraryMaterial::young_source},
    {{"poisson", "Poisson's ratio", Dimension::kNone, {-1, 0.5, true, true}, true}, &LibraryMaterial::poisson},
    {{"poisson_uncertainty", "how far off it may be", Dimension::kNone, {0, 1}}, &LibraryMaterial::poisson_uncertainty},
    {{"poisson_source", "where it is from"}, &LibraryMaterial::poisson_source},
    {{"density", "density", Dimension::kDensity, kPositive, true}, &LibraryMaterial::density},
    {{"density_uncertainty", "how far off it may be, as a share", Dimension::kRatio, kShare},
     &LibraryMaterial::density_uncertainty},
    {{"density_source", "where it is from"}, &LibraryMaterial::density_source},
    {{"damping", "ratio of critical damping at the slowest vibration", Dimension::kRatio, {0, 10}},
     &LibraryMaterial::damping},
    {{"damping_uncertainty", "how far off it may be, as a share", Dimension::kRatio, kShare},
     &LibraryMaterial::damping_uncertainty},
    {{"damping_source", "where it is from"}, &LibraryMaterial::damping_source},
    {{"look", "how it takes light: plastic, gelatin, rubber or steel"}, &LibraryMaterial::look},
};

const Key<MaterialFile> kFile[] = {
    {{"material", "a material", Dimension::kNone, {}, true}, &MaterialFile::materials},
};

}  // namespace

template <>
std::span<const Key<LibraryMaterial>> keys() {
  return kMaterial;
}
template <>
std::span<const Key<MaterialFile>> keys() {
  return kFile;
}

}  // namespace sprung
