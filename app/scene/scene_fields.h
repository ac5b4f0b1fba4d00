#pragma once
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "app/scene/film.h"
#include "core/units.h"

// The keys of a scene file: one function for each table, which names its keys once for the reader, the writer, --set,
// the reference and the schema. fields(visit, owner) calls visit.table(name, rules) and then visit(key, owner.member)
// for every key; the value of a new owner is the default of the key.

namespace sprung {

/// The contents of a file of materials.
struct MaterialFile {
  std::vector<LibraryMaterial> materials;
};

/// The numbers that a key accepts.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool without_low = false;  // low itself is outside
  bool without_high = false;
};

struct KeyInfo {
  std::string_view name;
  std::string_view help;
  Dimension dimension = Dimension::kNone;
  Range range{};
  bool required = false;
  std::span<const int> choices{};  // if not empty: the only numbers it accepts
};

[[nodiscard]] inline KeyInfo required(KeyInfo key) {
  key.required = true;
  return key;
}

/// A rule between the keys of one table.
struct KeyRule {
  enum Relation {
    kOneOf,      // exactly one of them
    kAnyOf,      // one at least
    kAtMostOne,  // two exclude each other
    kNeeds       // the first only with the second
  };
  Relation relation;
  std::vector<std::string_view> keys;
};

/// Base of visitors that ignore the name and the rules of a table.
struct FieldVisitor {
  void table(std::string_view /*name*/, const std::vector<KeyRule>& /*rules*/ = {}) {}
};

/// A struct that is a table of a scene file: one that has fields() below.
template <class Value>
concept Table = requires(Value& value, FieldVisitor& visit) {
  fields(visit, value);
};

/// Owner, which may be const.
template <class Value, class Owner>
concept Is = std::is_same_v<std::remove_const_t<Value>, Owner>;

/// A table's contents if a file omits all its keys.
template <Table Owner>
[[nodiscard]] Owner default_table() {
  if constexpr (Is<Owner, SceneBody>) return default_body();
  return Owner{};
}

inline constexpr Range kPositive{.low = 0, .without_low = true};
inline constexpr Range kNotNegative{.low = 0};
inline constexpr Range kCounted{.low = 1};  // from 1
inline constexpr Range kPoisson{-1, 0.5, true, true};
inline const KeyInfo kPoissonInMotion{
    "poisson_in_motion",
    "Poisson's ratio in motions, whose explicit steps at 0.499 are a seventh of those at 0.45; default: poisson",
    Dimension::kNone, kPoisson};
inline constexpr Range kZoom{0.01, 100};
inline constexpr int kSampleCounts[] = {1, 4, 8, 16, 32, 64, 128, 256, 512, 1024};

inline const std::vector<std::string_view> kSelectionKeys{"box",     "sphere", "half_space", "part",
                                                          "painted", "face",   "nearest",    "mesh"};

/// The keys that select a part of a body, for any purpose.
void selection_fields(auto& visit, auto& part) {
  visit({"box", "the part in a box, in fractions of the body's bounding box"}, part.box);
  visit({"sphere", "the part in a ball, in fractions of the body's bounding box"}, part.sphere);
  visit({"half_space", "the part on one side of a plane"}, part.half_space);
  visit({"part", "what lies nearest to the part of the mesh of this name, else to those of a material of this name"},
        part.part);
  visit({"painted", "what lies nearest to the vertices of this colour: \"#rrggbb\""}, part.painted);
  visit({"face",
         "what lies nearest to the face of the mesh at a point in fractions of the bounding box: all that is "
         "flat there, else all up to sharp edges",
         Dimension::kRatio},
        part.face);
  visit({"nearest", "the one node or brick nearest to a point, in fractions of the body's bounding box",
         Dimension::kRatio},
        part.nearest);
  visit({"mesh", "what a closed mesh encloses: its file, in units and frame of the body's own mesh"}, part.mesh);
}

/// The keys for the strength of any load over time.
void curve_fields(auto& visit, auto& load) {
  visit({"keyframes", "strength over time"}, load.keyframes);
  visit({"interpolation", "between keyframes: linear, smooth or held"}, load.interpolation);
}

void fields(auto& visit, Is<Film> auto& film) {
  visit.table("scene");
  visit({"materials", "file of further materials that bodies may name (TOML, as assets/materials.toml)"},
        film.materials);
  visit({"duration", "length of the film", Dimension::kTime, {0, 3600, true}}, film.duration);
  visit({"until_still", "from this time on the film ends early, once nothing moves any more", Dimension::kTime,
         kNotNegative},
        film.until_still);
  visit({"fps", "pictures a second", Dimension::kRate, {0, 10000, true}}, film.fps);
  visit({"gravity", "acceleration of everything", Dimension::kAcceleration}, film.gravity);
  visit({"gravity_keyframes", "gravity over time, in place of gravity"}, film.gravity_keyframes);
  visit({"wind", "wind on all bodies"}, film.wind);
  visit({"solver", "integrator, or kind of solution"}, film.solver);
  visit({"contact", "which collisions are resolved, besides those with obstacles"}, film.contact);
  visit({"camera", "the camera"}, film.camera);
  visit({"render", "the pictures"}, film.render);
  visit(required({"body", "a mesh or a shape made of a soft material"}), film.bodies);
  visit({"obstacle", "the ground and other things that are not soft"}, film.obstacles);
  visit({"glue", "bodies bonded where they touch at the start"}, film.glue);
  visit({"probe", "measurements taken in every frame"}, film.probes);
  visit({"experiment", "what `sprung validate` varies"}, film.experiment);
  visit({"expect", "what `sprung validate` compares with"}, film.expectations);
}

void fields(auto& visit, Is<SceneSolver> auto& solver) {
  visit.table("solver");
  visit({"scheme",
         "motion by euler (symplectic), verlet, implicit-euler, bdf2 or auto; static or linear equilibrium; or modes"},
        solver.scheme);
  visit({"load_steps", "increments of a static load, one a frame", Dimension::kNone, {1, 100000}}, solver.load_steps);
  visit({"modes", "number of the lowest vibration modes", Dimension::kNone, {1, 1000}}, solver.modes);
  visit({"time_limit", "longest computing time, predicted or spent, that is accepted", Dimension::kTime, kPositive},
        solver.time_limit);
}

void fields(auto& visit, Is<SceneContact> auto& contact) {
  visit.table("contact");
  visit({"bodies", "whether bodies collide with each other"}, contact.bodies);
  visit({"self", "whether a body collides with itself"}, contact.self);
}

void fields(auto& visit, Is<SceneCamera> auto& camera) {
  visit.table("camera");
  visit({"azimuth", "direction of the camera about the vertical; 0 looks along -z", Dimension::kAngle}, camera.azimuth);
  visit({"elevation", "height of the camera above the horizon", Dimension::kAngle, {-85, 85}}, camera.elevation);
  visit({"orbit", "angle by which the camera orbits over the film", Dimension::kAngle}, camera.orbit);
  visit({"zoom", "magnification; at 1 everything fits in the picture", Dimension::kRatio, kZoom}, camera.zoom);
  visit({"body_height",
         "largest fraction of the picture's height that the bodies take in the last frame",
         Dimension::kRatio,
         {0.05, 1}},
        camera.body_height);
  visit({"follow", "whether the camera tracks the centre of the bodies"}, camera.follow);
  visit({"orthographic", "whether the projection is orthographic"}, camera.orthographic);
  visit({"aperture", "lens diameter; what is nearer or farther than the centre of the bodies is blurred",
         Dimension::kLength, kNotNegative},
        camera.aperture);
  visit({"keyframes", "camera over time; instead of azimuth, elevation, orbit and zoom"}, camera.keyframes);
}

void fields(auto& visit, Is<CameraKeyframe> auto& keyframe) {
  visit.table("camera keyframe");
  visit(required({"t", "time", Dimension::kTime, kNotNegative}), keyframe.time);
  visit(required({"azimuth", "direction of the camera about the vertical", Dimension::kAngle}), keyframe.azimuth);
  visit({"elevation", "height of the camera above the horizon", Dimension::kAngle, {-85, 85}}, keyframe.elevation);
  visit({"zoom", "magnification; at 1 everything fits in the picture", Dimension::kRatio, kZoom}, keyframe.zoom);
}

void fields(auto& visit, Is<SceneRender> auto& render) {
  visit.table("render", {{KeyRule::kNeeds, {"environment_turn", "environment"}},
                         {KeyRule::kNeeds, {"environment_sun", "environment"}},
                         {KeyRule::kNeeds, {"environment_background", "environment"}},
                         {KeyRule::kNeeds, {"floor_size", "floor"}}});
  visit({"resolution", "width and height of the pictures in pixels", Dimension::kNone, {16, 8192}}, render.resolution);
  visit({"quality", "preview (fast), default, high or final (paths of light; slow)"}, render.quality);
  visit({"samples",
         "per pixel: 1, 4 or 16, in final quality 1 to 1024; default: by the quality",
         Dimension::kNone,
         {1, 1024},
         false,
         kSampleCounts},
        render.samples);
  visit({"smooth", "whether coarse meshes are drawn smooth; what is computed and exported keeps their triangles"},
        render.smooth);
  visit({"transparent", "transparent background: pictures with alpha, no floor"}, render.transparent);
  visit({"light", "studio, softbox, sunset, overcast or night"}, render.light);
  visit({"key_light", "what differs from the key light of that preset"}, render.key_light);
  visit({"environment", "panorama (.hdr or .png, twice as wide as high) that lights the bodies"}, render.environment);
  visit({"environment_turn", "angle by which the panorama turns about the vertical; default 0", Dimension::kAngle},
        render.environment_turn);
  visit({"environment_sun", "whether the key light is the panorama's sun, where it has one; default true"},
        render.environment_sun);
  visit({"environment_background", "whether the panorama is seen behind the bodies; default false"},
        render.environment_background);
  visit({"floor", "sweep (without a horizon), plain, checker, wood or none"}, render.floor);
  visit({"floor_size", "side of a square or width of a board; default: by the bodies", Dimension::kLength, kPositive},
        render.floor_size);
  visit({"motion_blur", "shutter angle; 360 degrees: open for the whole frame", Dimension::kAngle, {0, 360}},
        render.motion_blur);
  visit(
      {"sheet", "columns and rows of frames, evenly spaced over the film, in one picture", Dimension::kNone, {1, 100}},
      render.sheet);
  visit({"color_by",
         "what colours show: skin, displacement, speed, stretch, strain or stress (von Mises), volume, fill or region"},
        render.color_by);
  visit({"color_map", "viridis, cividis, coolwarm, ember or turbo; by what is shown"}, render.color_map);
  visit({"color_range", "what the colours span: the values of the film, or of each frame; a sheet has the film's"},
        render.color_range);
  visit({"color_low", "SI value of the first colour; default: the lowest of that range"}, render.color_low);
  visit(
      {"color_high", "SI value of the last colour; default: the highest of that range, without its top half per cent"},
      render.color_high);
  visit({"legend", "whether a legend of the colours is drawn"}, render.legend);
  visit({"caption", "a line at the top"}, render.caption);
  visit({"frame_number", "whether frame number and time are drawn"}, render.frame_number);
  visit({"scale_bar", "whether a scale bar is drawn"}, render.scale_bar);
  visit({"bricks", "bricks in place of the skins: none, whole or exploded"}, render.bricks);
  visit({"cut", "removes the bricks on one side of a plane; with bricks, springs or nodes"}, render.cut);
  visit({"springs", "whether springs are drawn, coloured by their stretch, in place of the skins"}, render.springs);
  visit({"edges", "whether the edges of the mesh are drawn; its triangles are not drawn smooth then"}, render.edges);
  visit({"nodes", "whether nodes are drawn"}, render.nodes);
  visit({"pins", "whether pinned nodes are drawn"}, render.pins);
  visit({"ghost", "whether the rest shape is drawn faintly"}, render.ghost);
  visit({"contacts", "whether contacts with the ground, obstacles and other bodies are marked"}, render.contacts);
  visit({"traces", "whether the paths of the probes are drawn"}, render.traces);
  visit({"plots", "whether the displacement of the probes is plotted"}, render.plots);
}

void fields(auto& visit, Is<SceneKeyLight> auto& light) {
  visit.table("key light");
  visit({"azimuth", "direction of the light about the vertical, as a camera's", Dimension::kAngle}, light.azimuth);
  visit({"elevation", "height of the light above the horizon", Dimension::kAngle, {5, 89}}, light.elevation);
  visit({"size", "angle across, as bodies see it: how soft shadows are", Dimension::kAngle, {0.5, 50}}, light.size);
  visit({"color", "of the light; white is as bright as the preset's"}, light.color);
  visit({"strength", "factor of its brightness", Dimension::kRatio, {0, 10}}, light.strength);
}

void fields(auto& visit, Is<SceneBody> auto& body) {
  visit.table("body", {{KeyRule::kOneOf, {"mesh", "box", "sphere", "cylinder", "torus"}},
                       {KeyRule::kAtMostOne, {"size", "scale"}},
                       {KeyRule::kAtMostOne, {"bricks", "brick_size"}},
                       {KeyRule::kNeeds, {"size", "mesh"}},
                       {KeyRule::kNeeds, {"scale", "mesh"}},
                       {KeyRule::kNeeds, {"texture", "mesh"}},
                       {KeyRule::kNeeds, {"thickness", "mesh"}},
                       {KeyRule::kNeeds, {"cut", "box"}}});
  visit({"mesh", "file of the surface, relative to the scene file; or a shape: box, sphere, cylinder, torus"},
        body.mesh);
  visit({"box", "sides of a box of whole bricks", Dimension::kLength, kPositive}, body.box);
  visit({"sphere", "a ball"}, body.sphere);
  visit({"cylinder", "an upright cylinder"}, body.cylinder);
  visit({"torus", "a ring that lies flat"}, body.torus);
  visit({"texture", "picture on the skin, placed by the mesh's UVs, in place of what its file names"}, body.texture);
  visit({"cut", "parts taken out of a box"}, body.cuts);
  visit({"size", "longest side of the body", Dimension::kLength, {.low = 1e-6, .high = 1e6}}, body.size);
  visit({"scale", "length of one unit of the mesh file; instead of size", Dimension::kLength, kPositive}, body.scale);
  visit(
      {"repair",
       "of the mesh: auto repairs defects and reports them, strict refuses a mesh with defects, off uses it as it is"},
      body.repair);
  visit({"thickness", "makes the mesh the mid-surface of a shell of this thickness", Dimension::kLength, kPositive},
        body.thickness);
  visit({"position", "of the centre of the bottom of its bounding box", Dimension::kLength}, body.position);
  visit({"rotation", "about x, then y, then z, around its centre", Dimension::kAngle}, body.rotation);
  visit(
      {"bricks", "number of bricks along the longest side; or auto: by the thinnest part", Dimension::kNone, {1, 1024}},
      body.bricks);
  visit({"brick_size", "side of a brick; instead of bricks", Dimension::kLength, kPositive}, body.brick_size);
  visit({"brick_rotation", "orientation of the bricks in the body, about x, then y, then z", Dimension::kAngle},
        body.brick_rotation);
  visit({"material",
         "a name from `sprung materials`; auto: the softest that carries the body; in a scene also { young, poisson, "
         "density, damping, law }"},
        body.material);
  visit({"model",
         "law of the bricks: calibrated (by the solid in each), tensile (Baudet et al. "
         "2009), m1, m2-plain, m1-plain or fem"},
        body.model);
  visit({"color", "\"#rrggbb\" where the mesh file gives no colour"}, body.color);
  visit({"look", "surface finish: plastic, gelatin, rubber or steel; default: by the material"}, body.look);
  visit({"skin", "how the skin is interpolated: bricks (trilinear in each) or smooth (across them)"}, body.skin);
  visit({"velocity", "initial velocity", Dimension::kSpeed}, body.velocity);
  visit({"spin", "initial angular velocity, about the axes of the world through its centre", Dimension::kTurning},
        body.spin);
  visit({"friction", "Coulomb friction coefficient; between bodies the geometric mean of the two", Dimension::kRatio,
         kNotNegative},
        body.friction);
  visit({"copies", "the same body many times, in rows"}, body.copies);
  visit({"pin", "parts that are held or moved"}, body.pins);
  visit({"region", "parts of another material"}, body.regions);
  visit({"force", "forces and pressures"}, body.forces);
  visit({"muscle", "parts that contract"}, body.muscles);
}

void fields(auto& visit, Is<SphereShape> auto& sphere) {
  visit.table("sphere shape");
  visit(required({"radius", "of the ball", Dimension::kLength, kPositive}), sphere.radius);
}

void fields(auto& visit, Is<CylinderShape> auto& cylinder) {
  visit.table("cylinder shape");
  visit(required({"radius", "of the circle", Dimension::kLength, kPositive}), cylinder.radius);
  visit(required({"height", "along its axis", Dimension::kLength, kPositive}), cylinder.height);
}

void fields(auto& visit, Is<TorusShape> auto& torus) {
  visit.table("torus shape");
  visit(required({"radius", "from the centre to the middle of the tube", Dimension::kLength, kPositive}), torus.radius);
  visit(required({"tube", "radius of the tube", Dimension::kLength, kPositive}), torus.tube);
}

void fields(auto& visit, Is<CapsuleShape> auto& capsule) {
  visit.table("capsule shape");
  visit(required({"radius", "of the rod", Dimension::kLength, kPositive}), capsule.radius);
  visit(required({"height", "between the centres of its ends", Dimension::kLength, kPositive}), capsule.height);
}

void law_fields(auto& visit, Is<StrainEnergyLaw> auto& law) {
  visit({"law",
         "strain energy at large strains: neo-hooke, mooney-rivlin, ogden, fung or linear (St. Venant-Kirchhoff); of "
         "the calibrated model"},
        law.kind);
  visit({"mooney_share", "of mooney-rivlin: C2 / (C1 + C2)", Dimension::kRatio, {0, 1}}, law.mooney_share);
  visit({"fung_exponent", "b of fung, exp(b (I1 - 3))", Dimension::kNone, kPositive}, law.fung_exponent);
  visit({"ogden_exponents", "alpha of each term of ogden", Dimension::kNone}, law.ogden_exponents);
  visit({"ogden_shares", "of each term in the shear modulus; they add up to 1", Dimension::kRatio, {0, 1}},
        law.ogden_shares);
}

/// A curve stands in place of Young's modulus and of the parameters of the law.
inline const std::vector<KeyRule>& rules_of_curve() {
  static const std::vector<KeyRule> rules{{KeyRule::kOneOf, {"young", "curve"}},
                                          {KeyRule::kAtMostOne, {"curve", "mooney_share"}},
                                          {KeyRule::kAtMostOne, {"curve", "fung_exponent"}},
                                          {KeyRule::kAtMostOne, {"curve", "ogden_exponents"}},
                                          {KeyRule::kAtMostOne, {"curve", "ogden_shares"}}};
  return rules;
}

void fields(auto& visit, Is<Material> auto& material) {
  visit.table("material", rules_of_curve());
  visit({"young", "Young's modulus", Dimension::kPressure, kPositive}, material.young);
  visit(required({"poisson", "Poisson's ratio", Dimension::kNone, kPoisson}), material.poisson);
  visit(kPoissonInMotion, material.poisson_in_motion);
  visit(required({"density", "density", Dimension::kDensity, kPositive}), material.density);
  visit({"damping", "ratio of critical damping at the slowest vibration", Dimension::kRatio, {0, 10}},
        material.damping);
  law_fields(visit, material.law);
  visit(
      {"curve",
       "of a tension test, a table of stretch and nominal stress; in place of young: it and the law are fitted to it"},
      material.curve);
}

void fields(auto& visit, Is<Copies> auto& copies) {
  visit.table("copies");
  visit(required({"count", "how many along x, y and z", Dimension::kNone, {1, 1000}}), copies.count);
  visit(required({"spacing", "from one to the next along each axis", Dimension::kLength}), copies.spacing);
  visit({"scatter", "random offset of each copy, up to this along each axis", Dimension::kLength, kNotNegative},
        copies.scatter);
  visit({"turn", "random rotation of each copy, up to this", Dimension::kAngle, {0, 180}}, copies.turn);
  visit({"seed", "of the random numbers", Dimension::kNone, {0, 2147483647}}, copies.seed);
}

void fields(auto& visit, Is<Box> auto& box) {
  visit.table("box");
  visit(required({"min", "low corner", Dimension::kRatio}), box.min);
  visit(required({"max", "high corner", Dimension::kRatio}), box.max);
}

void fields(auto& visit, Is<Ball> auto& ball) {
  visit.table("ball");
  visit(required({"center", "in fractions of the body's bounding box", Dimension::kRatio}), ball.centre);
  visit(required({"radius", "in longest sides of the body's bounding box", Dimension::kRatio, kPositive}), ball.radius);
}

void fields(auto& visit, Is<HalfSpace> auto& half_space) {
  visit.table("half-space");
  visit(required({"point", "of the plane, in fractions of the body's bounding box", Dimension::kRatio}),
        half_space.point);
  visit(required({"normal", "towards the selected side"}), half_space.normal);
}

void fields(auto& visit, Is<Cut> auto& cut) {
  visit.table("cut", {{KeyRule::kOneOf, kSelectionKeys}});
  selection_fields(visit, cut);
}

void fields(auto& visit, Is<Pin> auto& pin) {
  visit.table("pin", {{KeyRule::kOneOf, kSelectionKeys},
                      {KeyRule::kAtMostOne, {"translate", "keyframes"}},
                      {KeyRule::kAtMostOne, {"rotate", "keyframes"}}});
  selection_fields(visit, pin);
  visit({"name", "for probes"}, pin.name);
  visit({"axes", "the directions that are held: \"xyz\", \"x\", \"yz\", and so on"}, pin.axes);
  visit({"on_surface", "true: holds the part's skin and not its nodes, wherever the bricks lie"}, pin.on_surface);
  visit({"normal", "with on_surface, in place of axes: held along this direction only, and free to slide across it"},
        pin.normal);
  visit({"translate", "translation by the end of the film", Dimension::kLength}, pin.translate);
  visit({"rotate", "rotation by the end of the film, about the centre of the part", Dimension::kAngle}, pin.rotate);
  visit({"keyframes", "movement over time"}, pin.keyframes);
  visit({"interpolation", "between keyframes: linear, smooth or held"}, pin.interpolation);
  visit({"from", "when the pin takes hold of its nodes, wherever they are then", Dimension::kTime, kNotNegative},
        pin.from);
  visit({"until", "when the pin releases its nodes; default: never", Dimension::kTime, kPositive}, pin.until);
}

void fields(auto& visit, Is<Keyframe> auto& keyframe) {
  visit.table("keyframe");
  visit(required({"t", "time", Dimension::kTime, kNotNegative}), keyframe.time);
  visit({"translate", "translation from the start", Dimension::kLength}, keyframe.translate);
  visit({"rotate", "rotation about x, then y, then z", Dimension::kAngle}, keyframe.rotate);
  visit({"scale", "size relative to that at the start", Dimension::kRatio, kPositive}, keyframe.scale);
}

void fields(auto& visit, Is<Region> auto& region) {
  visit.table("region", {{KeyRule::kAtMostOne, kSelectionKeys},
                         {KeyRule::kAnyOf,
                          {"box", "sphere", "half_space", "part", "painted", "face", "nearest", "mesh", "gradient"}}});
  selection_fields(visit, region);
  visit(required({"material", "what they are made of"}), region.material);
  visit({"gradient", "a change to another material along a line"}, region.gradient);
}

void fields(auto& visit, Is<Gradient> auto& gradient) {
  visit.table("gradient");
  visit(required({"from", "where the region's material begins to change, in fractions of the body's bounding box",
                  Dimension::kRatio}),
        gradient.from);
  visit(required({"to", "where it is this one", Dimension::kRatio}), gradient.to);
  visit(required({"material", "what it changes to"}), gradient.material);
}

void fields(auto& visit, Is<BodyForce> auto& force) {
  visit.table("force", {{KeyRule::kAtMostOne, kSelectionKeys},
                        {KeyRule::kOneOf, {"total", "per_volume", "traction", "moment", "pressure"}}});
  selection_fields(visit, force);
  visit({"total", "force on the whole part, distributed by volume; by area where its box is flat", Dimension::kForce},
        force.total);
  visit({"on_surface", "true: total is distributed by area of the part's skin"}, force.on_surface);
  visit({"per_volume", "force per volume", Dimension::kForceDensity}, force.per_volume);
  visit({"traction", "force per area of the part's skin, whichever way it turns", Dimension::kPressure},
        force.traction);
  visit({"moment", "moment on the part's skin about its centroid", Dimension::kTorque}, force.moment);
  visit({"pressure", "pressure on the skin of the part, inward", Dimension::kPressure}, force.pressure);
  curve_fields(visit, force);
}

void fields(auto& visit, Is<BodyMuscle> auto& muscle) {
  visit.table("muscle", {{KeyRule::kAtMostOne, kSelectionKeys}});
  selection_fields(visit, muscle);
  visit(required({"direction", "direction of the contraction, in the body before it is rotated"}), muscle.direction);
  visit(required({"contraction",
                  "fraction of the length; the part widens so that its volume is kept",
                  Dimension::kRatio,
                  {-1, 0.9}}),
        muscle.contraction);
  curve_fields(visit, muscle);
}

void fields(auto& visit, Is<Strength> auto& strength) {
  visit.table("strength");
  visit(required({"t", "time", Dimension::kTime, kNotNegative}), strength.time);
  visit(required({"strength", "factor on the full strength", Dimension::kRatio}), strength.strength);
}

void fields(auto& visit, Is<GravityKeyframe> auto& keyframe) {
  visit.table("gravity keyframe");
  visit(required({"t", "time", Dimension::kTime, kNotNegative}), keyframe.time);
  visit(required({"gravity", "acceleration of everything", Dimension::kAcceleration}), keyframe.gravity);
}

void fields(auto& visit, Is<SceneWind> auto& wind) {
  visit.table("wind");
  visit(required({"velocity", "of the air at strength 1", Dimension::kSpeed}), wind.velocity);
  visit({"density", "of the air", Dimension::kDensity, kPositive}, wind.density);
  visit({"drag", "drag coefficient: pressure on what faces the wind, over density v^2 / 2", Dimension::kRatio,
         kNotNegative},
        wind.drag);
  curve_fields(visit, wind);
}

void fields(auto& visit, Is<SceneGlue> auto& glue) {
  visit.table("glue");
  visit(required(
            {"bodies", "the two bodies, counted from 1; the same one twice: its copies", Dimension::kNone, kCounted}),
        glue.bodies);
  visit({"distance", "largest gap that is bonded; default: half the smaller bricks", Dimension::kLength, kPositive},
        glue.distance);
}

void fields(auto& visit, Is<SceneObstacle> auto& obstacle) {
  visit.table("obstacle", {{KeyRule::kOneOf, {"plane", "box", "sphere", "capsule", "cylinder", "mesh"}},
                           {KeyRule::kAtMostOne, {"size", "scale"}},
                           {KeyRule::kNeeds, {"size", "mesh"}},
                           {KeyRule::kNeeds, {"scale", "mesh"}}});
  visit({"plane", "everything behind it is solid; or another shape: box, sphere, capsule, cylinder, mesh"},
        obstacle.plane);
  visit({"box", "sides of a box", Dimension::kLength, kPositive}, obstacle.box);
  visit({"sphere", "a ball"}, obstacle.sphere);
  visit({"capsule", "a rod with round ends, along y"}, obstacle.capsule);
  visit({"cylinder", "a rod with flat ends, along y"}, obstacle.cylinder);
  visit({"mesh", "file of a closed surface, relative to the scene file"}, obstacle.mesh);
  visit({"size", "longest side of the mesh", Dimension::kLength, kPositive}, obstacle.size);
  visit({"scale", "length of one unit of the mesh file; instead of size", Dimension::kLength, kPositive},
        obstacle.scale);
  visit({"position", "of its centre", Dimension::kLength}, obstacle.position);
  visit({"rotation", "about x, then y, then z, around its centre", Dimension::kAngle}, obstacle.rotation);
  visit({"keyframes", "how it moves from there"}, obstacle.keyframes);
  visit({"interpolation", "between keyframes: linear or smooth"}, obstacle.interpolation);
  visit({"friction", "Coulomb friction coefficient", Dimension::kRatio, kNotNegative}, obstacle.friction);
  visit({"restitution", "coefficient of restitution", Dimension::kRatio, {0, 1}}, obstacle.restitution);
  visit({"color", "\"#rrggbb\""}, obstacle.color);
}

void fields(auto& visit, Is<Plane> auto& plane) {
  visit.table("plane");
  visit({"y", "height above the position", Dimension::kLength}, plane.y);
  visit({"normal", "direction out of what is solid"}, plane.normal);
}

void fields(auto& visit, Is<Probe> auto& probe) {
  std::vector<std::string_view> places = kSelectionKeys;
  places.insert(places.begin(), {"point", "pin"});
  visit.table("probe", {{KeyRule::kAtMostOne, places}});
  visit(required({"name", "prefix of its columns"}), probe.name);
  visit({"body", "number of the body, counted from 1", Dimension::kNone, kCounted}, probe.body);
  visit({"point", "point of the body, from the centre of its bounding box", Dimension::kLength}, probe.point);
  visit({"pin", "name of a pin of the body; instead of point. Without either: the body, or the part that is selected"},
        probe.pin);
  selection_fields(visit, probe.selection);
}

void fields(auto& visit, Is<Experiment> auto& experiment) {
  visit.table("experiment");
  visit({"title", "of the experiment"}, experiment.title);
  visit({"about", "text for the report"}, experiment.about);
  visit({"nodes", "table of displacements known at points: poisson,x,y,z,ux,uy,uz"}, experiment.nodes);
  visit({"models", "laws of the bricks"}, experiment.models);
  visit({"poisson", "Poisson's ratios", Dimension::kNone, kPoisson}, experiment.poisson);
  visit({"bricks", "numbers of bricks along the longest side", Dimension::kNone, {1, 1024}}, experiment.bricks);
}

void fields(auto& visit, Is<Expectation> auto& expectation) {
  visit.table("expectation");
  visit(required({"quantity", "\"tip.displacement.y\", \"end.torque.x\", \"frequency.1\", and so on"}),
        expectation.quantity);
  visit(required({"value", "in SI units, in the last frame"}), expectation.value);
  visit(required({"source", "source of the value"}), expectation.source);
  visit({"poisson", "Poisson's ratios that it holds for; default: all", Dimension::kNone, kPoisson},
        expectation.poisson);
  visit({"bricks",
         "grids that it holds for, by the bricks along the longest side; default: all",
         Dimension::kNone,
         {1, 1024}},
        expectation.bricks);
  visit({"models", "laws of the bricks that it holds for; default: all"}, expectation.models);
  visit({"gate", "required accuracy"}, expectation.gates);
}

void fields(auto& visit, Is<Gate> auto& gate) {
  visit.table("gate", {{KeyRule::kOneOf, {"tolerance", "no_worse_than"}}});
  visit({"models", "laws of the bricks that have to meet it; default: calibrated"}, gate.models);
  visit({"bricks", "on which grids, by the bricks along the longest side; default: all", Dimension::kNone, {1, 1024}},
        gate.bricks);
  visit({"tolerance", "relative error allowed; absolute where 0 is expected", Dimension::kRatio, kNotNegative},
        gate.tolerance);
  visit({"no_worse_than", "law of the bricks whose error on the same grid is the tolerance; instead of tolerance"},
        gate.no_worse_than);
}

void fields(auto& visit, Is<LibraryMaterial> auto& material) {
  visit.table("library material", rules_of_curve());
  visit(required({"name", "as scenes and --material use it"}), material.name);
  visit({"class", "gelatin, silicone, rubber, foam, wood, tissue, plastic, metal or other"}, material.material_class);
  visit({"about", "what it is"}, material.about);
  visit({"young", "Young's modulus", Dimension::kPressure, kPositive}, material.young);
  visit({"young_uncertainty", "relative uncertainty", Dimension::kRatio, kNotNegative}, material.young_uncertainty);
  visit({"young_source", "source of the value"}, material.young_source);
  visit(required({"poisson", "Poisson's ratio", Dimension::kNone, kPoisson}), material.poisson);
  visit({"poisson_uncertainty", "uncertainty", Dimension::kNone, {0, 1}}, material.poisson_uncertainty);
  visit({"poisson_source", "source of the value"}, material.poisson_source);
  visit(kPoissonInMotion, material.poisson_in_motion);
  visit(required({"density", "density", Dimension::kDensity, kPositive}), material.density);
  visit({"density_uncertainty", "relative uncertainty", Dimension::kRatio, kNotNegative}, material.density_uncertainty);
  visit({"density_source", "source of the value"}, material.density_source);
  visit({"damping", "ratio of critical damping at the slowest vibration", Dimension::kRatio, {0, 10}},
        material.damping);
  visit({"damping_uncertainty", "relative uncertainty", Dimension::kRatio, kNotNegative}, material.damping_uncertainty);
  visit({"damping_source", "source of the value"}, material.damping_source);
  law_fields(visit, material.law);
  visit({"law_source", "source of the law and its parameters"}, material.law_source);
  visit(
      {"curve",
       "of a tension test, a table of stretch and nominal stress; in place of young: it and the law are fitted to it"},
      material.curve);
  visit({"yield_strength", "stress from which it stays deformed", Dimension::kPressure, kPositive},
        material.yield_strength);
  visit({"yield_strength_uncertainty", "relative uncertainty", Dimension::kRatio, kNotNegative},
        material.yield_strength_uncertainty);
  visit({"yield_strength_source", "source of the value"}, material.yield_strength_source);
  visit({"ultimate_strength", "greatest stress in tension", Dimension::kPressure, kPositive},
        material.ultimate_strength);
  visit({"ultimate_strength_uncertainty", "relative uncertainty", Dimension::kRatio, kNotNegative},
        material.ultimate_strength_uncertainty);
  visit({"ultimate_strength_source", "source of the value"}, material.ultimate_strength_source);
  visit({"elongation", "strain at break, in tension", Dimension::kRatio, kPositive}, material.elongation);
  visit({"elongation_uncertainty", "relative uncertainty", Dimension::kRatio, kNotNegative},
        material.elongation_uncertainty);
  visit({"elongation_source", "source of the value"}, material.elongation_source);
  visit({"look", "surface finish: plastic, gelatin, rubber or steel"}, material.look);
  visit({"mean_free_path", "of light inside before it is scattered, for final quality; 0: no light enters",
         Dimension::kLength, kNotNegative},
        material.mean_free_path);
  visit({"mean_free_path_uncertainty", "relative uncertainty", Dimension::kRatio, kNotNegative},
        material.mean_free_path_uncertainty);
  visit({"mean_free_path_source", "source of the value"}, material.mean_free_path_source);
  visit({"color", "\"#rrggbb\" of bodies that name none and whose mesh file gives none"}, material.color);
  visit({"color_source", "source of the value"}, material.color_source);
}

void fields(auto& visit, Is<MaterialFile> auto& file) {
  visit.table("file of materials");
  visit(required({"material", "a material"}), file.materials);
}

}  // namespace sprung
