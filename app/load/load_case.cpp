#include "app/load/load_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/error.h"

namespace sprung {
namespace {

constexpr double kGravity = 9.80665;  // m/s^2, standard
constexpr double kFlat = 0.999;       // length of the mean normal of a flat face

struct Quantity {
  Dimension dimension;
  double amount;
};

/// "50N", with its unit. None if it is not a load.
std::optional<Quantity> quantity_from(const std::string& text) {
  if (std::none_of(text.begin(), text.end(), [](unsigned char c) { return std::isalpha(c) != 0; })) return std::nullopt;
  for (const Dimension dimension : {Dimension::kForce, Dimension::kPressure, Dimension::kMass, Dimension::kTorque,
                                    Dimension::kLength, Dimension::kAcceleration}) {
    try {
      return Quantity{dimension, parse_quantity(text, dimension)};
    } catch (const Error&) {
      continue;
    }
  }
  return std::nullopt;
}

std::vector<std::string> fields_of(const std::string& text) {
  std::vector<std::string> fields(1);
  for (const char c : text) {
    if (c == ':') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

std::string joined(const std::vector<std::string>& fields, std::size_t count) {
  std::string text = fields[0];
  for (std::size_t i = 1; i < count; ++i) text += ":" + fields[i];
  return text;
}

/// Axes of the file, "xz", as axes of the scene.
std::optional<Axes> axes_from(const std::string& text, const Mat3& world_from_file) {
  if (text.empty() || text.find_first_not_of("xyz") != std::string::npos) return std::nullopt;
  Axes axes{.fixed = {false, false, false}};
  for (const char c : text) {
    Eigen::Index axis = 0;
    world_from_file.col(c - 'x').cwiseAbs().maxCoeff(&axis);
    axes.fixed[std::size_t(axis)] = true;
  }
  return axes;
}

Pin pin_of(const PartFace& face) {
  Pin pin;
  static_cast<Selection&>(pin) = face.selection;
  pin.on_surface = true;
  return pin;
}

PartFix fix_from(const std::string& text, const LoadPart& part) {
  const std::vector<std::string> fields = fields_of(text);
  const std::string& last = fields.back();
  const bool slides = fields.size() > 1 && last == "slide";
  const std::optional<Axes> axes = fields.size() > 1 ? axes_from(last, part.world_from_file) : std::nullopt;
  PartFix fix{.text = text, .face = find_face(part, slides || axes ? joined(fields, fields.size() - 1) : text)};
  fix.pin = pin_of(fix.face);
  fix.pin.name = text;
  if (axes) fix.pin.axes = *axes;
  if (!slides) return fix;
  if (fix.face.outward.norm() < kFlat) {
    throw Error(ErrorKind::kUsage, fmt::format("--fix '{}': only a flat face can slide along its plane; name the axes "
                                               "to hold, as in {}:xz",
                                               text, fix.face.name));
  }
  fix.pin.normal = part.world_from_file * fix.face.outward;
  return fix;
}

constexpr const char* kLoadForms =
    "write WHERE:50N[:-z], WHERE:2MPa, WHERE:3kg, WHERE:1.5Nm:+x, WHERE:1mm:-y, weight, or acceleration:20m/s2:-y";

/// The direction of a load without one: down for a mass, inward for a force.
Vec3 usual_direction(const Quantity& quantity, const PartFace& face, const LoadPart& part, const std::string& text) {
  if (quantity.dimension == Dimension::kMass) return -part.up();
  if (quantity.dimension == Dimension::kPressure) return Vec3::Zero();
  if (quantity.dimension == Dimension::kForce) return *direction_from("in", face);
  throw Error(ErrorKind::kUsage, fmt::format("--load '{}': along which axis? {}:+x, -z, or X,Y,Z", text, text));
}

BodyForce force_of(const Quantity& quantity, const PartFace& face, const Vec3& world_direction) {
  BodyForce force;
  static_cast<Selection&>(force) = face.selection;
  if (quantity.dimension == Dimension::kPressure) {
    force.pressure = quantity.amount;
  } else if (quantity.dimension == Dimension::kTorque) {
    force.moment = quantity.amount * world_direction;
  } else {
    const double newtons = quantity.amount * (quantity.dimension == Dimension::kMass ? kGravity : 1);
    force.total = newtons * world_direction;
    force.on_surface = true;
  }
  return force;
}

PartLoad on_face(const std::string& text, const std::vector<std::string>& fields, const LoadPart& part) {
  const bool has_direction = fields.size() > 2 && !quantity_from(fields.back());
  const std::size_t amount = fields.size() - (has_direction ? 2 : 1);
  const std::optional<Quantity> quantity = amount > 0 ? quantity_from(fields[amount]) : std::nullopt;
  if (!quantity || quantity->dimension == Dimension::kAcceleration) {
    throw Error(ErrorKind::kUsage, fmt::format("--load '{}': {}", text, kLoadForms));
  }
  PartLoad load{.text = text,
                .face = find_face(part, joined(fields, amount)),
                .dimension = quantity->dimension,
                .amount = quantity->amount};
  std::optional<Vec3> direction;
  if (has_direction) {
    direction = direction_from(fields.back(), *load.face);
    if (!direction) {
      throw Error(ErrorKind::kUsage, fmt::format("--load '{}': '{}' is no direction; write +x ... -z, X,Y,Z, in or out",
                                                 text, fields.back()));
    }
    if (quantity->dimension == Dimension::kPressure) {
      throw Error(ErrorKind::kUsage,
                  fmt::format("--load '{}': a pressure acts inward, across the face; leave out '{}', or give a force",
                              text, fields.back()));
    }
  }
  if (!(load.amount != 0)) throw Error(ErrorKind::kUsage, fmt::format("--load '{}': the load is zero", text));
  load.direction = direction ? *direction : usual_direction(*quantity, *load.face, part, text);
  if (load.amount < 0 && quantity->dimension != Dimension::kPressure) {
    load.amount *= -1;
    load.direction *= -1;
  }
  const Vec3 world = part.world_from_file * load.direction;
  if (quantity->dimension == Dimension::kLength) {
    load.movement = pin_of(*load.face);
    load.movement->name = text;
    load.movement->normal = world;
    load.movement->translate = load.amount * world;
  } else {
    load.force = force_of({quantity->dimension, load.amount}, *load.face, world);
  }
  return load;
}

PartLoad load_from(const std::string& text, const LoadPart& part) {
  const std::vector<std::string> fields = fields_of(text);
  if (fields.size() == 1 && text == "weight") {
    return {.text = text,
            .face = std::nullopt,
            .dimension = Dimension::kAcceleration,
            .amount = kGravity,
            .direction = -part.up()};
  }
  if (fields.front() != "acceleration") return on_face(text, fields, part);
  const PartFace nowhere{.name = "the part"};
  const std::optional<Vec3> direction = fields.size() == 3 ? direction_from(fields[2], nowhere) : std::nullopt;
  if (!direction) throw Error(ErrorKind::kUsage, fmt::format("--load '{}': write acceleration:20m/s2:-y", text));
  try {
    return {.text = text,
            .face = std::nullopt,
            .dimension = Dimension::kAcceleration,
            .amount = parse_quantity(fields[1], Dimension::kAcceleration),
            .direction = *direction};
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("--load '{}': {}", text, error.what()));
  }
}

}  // namespace

std::string PartLoad::description() const {
  std::string much = readable(amount, dimension);
  if (direction.isZero(0)) return much;
  constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < 1 - 1e-9) continue;
    return fmt::format("{} {} {}{}", much, dimension == Dimension::kTorque ? "about" : "along",
                       direction[axis] < 0 ? "-" : "+", kNames[std::size_t(axis)]);
  }
  return fmt::format("{} {} ({:.3g}, {:.3g}, {:.3g})", much, dimension == Dimension::kTorque ? "about" : "along",
                     direction.x(), direction.y(), direction.z());
}

LoadCase parse_load_case(const std::vector<std::string>& fixes, const std::vector<std::string>& loads,
                         const LoadPart& part) {
  LoadCase all;
  for (const std::string& text : fixes) all.fixes.push_back(fix_from(text, part));
  for (const std::string& text : loads) {
    all.loads.push_back(load_from(text, part));
    const PartLoad& load = all.loads.back();
    if (!load.face) all.gravity += load.amount * (part.world_from_file * load.direction);
  }
  return all;
}

}  // namespace sprung
