#include "app/scene/selection_keys.h"

namespace sprung {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kPositive{.low = 0, .without_low = true};

const Key<SceneBody> kBody[] = {
    {{"mesh", "file of the surface, relative to the scene file; or a shape: box, sphere, cylinder, torus"},
     &SceneBody::mesh},
    {{"box", "sides of a box of whole bricks", Dimension::kLength, kPositive}, &SceneBody::box},
    {{"sphere", "a ball"}, &SceneBody::sphere},
    {{"cylinder", "an upright cylinder"}, &SceneBody::cylinder},
    {{"torus", "a ring that lies flat"}, &SceneBody::torus},
    {{"texture", "picture on the skin, placed by the mesh's UVs, in place of what its file names"},
     &SceneBody::texture},
    {{"cut", "parts taken out of a box"}, &SceneBody::cuts},
    {{"size", "longest side of the body", Dimension::kLength, {.low = 1e-6, .high = 1e6}}, &SceneBody::size},
    {{"scale", "length of one unit of the mesh file; instead of size", Dimension::kLength, kPositive},
     &SceneBody::scale},
    {{"repair", "of the mesh: auto mends and says what, strict refuses what needs it, off takes it as it is"},
     &SceneBody::repair},
    {{"thickness", "makes the surface of the mesh the middle of a shell of this thickness", Dimension::kLength,
      kPositive},
     &SceneBody::thickness},
    {{"position", "where the middle of the bottom of its bounding box goes", Dimension::kLength}, &SceneBody::position},
    {{"rotation", "about x, then y, then z, around its middle", Dimension::kAngle}, &SceneBody::rotation},
    {{"bricks", "number of bricks along the longest side; or auto: by the thinnest part", Dimension::kNone, {1, 1024}},
     &SceneBody::bricks},
    {{"brick_size", "side of a brick; instead of bricks", Dimension::kLength, kPositive}, &SceneBody::brick_size},
    {{"brick_rotation", "how the bricks are turned in the body, about x, then y, then z", Dimension::kAngle},
     &SceneBody::brick_rotation},
    {{"material", "a name from `sprung materials`; in a scene also { young, poisson, density, damping }"},
     &SceneBody::material},
    {{"model", "law of the bricks: calibrated, tensile (Baudet et al. 2009), m1, m2-plain, m1-plain or fem"},
     &SceneBody::model},
    {{"color", "of what the mesh file leaves without colour: \"#rrggbb\""}, &SceneBody::color},
    {{"look", "how it takes light: plastic, gelatin, rubber or steel; as the material has it"}, &SceneBody::look},
    {{"skin", "how it rides on the bricks: bricks (each by itself) or smooth (across them)"}, &SceneBody::skin},
    {{"velocity", "at the start", Dimension::kSpeed}, &SceneBody::velocity},
    {{"spin", "turning at the start, about the axes of the world through its middle", Dimension::kTurning},
     &SceneBody::spin},
    {{"friction",
      "Coulomb's coefficient on other bodies: the geometric mean of both",
      Dimension::kRatio,
      {0, kInfinity}},
     &SceneBody::friction},
    {{"copies", "the same body many times, in rows"}, &SceneBody::copies},
    {{"pin", "parts that are held or carried"}, &SceneBody::pins},
    {{"region", "parts of another material"}, &SceneBody::regions},
    {{"force", "forces and pressures"}, &SceneBody::forces},
    {{"muscle", "parts that contract"}, &SceneBody::muscles},
};

const Key<SphereShape> kSphere[] = {
    {{"radius", "of the ball", Dimension::kLength, kPositive, true}, &SphereShape::radius},
};

const Key<CylinderShape> kCylinder[] = {
    {{"radius", "of the circle", Dimension::kLength, kPositive, true}, &CylinderShape::radius},
    {{"height", "along its axis", Dimension::kLength, kPositive, true}, &CylinderShape::height},
};

const Key<TorusShape> kTorus[] = {
    {{"radius", "of the circle in the middle of the tube", Dimension::kLength, kPositive, true}, &TorusShape::radius},
    {{"tube", "radius of the tube", Dimension::kLength, kPositive, true}, &TorusShape::tube},
};

const Key<Copies> kCopies[] = {
    {{"count", "how many along x, y and z", Dimension::kNone, {1, 1000}, true}, &Copies::count},
    {{"spacing", "from one to the next along each axis", Dimension::kLength, {}, true}, &Copies::spacing},
    {{"scatter", "each is moved at random by up to this along each axis", Dimension::kLength, {0, kInfinity}},
     &Copies::scatter},
    {{"turn", "each is turned by up to this about an axis at random", Dimension::kAngle, {0, 180}}, &Copies::turn},
    {{"seed", "of what is random", Dimension::kNone, {0, 2147483647}}, &Copies::seed},
};

const Key<Material> kMaterial[] = {
    {{"young", "Young's modulus", Dimension::kPressure, kPositive, true}, &Material::young},
    {{"poisson", "Poisson's ratio", Dimension::kNone, {-1, 0.5, true, true}, true}, &Material::poisson},
    {{"density", "density", Dimension::kDensity, kPositive, true}, &Material::density},
    {{"damping", "ratio of critical damping at the slowest vibration", Dimension::kRatio, {0, 10}}, &Material::damping},
};

const Key<Pin> kPinOnly[] = {
    {{"name", "for probes"}, &Pin::name},
    {{"axes", "the directions that are held: \"xyz\", \"x\", \"yz\", and so on"}, &Pin::axes},
    {{"translate", "how far they are carried by the end of the film", Dimension::kLength}, &Pin::translate},
    {{"rotate", "how far they are turned about the middle of the part by then", Dimension::kAngle}, &Pin::rotate},
    {{"keyframes", "where they are at which times"}, &Pin::keyframes},
    {{"interpolation", "between keyframes: linear, smooth or held"}, &Pin::interpolation},
    {{"from", "when they are taken, where they then are", Dimension::kTime, {0, kInfinity}}, &Pin::from},
    {{"until", "when they are let go; never", Dimension::kTime, kPositive}, &Pin::until},
};

const Key<Keyframe> kKeyframe[] = {
    {{"t", "when", Dimension::kTime, {0, kInfinity}, true}, &Keyframe::time},
    {{"translate", "how far from the start", Dimension::kLength}, &Keyframe::translate},
    {{"rotate", "how far turned about x, then y, then z", Dimension::kAngle}, &Keyframe::rotate},
    {{"scale", "size over size at the start", Dimension::kRatio, kPositive}, &Keyframe::scale},
};

const Key<Region> kRegionOnly[] = {
    {{"material", "what they are made of", Dimension::kNone, {}, true}, &Region::material},
    {{"gradient", "a change to another material along a line"}, &Region::gradient},
};

const Key<Gradient> kGradient[] = {
    {{"from",
      "where the region's material begins to change, in fractions of the body's bounding box",
      Dimension::kRatio,
      {},
      true},
     &Gradient::from},
    {{"to", "where it is this one", Dimension::kRatio, {}, true}, &Gradient::to},
    {{"material", "what it changes to", Dimension::kNone, {}, true}, &Gradient::material},
};

const Key<Box> kBox[] = {
    {{"min", "low corner", Dimension::kRatio, {}, true}, &Box::min},
    {{"max", "high corner", Dimension::kRatio, {}, true}, &Box::max},
};

const Key<Ball> kBall[] = {
    {{"center", "in fractions of the body's bounding box", Dimension::kRatio, {}, true}, &Ball::centre},
    {{"radius", "in longest sides of the body's bounding box", Dimension::kRatio, kPositive, true}, &Ball::radius},
};

const Key<HalfSpace> kHalfSpace[] = {
    {{"point", "of the plane, in fractions of the body's bounding box", Dimension::kRatio, {}, true},
     &HalfSpace::point},
    {{"normal", "to the side that is meant", Dimension::kNone, {}, true}, &HalfSpace::normal},
};

using Kind = KeyRule::Kind;

}  // namespace

template <>
std::span<const Key<SceneBody>> keys() {
  return kBody;
}
template <>
std::span<const Key<SphereShape>> keys() {
  return kSphere;
}
template <>
std::span<const Key<CylinderShape>> keys() {
  return kCylinder;
}
template <>
std::span<const Key<TorusShape>> keys() {
  return kTorus;
}
template <>
std::span<const Key<Copies>> keys() {
  return kCopies;
}
template <>
std::span<const Key<Material>> keys() {
  return kMaterial;
}
template <>
std::span<const Key<Pin>> keys() {
  static const std::vector<Key<Pin>> all = selection_and<Pin>(kPinOnly);
  return all;
}
template <>
std::span<const Key<Keyframe>> keys() {
  return kKeyframe;
}
template <>
std::span<const Key<Region>> keys() {
  static const std::vector<Key<Region>> all = selection_and<Region>(kRegionOnly);
  return all;
}
template <>
std::span<const Key<Gradient>> keys() {
  return kGradient;
}
template <>
std::span<const Key<Cut>> keys() {
  static const std::vector<Key<Cut>> all = selection_and<Cut>({});
  return all;
}
template <>
std::span<const Key<Box>> keys() {
  return kBox;
}
template <>
std::span<const Key<Ball>> keys() {
  return kBall;
}
template <>
std::span<const Key<HalfSpace>> keys() {
  return kHalfSpace;
}

template <>
std::span<const KeyRule> rules<SceneBody>() {
  static const std::vector<KeyRule> all{{Kind::kOneOf, {"mesh", "box", "sphere", "cylinder", "torus"}},
                                        {Kind::kAtMostOne, {"size", "scale"}},
                                        {Kind::kAtMostOne, {"bricks", "brick_size"}},
                                        {Kind::kNeeds, {"size", "mesh"}},
                                        {Kind::kNeeds, {"scale", "mesh"}},
                                        {Kind::kNeeds, {"texture", "mesh"}},
                                        {Kind::kNeeds, {"thickness", "mesh"}},
                                        {Kind::kNeeds, {"cut", "box"}}};
  return all;
}
template <>
std::span<const KeyRule> rules<Pin>() {
  static const std::vector<KeyRule> all{one_selection(Kind::kOneOf),
                                        {Kind::kAtMostOne, {"translate", "keyframes"}},
                                        {Kind::kAtMostOne, {"rotate", "keyframes"}}};
  return all;
}
template <>
std::span<const KeyRule> rules<Region>() {
  static const std::vector<KeyRule> all = [] {
    KeyRule any = one_selection(Kind::kAnyOf);
    any.keys.emplace_back("gradient");
    return std::vector<KeyRule>{one_selection(Kind::kAtMostOne), any};
  }();
  return all;
}
template <>
std::span<const KeyRule> rules<Cut>() {
  static const std::vector<KeyRule> all{one_selection(Kind::kOneOf)};
  return all;
}

}  // namespace sprung
