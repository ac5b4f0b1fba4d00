#include "app/scene_keys.h"

namespace sprung {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kPositive{.low = 0, .without_low = true};
constexpr Range kRatio{.low = 0, .high = 1};
constexpr int kSampleCounts[] = {1, 4};

const Key<Scene> kScene[] = {
    {{"duration", "length of the film", Dimension::kTime, {0, 3600, true}}, &Scene::duration},
    {{"fps", "pictures a second", Dimension::kRate, {0, 10000, true}}, &Scene::fps},
    {{"gravity", "acceleration of everything", Dimension::kAcceleration}, &Scene::gravity},
    {{"scheme", "how the motion is stepped: euler (symplectic) or verlet"}, &Scene::scheme},
    {{"camera", "where the film is seen from"}, &Scene::camera},
    {{"render", "the pictures"}, &Scene::render},
    {{"body", "a mesh made of a soft material", Dimension::kNone, {}, true}, &Scene::bodies},
    {{"obstacle", "the ground"}, &Scene::obstacles},
};

const Key<SceneBody> kBody[] = {
    {{"mesh", "file of the surface, relative to the scene file", Dimension::kNone, {}, true}, &SceneBody::mesh},
    {{"size", "longest side of the body", Dimension::kLength, kPositive}, &SceneBody::size},
    {{"scale", "length of one unit of the mesh file; instead of size", Dimension::kLength, kPositive},
     &SceneBody::scale},
    {{"position", "where the middle of the bottom of its bounding box goes", Dimension::kLength}, &SceneBody::position},
    {{"rotation", "about x, then y, then z, around its middle", Dimension::kAngle}, &SceneBody::rotation},
    {{"bricks", "number of bricks along the longest side", Dimension::kNone, {1, 1024}}, &SceneBody::bricks},
    {{"brick_size", "side of a brick; instead of bricks", Dimension::kLength, kPositive}, &SceneBody::brick_size},
    {{"material", "a name from `sprung materials`; in a scene also { young, poisson, density, damping }"},
     &SceneBody::material},
    {{"model", "law of the bricks: calibrated or tensile (Baudet et al. 2009)"}, &SceneBody::model},
    {{"color", "of what the mesh file leaves without colour: \"#rrggbb\""}, &SceneBody::color},
    {{"velocity", "at the start", Dimension::kSpeed}, &SceneBody::velocity},
    {{"pin", "nodes that are held"}, &SceneBody::pins},
};

const Key<Material> kMaterial[] = {
    {{"young", "Young's modulus", Dimension::kPressure, kPositive, true}, &Material::young},
    {{"poisson", "Poisson's ratio", Dimension::kNone, {-1, 0.5, true, true}, true}, &Material::poisson},
    {{"density", "density", Dimension::kDensity, kPositive, true}, &Material::density},
    {{"damping", "ratio of critical damping at the slowest vibration", Dimension::kRatio, {0, 10}}, &Material::damping},
};

const Key<Pin> kPin[] = {
    {{"box", "which nodes, in fractions of the body's bounding box", Dimension::kNone, {}, true}, &Pin::box},
};

const Key<Box> kBox[] = {
    {{"min", "low corner", Dimension::kRatio, {}, true}, &Box::min},
    {{"max", "high corner", Dimension::kRatio, {}, true}, &Box::max},
};

const Key<Obstacle> kObstacle[] = {
    {{"plane", "the half-space below it is solid", Dimension::kNone, {}, true}, &Obstacle::plane},
    {{"friction", "Coulomb's coefficient", Dimension::kRatio, {0, kInfinity}}, &Obstacle::friction},
    {{"restitution", "speed after over speed before the impact of a point", Dimension::kRatio, kRatio},
     &Obstacle::restitution},
};

const Key<Plane> kPlane[] = {
    {{"y", "height", Dimension::kLength, {}, true}, &Plane::y},
};

const Key<SceneCamera> kCamera[] = {
    {{"azimuth", "direction of the camera about the vertical; 0 looks along -z", Dimension::kAngle},
     &SceneCamera::azimuth},
    {{"elevation", "height of the camera above the horizon", Dimension::kAngle, {-85, 85}}, &SceneCamera::elevation},
    {{"orbit", "how far it goes around over the film", Dimension::kAngle}, &SceneCamera::orbit},
};

const Key<SceneRender> kRender[] = {
    {{"resolution", "width and height of the pictures in pixels", Dimension::kNone, {16, 8192}},
     &SceneRender::resolution},
    {{"samples", "samples a pixel: 4 (smooth edges) or 1 (quick)", Dimension::kNone, {1, 4}, false, kSampleCounts},
     &SceneRender::samples},
};

}  // namespace

template <>
std::span<const Key<Scene>> keys() {
  return kScene;
}
template <>
std::span<const Key<SceneBody>> keys() {
  return kBody;
}
template <>
std::span<const Key<Material>> keys() {
  return kMaterial;
}
template <>
std::span<const Key<Pin>> keys() {
  return kPin;
}
template <>
std::span<const Key<Box>> keys() {
  return kBox;
}
template <>
std::span<const Key<Obstacle>> keys() {
  return kObstacle;
}
template <>
std::span<const Key<Plane>> keys() {
  return kPlane;
}
template <>
std::span<const Key<SceneCamera>> keys() {
  return kCamera;
}
template <>
std::span<const Key<SceneRender>> keys() {
  return kRender;
}

}  // namespace sprung
