#pragma once
#include <functional>

#include "core/types.h"

namespace sprung::models {

/// A solid as a function of a point: below zero inside, zero on its surface, near to the distance close by. Any unit
/// of length; the models use centimetres.
using Shape = std::function<double(const Vec3&)>;

/// A curve over t in [0, 1].
using Curve = std::function<Vec3(double)>;
using Width = std::function<double(double)>;
/// A point's place on a curve, t in [0, 1].
using Place = std::function<double(const Vec3&)>;

[[nodiscard]] Shape ball(const Vec3& center, double radius);
/// Not a true distance away from the surface, where it is right to first order.
[[nodiscard]] Shape ellipsoid(const Vec3& center, const Vec3& radii);
/// The hull of two balls: a capsule, or a rounded cone where the radii differ.
[[nodiscard]] Shape limb(const Vec3& from, double from_radius, const Vec3& to, double to_radius);
/// All that is nearer to the curve than radius(t), t being the nearest place on it; round ends unless closed.
/// Precondition: the curve bends less sharply than the tube is thick.
[[nodiscard]] Shape tube(Curve curve, Width radius, bool closed);
/// Everything above y = height.
[[nodiscard]] Shape above(double height);

/// The shape turned about an axis through `center`, degrees.
[[nodiscard]] Shape flipped(Shape shape, const Vec3& center, const Vec3& axis, double degrees);
/// The shape of the half space x > 0, seen in both halves.
[[nodiscard]] Shape mirrored(Shape shape);
/// Union, difference and intersection with the seam rounded over about `blend`; 0: sharp.
[[nodiscard]] Shape join(Shape a, Shape b, double blend);
[[nodiscard]] Shape carve(Shape a, Shape b, double blend);
[[nodiscard]] Shape meet(Shape a, Shape b, double blend);
/// The shape with its surface moved outwards.
[[nodiscard]] Shape grown(Shape shape, double distance);

/// The place on the curve nearest to a point.
[[nodiscard]] Place nearest_place(Curve curve, bool closed);
/// The smooth curve through control points (cubic Bezier).
[[nodiscard]] Curve bezier(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// Central differences over `step`; not normalised.
[[nodiscard]] Vec3 gradient(const Shape& shape, const Vec3& p, double step);

}  // namespace sprung::models
