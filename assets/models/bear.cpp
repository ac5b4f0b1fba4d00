#include "assets/models/model.h"

namespace sprung::models {
namespace {

const Vec3 kHead(0, 14.0, 0.9);
const Vec3 kEye(2.4, 14.75, 5.2);
const Vec3 kNose(0, 13.55, 7.6);
const Vec3 kEar(5.0, 18.2, 0.3);
const Vec3 kFoot(5.3, 2.35, 7.9);
const Vec3 kHand(8.0, 7.7, 4.2);

/// The outer ear leans outwards and a little to the front.
Shape ear_turned(Shape shape) { return flipped(std::move(shape), kEar, Vec3(0, 0.5, -1), 24); }

Shape ears() {
  const Shape cup = ear_turned(ellipsoid(kEar, Vec3(2.5, 2.5, 1.35)));
  const Shape hollow = ear_turned(ellipsoid(kEar + Vec3(0, 0.1, 1.5), Vec3(1.6, 1.6, 1.05)));
  return mirrored(carve(cup, hollow, 0.7));
}

Shape head() {
  Shape shape = ellipsoid(kHead, Vec3(6.1, 5.1, 5.2));
  shape = join(shape, mirrored(ball(kHead + Vec3(2.9, -1.4, 1.1), 3.3)), 1.5);  // cheeks
  shape = join(shape, ears(), 0.8);
  shape = join(shape, ellipsoid(Vec3(0, 12.6, 5.5), Vec3(2.75, 2.1, 2.1)), 0.8);  // snout
  shape = join(shape, ellipsoid(kNose, Vec3(1.15, 0.8, 0.65)), 0.25);
  return join(shape, mirrored(ball(kEye, 0.95)), 0.2);
}

Shape trunk() {
  Shape shape = ellipsoid(Vec3(0, 4.6, 0), Vec3(5.4, 6.4, 5.0));
  shape = join(shape, ball(Vec3(0, 5.1, 1.2), 4.7), 2.0);                        // belly
  shape = join(shape, ellipsoid(Vec3(0, 2.1, -0.5), Vec3(6.0, 4.3, 5.6)), 2.0);  // seat, broad enough not to tip over
  shape = join(shape, limb(Vec3(0, 7, 0), 4.2, Vec3(0, 11, 0.5), 3.7), 1.0);     // neck, to carry the heavy head
  return join(shape, ball(Vec3(0, 1.4, -6.0), 1.6), 0.6);                        // tail, a prop from behind
}

/// The feet turn out a little.
Shape foot_turned(Shape shape) { return flipped(std::move(shape), kFoot, Vec3::UnitY(), 16); }

Shape legs() {
  const Shape sole = foot_turned(ellipsoid(kFoot, Vec3(2.5, 2.85, 1.7)));
  return mirrored(join(limb(Vec3(2.9, 2.1, 1.0), 2.7, kFoot - Vec3(0.2, 0.4, 0.8), 2.2), sole, 0.7));
}

Shape arms() { return mirrored(join(limb(Vec3(3.6, 9.3, 0.4), 1.8, kHand, 2.05), ball(kHand, 2.15), 0.8)); }

/// One big pad and three toes on the sole, where it looks at the viewer.
Shape paw_pads() {
  Shape pads = ellipsoid(kFoot + Vec3(0, -0.65, 1.5), Vec3(1.35, 1.1, 1.4));
  for (const double side : {-1.0, 0.0, 1.0}) {
    pads = join(pads, ball(kFoot + Vec3(1.2 * side, 1.3 - 0.35 * side * side, 1.3), 0.56), 0);
  }
  return mirrored(foot_turned(pads));
}

Shape smile() {
  const Curve half = bezier(Vec3(0, 12.0, 7.6), Vec3(0.15, 11.3, 7.5), Vec3(1.1, 11.15, 7.0), Vec3(1.6, 11.75, 6.8));
  const Shape lip = limb(Vec3(0, 13.2, 7.9), 0.14, Vec3(0, 11.95, 7.6), 0.14);
  return join(mirrored(tube(
                  half, [](double) { return 0.16; }, false)),
              lip, 0.1);
}

Model unpainted() {
  Model bear;
  bear.shape = join(join(trunk(), head(), 1.6), join(arms(), legs(), 0.5), 1.0);
  bear.shape = meet(bear.shape, above(0), 0.8);
  bear.center = Vec3(0, 9.5, 1);
  bear.radius = 16;
  bear.edge = 0.8;
  return bear;
}

}  // namespace

Model make_gummy() {
  Model gummy = unpainted();
  gummy.name = "gummy";
  return gummy;
}

Model make_bear() {
  const Color fur = color_from_hex(0xD9862B);
  const Color cream = color_from_hex(0xF7DFB2);
  const Color dark = color_from_hex(0x2A1710);
  const Color rose = color_from_hex(0xE9705A);
  const Color white = color_from_hex(0xFFFFFF);
  const Shape belly = ellipsoid(Vec3(0, 5.3, 5.4), Vec3(3.5, 3.9, 3.0));
  Model bear = unpainted();
  bear.name = "bear";
  bear.base = [fur](const Vec3&) -> const Color& { return fur; };
  bear.layers = {
      {carve(belly, grown(legs(), 0.3), 0), cream, 0.25},
      {ellipsoid(Vec3(0, 12.45, 6.5), Vec3(2.9, 2.25, 2.2)), cream, 0.25},
      {mirrored(ear_turned(ellipsoid(kEar + Vec3(0, 0.1, 1.2), Vec3(1.6, 1.6, 1.35)))), cream, 0.25},
      {paw_pads(), cream, 0.18},
      {mirrored(ball(kHead + Vec3(4.5, -1.9, 3.3), 1.2)), rose, 1.2, 0.5},
      {smile(), dark, 0.11},
      {ellipsoid(kNose, Vec3(1.3, 0.95, 0.9)), dark, 0.14},
      {mirrored(ball(kEye + Vec3(0, 0, 0.1), 0.96)), dark, 0.14},
      {ball(kEye + Vec3(-0.35, 0.45, 0.85), 0.34), white, 0.1},
      {ball(kEye.cwiseProduct(Vec3(-1, 1, 1)) + Vec3(-0.35, 0.45, 0.85), 0.34), white, 0.1},
      {ellipsoid(kNose + Vec3(-0.3, 0.5, 0.45), Vec3(0.35, 0.2, 0.25)), white, 0.1, 0.7},
  };
  return bear;
}

}  // namespace sprung::models
