#include "app/scene/scene_keys.h"

namespace sprung {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kPositive{.low = 0, .without_low = true};
constexpr Range kRatio{.low = 0, .high = 1};
constexpr int kSampleCounts[] = {1, 4, 16};
constexpr Range kZoom{.low = 0.01, .high = 100};

const Key<Film> kScene[] = {
    {{"materials", "file of further materials that bodies may name (TOML, as assets/materials.toml)"},
     &Film::materials},
    {{"duration", "length of the film", Dimension::kTime, {0, 3600, true}}, &Film::duration},
    {{"fps", "pictures a second", Dimension::kRate, {0, 10000, true}}, &Film::fps},
    {{"gravity", "acceleration of everything", Dimension::kAcceleration}, &Film::gravity},
    {{"gravity_keyframes", "gravity over time, in place of gravity"}, &Film::gravity_keyframes},
    {{"wind", "air that moves past all bodies"}, &Film::wind},
    {{"solver", "how the frames come about"}, &Film::solver},
    {{"contact", "what touches what, beside obstacles"}, &Film::contact},
    {{"camera", "where the film is seen from"}, &Film::camera},
    {{"render", "the pictures"}, &Film::render},
    {{"body", "a mesh or a shape made of a soft material", Dimension::kNone, {}, true}, &Film::bodies},
    {{"obstacle", "the ground and other things that are not soft"}, &Film::obstacles},
    {{"glue", "bodies that stay together where they touch at the start"}, &Film::glue},
    {{"probe", "what is measured in every frame"}, &Film::probes},
    {{"experiment", "what `sprung validate` varies"}, &Film::experiment},
    {{"expect", "what `sprung validate` compares with"}, &Film::expectations},
};

const Key<SceneSolver> kSolver[] = {
    {{"scheme",
      "motion by euler (symplectic), verlet, implicit-euler, bdf2 or auto; static or linear equilibrium; or modes"},
     &SceneSolver::scheme},
    {{"load_steps", "frames in which a static load grows", Dimension::kNone, {1, 100000}}, &SceneSolver::load_steps},
    {{"modes", "how many of the slowest vibrations", Dimension::kNone, {1, 1000}}, &SceneSolver::modes},
    {{"time_limit", "longest time that a motion may take to compute, by a forecast", Dimension::kTime, kPositive},
     &SceneSolver::time_limit},
};

const Key<Probe> kProbe[] = {
    {{"name", "of its columns", Dimension::kNone, {}, true}, &Probe::name},
    {{"body", "which one, counted from 1", Dimension::kNone, {1, kInfinity}}, &Probe::body},
    {{"point", "place in the body, from the middle of its bounding box", Dimension::kLength}, &Probe::point},
    {{"pin", "name of a pin of the body; instead of point"}, &Probe::pin},
};

const Key<Experiment> kExperiment[] = {
    {{"title", "of the experiment"}, &Experiment::title},
    {{"about", "what the report says about it"}, &Experiment::about},
    {{"nodes", "table of displacements known at points: poisson,x,y,z,ux,uy,uz"}, &Experiment::nodes},
    {{"models", "laws of the bricks"}, &Experiment::models},
    {{"poisson", "Poisson's ratios", Dimension::kNone, {-1, 0.5, true, true}}, &Experiment::poisson},
    {{"bricks", "numbers of bricks along the longest side", Dimension::kNone, {1, 1024}}, &Experiment::bricks},
};

const Key<Expectation> kExpectation[] = {
    {{"quantity", "\"tip.displacement.y\", \"end.torque.x\", \"frequency.1\", and so on", Dimension::kNone, {}, true},
     &Expectation::quantity},
    {{"value", "in SI units, in the last frame", Dimension::kNone, {}, true}, &Expectation::value},
    {{"source", "where the value is from", Dimension::kNone, {}, true}, &Expectation::source},
    {{"poisson", "Poisson's ratios that it holds for; all", Dimension::kNone, {-1, 0.5, true, true}},
     &Expectation::poisson},
    {{"bricks", "grids that it holds for, by the bricks along the longest side; all", Dimension::kNone, {1, 1024}},
     &Expectation::bricks},
    {{"models", "laws of the bricks that it holds for; all"}, &Expectation::models},
    {{"gate", "how near it has to be met"}, &Expectation::gates},
};

const Key<Gate> kGate[] = {
    {{"models", "who has to meet it; calibrated"}, &Gate::models},
    {{"bricks", "on which grids, by the bricks along the longest side; all", Dimension::kNone, {1, 1024}},
     &Gate::bricks},
    {{"tolerance", "relative error allowed; absolute where 0 is expected", Dimension::kRatio, {0, kInfinity}},
     &Gate::tolerance},
    {{"no_worse_than", "a model whose error on the same grid is the tolerance; instead of tolerance"},
     &Gate::no_worse_than},
};

const Key<SceneObstacle> kObstacle[] = {
    {{"plane", "all behind it is solid; or another shape: box, sphere, capsule, cylinder, mesh"},
     &SceneObstacle::plane},
    {{"box", "sides of a box", Dimension::kLength, kPositive}, &SceneObstacle::box},
    {{"sphere", "a ball"}, &SceneObstacle::sphere},
    {{"capsule", "a rod with round ends, along y"}, &SceneObstacle::capsule},
    {{"cylinder", "a rod with flat ends, along y"}, &SceneObstacle::cylinder},
    {{"mesh", "file of a closed surface, relative to the scene file"}, &SceneObstacle::mesh},
    {{"size", "longest side of the mesh", Dimension::kLength, kPositive}, &SceneObstacle::size},
    {{"scale", "length of one unit of the mesh file; instead of size", Dimension::kLength, kPositive},
     &SceneObstacle::scale},
    {{"position", "of its middle", Dimension::kLength}, &SceneObstacle::position},
    {{"rotation", "about x, then y, then z, around its middle", Dimension::kAngle}, &SceneObstacle::rotation},
    {{"keyframes", "how it moves from there"}, &SceneObstacle::keyframes},
    {{"interpolation", "between keyframes: linear or smooth"}, &SceneObstacle::interpolation},
    {{"friction", "Coulomb's coefficient", Dimension::kRatio, {0, kInfinity}}, &SceneObstacle::friction},
    {{"restitution", "speed after over speed before the impact of a point", Dimension::kRatio, kRatio},
     &SceneObstacle::restitution},
    {{"color", "\"#rrggbb\""}, &SceneObstacle::color},
};

const Key<Plane> kPlane[] = {
    {{"y", "height above the position", Dimension::kLength}, &Plane::y},
    {{"normal", "direction out of what is solid"}, &Plane::normal},
};

const Key<CapsuleShape> kCapsule[] = {
    {{"radius", "of the rod", Dimension::kLength, kPositive, true}, &CapsuleShape::radius},
    {{"height", "between the middles of its ends", Dimension::kLength, kPositive, true}, &CapsuleShape::height},
};

const Key<SceneContact> kContact[] = {
    {{"bodies", "whether bodies touch each other"}, &SceneContact::bodies},
    {{"self", "whether a body touches itself"}, &SceneContact::self},
};

const Key<SceneCamera> kCamera[] = {
    {{"azimuth", "direction of the camera about the vertical; 0 looks along -z", Dimension::kAngle},
     &SceneCamera::azimuth},
    {{"elevation", "height of the camera above the horizon", Dimension::kAngle, {-85, 85}}, &SceneCamera::elevation},
    {{"orbit", "how far it goes around over the film", Dimension::kAngle}, &SceneCamera::orbit},
    {{"zoom", "size in the picture over that at which everything is seen", Dimension::kRatio, kZoom},
     &SceneCamera::zoom},
    {{"follow", "whether it looks at the middle of the bodies in every frame"}, &SceneCamera::follow},
    {{"orthographic", "whether its lines of sight are parallel"}, &SceneCamera::orthographic},
    {{"aperture",
      "diameter of the lens: what is nearer or further than the bodies' middle is blurred",
      Dimension::kLength,
      {0, kInfinity}},
     &SceneCamera::aperture},
    {{"keyframes", "where it is at which times; instead of azimuth, elevation, orbit and zoom"},
     &SceneCamera::keyframes},
};

const Key<CameraKeyframe> kCameraKeyframe[] = {
    {{"t", "when", Dimension::kTime, {0, kInfinity}, true}, &CameraKeyframe::time},
    {{"azimuth", "direction of the camera about the vertical", Dimension::kAngle, {}, true}, &CameraKeyframe::azimuth},
    {{"elevation", "its height above the horizon", Dimension::kAngle, {-85, 85}}, &CameraKeyframe::elevation},
    {{"zoom", "size in the picture over that at which everything is seen", Dimension::kRatio, kZoom},
     &CameraKeyframe::zoom},
};

const Key<SceneRender> kRender[] = {
    {{"resolution", "width and height of the pictures in pixels", Dimension::kNone, {16, 8192}},
     &SceneRender::resolution},
    {{"quality", "preview (quick), default or high (slow): of shadows and edges"}, &SceneRender::quality},
    {{"samples", "samples a pixel; as the quality has it", Dimension::kNone, {1, 16}, false, kSampleCounts},
     &SceneRender::samples},
    {{"transparent", "nothing behind the bodies: pictures with alpha, no floor"}, &SceneRender::transparent},
    {{"environment", "panorama, .hdr or .png, twice as wide as high, whose light is that around the bodies"},
     &SceneRender::environment},
    {{"motion_blur", "how long the shutter is open, of 360 degrees a frame", Dimension::kAngle, {0, 360}},
     &SceneRender::motion_blur},
    {{"sheet", "columns and rows of frames, evenly over the film, in one picture", Dimension::kNone, {1, 100}},
     &SceneRender::sheet},
    {{"color_by",
      "what colours show: skin, displacement, speed, stretch, strain or stress (von Mises), volume, fill or region"},
     &SceneRender::color_by},
    {{"color_map", "viridis, cividis, coolwarm, ember or turbo; by what is shown"}, &SceneRender::color_map},
    {{"color_low", "SI value of the first colour; the lowest of the film"}, &SceneRender::color_low},
    {{"color_high", "SI value of the last colour; the highest of the film but for its utmost half per cent"},
     &SceneRender::color_high},
    {{"legend", "whether the colours are explained"}, &SceneRender::legend},
    {{"caption", "a line at the top"}, &SceneRender::caption},
    {{"frame_number", "whether frame and time are written"}, &SceneRender::frame_number},
    {{"scale_bar", "whether a bar of a round length is drawn"}, &SceneRender::scale_bar},
    {{"bricks", "bricks in place of the skins: none, whole or exploded"}, &SceneRender::bricks},
    {{"cut", "takes away the bricks on one side of a plane; with bricks, springs or nodes"}, &SceneRender::cut},
    {{"springs", "whether springs are drawn, coloured by their stretch, in place of the skins"}, &SceneRender::springs},
    {{"nodes", "whether nodes are drawn"}, &SceneRender::nodes},
    {{"pins", "whether held nodes are drawn"}, &SceneRender::pins},
    {{"ghost", "whether the shape at rest shows faintly"}, &SceneRender::ghost},
    {{"contacts", "whether places are marked where bodies touch the ground, obstacles or each other"},
     &SceneRender::contacts},
    {{"traces", "whether the ways of the probes are drawn"}, &SceneRender::traces},
    {{"plots", "whether a plot shows how far the probes are from where they were"}, &SceneRender::plots},
};

using Kind = KeyRule::Kind;

}  // namespace

template <>
std::span<const Key<Film>> keys() {
  return kScene;
}
template <>
std::span<const Key<CapsuleShape>> keys() {
  return kCapsule;
}
template <>
std::span<const Key<SceneContact>> keys() {
  return kContact;
}
template <>
std::span<const Key<SceneObstacle>> keys() {
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
std::span<const Key<CameraKeyframe>> keys() {
  return kCameraKeyframe;
}
template <>
std::span<const Key<SceneRender>> keys() {
  return kRender;
}
template <>
std::span<const Key<SceneSolver>> keys() {
  return kSolver;
}
template <>
std::span<const Key<Probe>> keys() {
  return kProbe;
}
template <>
std::span<const Key<Experiment>> keys() {
  return kExperiment;
}
template <>
std::span<const Key<Gate>> keys() {
  return kGate;
}
template <>
std::span<const Key<Expectation>> keys() {
  return kExpectation;
}
template <>
std::span<const KeyRule> rules<SceneObstacle>() {
  static const std::vector<KeyRule> all{{Kind::kOneOf, {"plane", "box", "sphere", "capsule", "cylinder", "mesh"}},
                                        {Kind::kAtMostOne, {"size", "scale"}},
                                        {Kind::kNeeds, {"size", "mesh"}},
                                        {Kind::kNeeds, {"scale", "mesh"}}};
  return all;
}
template <>
std::span<const KeyRule> rules<Probe>() {
  static const std::vector<KeyRule> all{{Kind::kOneOf, {"point", "pin"}}};
  return all;
}
template <>
std::span<const KeyRule> rules<Gate>() {
  static const std::vector<KeyRule> all{{Kind::kOneOf, {"tolerance", "no_worse_than"}}};
  return all;
}

}  // namespace sprung
