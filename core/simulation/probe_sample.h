#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "core/simulation/scene.h"
#include "core/types.h"

namespace sprung {

/// The measurement of a probe in one frame, of the kinds of probes named; zero for others. A pin: the mean of its
/// nodes. A part: the mean of its material.
struct ProbeSample {
  Vec3 position = Vec3::Zero();      // m
  Vec3 displacement = Vec3::Zero();  // m, from the start
  Vec3 force = Vec3::Zero();         // N, that a pin exerts
  Vec3 torque = Vec3::Zero();        // N m, likewise, about the centre of the pin's part
  Vec3 stress = Vec3::Zero();        // xx, yy, zz at a point, Pa; see recover_stress()
  Vec3 shear_stress = Vec3::Zero();  // xy, yz, zx at a point, Pa
  double volume = 0;                 // of a part, m^3
  double elastic_energy = 0;         // of a part, J
  double kinetic_energy = 0;         // of a part, J
  double max_stress = 0;             // von Mises, Pa: largest of a part, at its skin and in the middles of its bricks
  double mean_stress = 0;            // von Mises, Pa: of a part, mean over its volume at rest
  double max_strain = 0;             // von Mises: largest of a part's bricks, in their middles
  double mean_strain = 0;            // von Mises: of a part, mean over its volume at rest
};

/// A quantity that probes measure: a number, or three.
struct ProbeQuantity {
  using Three = Vec3 ProbeSample::*;
  using One = double ProbeSample::*;

  std::string_view name;
  std::string_view unit;                       // empty: a ratio
  std::array<std::string_view, 3> components;  // names; empty for one number
  std::variant<Three, One> value;
  std::array<bool, 3> kinds;  // by ProbeKind: whether these measure it

  [[nodiscard]] bool is_of(ProbeKind kind) const { return kinds[std::size_t(kind)]; }
  [[nodiscard]] constexpr std::size_t size() const { return std::holds_alternative<Three>(value) ? 3 : 1; }

  /// The numbers of a sample, to write where that is not const.
  template <class Sample>
  [[nodiscard]] auto of(Sample& sample) const {
    using Number = std::conditional_t<std::is_const_v<Sample>, const double, double>;
    if (const One* one = std::get_if<One>(&value)) return std::span<Number>(&(sample.**one), 1);
    return std::span<Number>((sample.*std::get<Three>(value)).data(), 3);
  }

  /// "displacement.y", "volume": of one of its numbers.
  [[nodiscard]] std::string label(std::size_t number) const {
    std::string text(name);
    if (size() > 1) text += ".";
    return text.append(components[number]);
  }
};

namespace detail {
inline constexpr std::array<std::string_view, 3> kAlong{"x", "y", "z"};
inline constexpr std::array<bool, 3> kAll{true, true, true};
inline constexpr std::array<bool, 3> kOfPoints{true, false, false};
inline constexpr std::array<bool, 3> kOfPins{false, true, false};
inline constexpr std::array<bool, 3> kOfParts{false, false, true};
}  // namespace detail

/// In the order in which caches keep them; new ones come last.
inline constexpr std::array<ProbeQuantity, 13> kProbeQuantities{
    {{"position", "m", detail::kAlong, &ProbeSample::position, detail::kAll},
     {"displacement", "m", detail::kAlong, &ProbeSample::displacement, detail::kAll},
     {"force", "N", detail::kAlong, &ProbeSample::force, detail::kOfPins},
     {"torque", "N m", detail::kAlong, &ProbeSample::torque, detail::kOfPins},
     {"stress", "Pa", {"xx", "yy", "zz"}, &ProbeSample::stress, detail::kOfPoints},
     {"shear_stress", "Pa", {"xy", "yz", "zx"}, &ProbeSample::shear_stress, detail::kOfPoints},
     {"volume", "m^3", {}, &ProbeSample::volume, detail::kOfParts},
     {"elastic_energy", "J", {}, &ProbeSample::elastic_energy, detail::kOfParts},
     {"kinetic_energy", "J", {}, &ProbeSample::kinetic_energy, detail::kOfParts},
     {"max_stress", "Pa", {}, &ProbeSample::max_stress, detail::kOfParts},
     {"mean_stress", "Pa", {}, &ProbeSample::mean_stress, detail::kOfParts},
     {"max_strain", "", {}, &ProbeSample::max_strain, detail::kOfParts},
     {"mean_strain", "", {}, &ProbeSample::mean_strain, detail::kOfParts}}};

/// The sample of one probe in one frame.
inline constexpr std::size_t kNumbersOfProbe = [] {
  std::size_t sum = 0;
  for (const ProbeQuantity& quantity : kProbeQuantities) sum += quantity.size();
  return sum;
}();

}  // namespace sprung
