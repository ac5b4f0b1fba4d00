#include "app/load/load_answer_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/console/material_json.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxNamed = 3;  // singular places in the text
constexpr double kMinShare = 0.01;    // of a stress, that its error leaves of it

}  // namespace

PartVerdict judge(const PartAnswer& answer, const LibraryMaterial* material, const PartLimits& limits) {
  PartVerdict verdict;
  if (limits.displacement && answer.displacement.value > *limits.displacement) verdict.holds = false;
  std::optional<Peak> stress;
  if (material != nullptr && material->yield_strength > 0) {
    verdict.strength = "yield strength";
    verdict.strength_value = material->yield_strength;
    stress = answer.von_mises;
  } else if (material != nullptr && material->ultimate_strength > 0) {
    verdict.strength = "ultimate strength";
    verdict.strength_value = material->ultimate_strength;
    stress = answer.tension;
  }
  if (stress) {
    const double error = std::isfinite(stress->error) ? std::abs(stress->error) : 0;
    verdict.safety = verdict.strength_value / stress->value;
    verdict.min_safety = verdict.strength_value / (stress->value + error);
    verdict.max_safety = verdict.strength_value / std::max(stress->value - error, kMinShare * stress->value);
  }
  if (limits.safety && !(verdict.safety.value_or(0) >= *limits.safety)) verdict.holds = false;
  return verdict;
}

std::string safety_text(const PartVerdict& verdict) {
  constexpr double kWorthTelling = 1.02;
  const std::string text = fmt::format("{:.3g}", *verdict.safety);
  if (verdict.max_safety < kWorthTelling * verdict.min_safety) return text;
  return text + fmt::format(" ({:.3g} to {:.3g})", verdict.min_safety, verdict.max_safety);
}

std::string sides_text(const Vec3& sides) {
  const auto side = [&](int axis) { return readable(sides[axis], Dimension::kLength); };
  return fmt::format("{} x {} x {}", side(0), side(1), side(2));
}

namespace {

std::string place_text(const Vec3& exact, const LoadPart& part) {
  const double rounding = 1e-6 * part.loaded.extent.maxCoeff() / part.unit;
  const Vec3 position = (exact.array() / rounding).round() * rounding + 0.0;
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) {}", position.x(), position.y(), position.z(), part.unit_name);
}

std::string vector_text(const Vec3& vector, const char* unit) {
  const double least = 1e-6 * vector.norm();  // below which it is rounding
  const auto number = [&](double value) { return std::abs(value) < least ? 0.0 : value; };
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) {}", number(vector.x()), number(vector.y()), number(vector.z()), unit);
}

std::string estimate_text(const Estimate& estimate, const std::string& value) {
  if (!std::isfinite(estimate.error)) return value + " (error unknown: one grid)";
  const double share = std::abs(estimate.error / estimate.value);
  return share < 5e-4 ? value + " +- 0.1 %" : fmt::format("{} +- {:.1f} %", value, 100 * share);
}

/// Mass, g or kg.
std::string mass_text(double mass) { return readable(mass, Dimension::kMass); }

std::string bricks_text(const PartReport& report) {
  const PartAnswer& answer = report.answer;
  std::string text =
      fmt::format("{} of {}", answer.brick_counts.front(), readable(answer.brick_sizes.front(), Dimension::kLength));
  if (answer.bricks_across > 0) text += fmt::format(", {:.2g} across the thinnest walls", answer.bricks_across);
  for (std::size_t grid = 1; grid < answer.brick_sizes.size(); ++grid) {
    text += fmt::format("{} {}", grid == 1 ? "; for the error also of" : " and",
                        readable(answer.brick_sizes[grid], Dimension::kLength));
  }
  return text + (answer.is_linear ? "; small displacements" : "; large displacements");
}

std::string stress_lines(const PartReport& report) {
  const PartAnswer& answer = report.answer;
  std::string text;
  const auto add = [&](const char* name, const std::optional<Peak>& peak) {
    if (!peak) return;
    text += fmt::format("{:<12}{} at {}\n", name, estimate_text(*peak, readable(peak->value, Dimension::kPressure)),
                        place_text(peak->position, report.part));
  };
  add("stress", answer.von_mises);
  if (!answer.von_mises)
    text += "stress      grows with the bricks wherever it is large: round the corners, or use more\n";
  add("  tension", answer.tension);
  add("  pressed", answer.compression);
  if (answer.singular.empty()) return text;
  text += fmt::format(
      "  left out  {} where it grows with the bricks (a sharp inner corner, the edge of a support or load):\n",
      count_of(long(answer.singular.size()), "place"));
  for (std::size_t i = 0; i < std::min(kMaxNamed, answer.singular.size()); ++i) {
    text += fmt::format("            {} at {}\n", readable(answer.singular[i].stress, Dimension::kPressure),
                        place_text(answer.singular[i].position, report.part));
  }
  return text;
}

std::string point_lines(const PartReport& report) {
  std::string text;
  for (const PointAnswer& point : report.answer.points) {
    text += fmt::format("{:<12}{}: moves {}, stress {}\n", "at", place_text(point.position, report.part),
                        vector_text(1e3 * point.displacement, "mm"),
                        estimate_text(point.von_mises, readable(point.von_mises.value, Dimension::kPressure)));
  }
  return text;
}

std::string mode_lines(const PartAnswer& answer) {
  std::string text;
  for (std::size_t mode = 0; mode < answer.frequencies.size(); ++mode) {
    text +=
        fmt::format("{:<12}{}: {}\n", mode == 0 ? "vibrates" : "", mode + 1,
                    estimate_text(answer.frequencies[mode], fmt::format("{:.4g} Hz", answer.frequencies[mode].value)));
  }
  if (!answer.has_buckling) return text;
  if (!answer.buckling_factor) return text + "buckles     never, under loads that act this way\n";
  return text +
         fmt::format("{:<12}under {} times the loads\n", "buckles",
                     estimate_text(*answer.buckling_factor, fmt::format("{:.4g}", answer.buckling_factor->value)));
}

/// What a limit says, and whether the error of what is compared with it could turn that round.
std::string limit_text(std::string_view judgement, bool is_certain) {
  return fmt::format("{}{}\n", judgement, is_certain ? "" : ", but within the error: more --bricks decide");
}

std::string verdict_lines(const PartReport& report) {
  const PartVerdict& verdict = report.verdict;
  std::string text;
  if (verdict.safety) {
    text += fmt::format("safety      {} against the {} of {}{}\n", safety_text(verdict), verdict.strength,
                        readable(verdict.strength_value, Dimension::kPressure),
                        *verdict.safety >= 1                    ? ""
                        : verdict.strength.starts_with("yield") ? ": IT YIELDS"
                                                                : ": IT BREAKS");
  } else if (report.material == nullptr || verdict.strength.empty()) {
    text += "safety      unknown: no strength of this material is known\n";
  }
  if (report.limits.displacement) {
    const Estimate& moved = report.answer.displacement;
    const double limit = *report.limits.displacement;
    text += fmt::format("limit       {} of displacement: ", readable(limit, Dimension::kLength)) +
            limit_text(moved.value > limit ? "EXCEEDED" : "kept", !(std::abs(moved.value - limit) < moved.error));
  }
  if (report.limits.safety) {
    const double limit = *report.limits.safety;
    text += fmt::format("limit       safety {:g}: ", limit) +
            limit_text(verdict.safety.value_or(0) >= limit ? "kept"
                       : verdict.safety                    ? "NOT REACHED"
                                                           : "UNKNOWN",
                       !(verdict.min_safety < limit && limit < verdict.max_safety));
  }
  return text;
}

}  // namespace

std::string text_of(const PartReport& report) {
  const auto& [part, loads, answer, material, verdict, limits] = report;
  const Material& stuff = part.body.material;
  std::string text = fmt::format("{:<12}{}, {:.4g} cm3, {} of {} (E {}, nu {:.4g})\n", "part",
                                 sides_text(answer.extent), 1e6 * answer.volume, mass_text(answer.mass), stuff.name,
                                 readable(stuff.young, Dimension::kPressure), stuff.poisson);
  text += fmt::format("{:<12}{}\n", "bricks", bricks_text(report));
  for (const PartLoad& load : loads.loads) {
    text += fmt::format("{:<12}{}: {}{}\n", "load", load.face ? load.face->name : load.text, load.description(),
                        load.face ? fmt::format(", on {:.4g} mm2", 1e6 * load.face->area) : "");
  }
  for (const PartAnswer::Reaction& reaction : answer.reactions) {
    text += fmt::format("{:<12}{}, {:.4g} mm2: holds with {}, {} about {}\n", "fix", reaction.fix, 1e6 * reaction.area,
                        vector_text(reaction.force, "N"), vector_text(reaction.moment, "N m"),
                        place_text(reaction.centre, part));
  }
  text +=
      fmt::format("{:<12}{} at {}: {}\n", "moves",
                  estimate_text(answer.displacement, readable(answer.displacement.value, Dimension::kLength)),
                  place_text(answer.displacement.position, part), vector_text(1e3 * answer.displacement_vector, "mm"));
  return text + stress_lines(report) + point_lines(report) + mode_lines(answer) + verdict_lines(report);
}

namespace {

Json json_of(const Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json error_json(double error) { return std::isfinite(error) ? Json(error) : Json(nullptr); }

Json json_of(const std::optional<Peak>& peak) {
  if (!peak) return nullptr;
  return {{"value", peak->value}, {"error", error_json(peak->error)}, {"place", json_of(peak->position)}};
}

}  // namespace

std::string json_of(const PartReport& report) {
  const auto& [part, loads, answer, material, verdict, limits] = report;
  Json json{{"part", part.loaded.name},
            {"unit_m", part.unit},
            {"extent_m", json_of(answer.extent)},
            {"volume_m3", answer.volume},
            {"mass_kg", answer.mass},
            {"material", json_of(part.body.material)},
            {"analysis", answer.is_linear ? "linear" : "nonlinear"},
            {"brick_sizes_m", answer.brick_sizes},
            {"brick_counts", answer.brick_counts}};
  for (const PartLoad& load : loads.loads) {
    json["loads"].push_back({{"text", load.text},
                             {"amount", load.amount},
                             {"unit", base_unit(load.dimension)},
                             {"direction", json_of(load.direction)},
                             {"area_m2", load.face ? Json(load.face->area) : Json(nullptr)}});
  }
  for (const PartAnswer::Reaction& reaction : answer.reactions) {
    json["reactions"].push_back({{"fix", reaction.fix},
                                 {"force_N", json_of(reaction.force)},
                                 {"moment_Nm", json_of(reaction.moment)},
                                 {"about", json_of(reaction.centre)}});
  }
  json["displacement_m"] = json_of(std::optional(answer.displacement));
  json["displacement_m"]["vector"] = json_of(answer.displacement_vector);
  json["von_mises_Pa"] = json_of(answer.von_mises);
  json["largest_principal_Pa"] = json_of(answer.tension);
  json["least_principal_Pa"] = json_of(answer.compression);
  json["singular"] = Json::array();
  for (const Singularity& one : answer.singular) {
    json["singular"].push_back(
        {{"von_mises_Pa", one.stress}, {"place", json_of(one.position)}, {"exponent", one.exponent}});
  }
  for (const PointAnswer& point : answer.points) {
    json["points"].push_back(
        {{"place", json_of(point.position)},
         {"displacement_m", json_of(point.displacement)},
         {"von_mises_Pa", {{"value", point.von_mises.value}, {"error", error_json(point.von_mises.error)}}},
         {"stress_xx_yy_zz_xy_yz_zx_Pa", std::vector<double>(point.stress.begin(), point.stress.end())}});
  }
  for (const Estimate& frequency : answer.frequencies) {
    json["frequencies_Hz"].push_back({{"value", frequency.value}, {"error", error_json(frequency.error)}});
  }
  if (answer.has_buckling) {
    json["buckling_factor"] = answer.buckling_factor ? Json{{"value", answer.buckling_factor->value},
                                                            {"error", error_json(answer.buckling_factor->error)}}
                                                     : Json(nullptr);
  }
  json["strength"] =
      verdict.strength.empty() ? Json(nullptr) : Json{{"kind", verdict.strength}, {"value_Pa", verdict.strength_value}};
  json["safety"] = verdict.safety ? Json(*verdict.safety) : Json(nullptr);
  json["safety_range"] =
      verdict.safety ? Json{verdict.min_safety, verdict.max_safety} : Json(nullptr);  // by the stress's error
  json["holds"] = verdict.holds;
  return json.dump(1) + "\n";
}

std::string csv_of(const PartReport& report) {
  const PartAnswer& answer = report.answer;
  std::string text = "quantity,value,error,x,y,z\n";
  const auto number = [](const char* name, double value) { return fmt::format("{},{},,,,\n", name, value); };
  const auto peak = [&](const char* name, const Peak& one) {
    text += fmt::format("{},{},{},{},{},{}\n", name, one.value,
                        std::isfinite(one.error) ? fmt::format("{}", one.error) : "", one.position.x(),
                        one.position.y(), one.position.z());
  };
  text += number("volume_m3", answer.volume) + number("mass_kg", answer.mass);
  peak("displacement_m", answer.displacement);
  if (answer.von_mises) peak("von_mises_Pa", *answer.von_mises);
  if (answer.tension) peak("largest_principal_Pa", *answer.tension);
  if (answer.compression) peak("least_principal_Pa", *answer.compression);
  for (const Singularity& one : answer.singular) {
    text += fmt::format("singular_von_mises_Pa,{},,{},{},{}\n", one.stress, one.position.x(), one.position.y(),
                        one.position.z());
  }
  for (const PartAnswer::Reaction& reaction : answer.reactions) {
    const Vec3& force = reaction.force;
    const Vec3& moment = reaction.moment;
    text += fmt::format("\"reaction_force_N {}\",{},,{},{},{}\n", reaction.fix, force.norm(), force.x(), force.y(),
                        force.z());
    text += fmt::format("\"reaction_moment_Nm {}\",{},,{},{},{}\n", reaction.fix, moment.norm(), moment.x(), moment.y(),
                        moment.z());
  }
  for (const PointAnswer& point : answer.points) {
    peak("von_mises_Pa at", {{.value = point.von_mises.value, .error = point.von_mises.error}, point.position});
    peak("displacement_m at",
         {{.value = point.displacement.norm(), .error = std::numeric_limits<double>::infinity()}, point.position});
  }
  const auto estimate = [&](const std::string& name, const Estimate& one) {
    text += fmt::format("{},{},{},,,\n", name, one.value, std::isfinite(one.error) ? fmt::format("{}", one.error) : "");
  };
  for (std::size_t mode = 0; mode < answer.frequencies.size(); ++mode) {
    estimate(fmt::format("frequency_Hz {}", mode + 1), answer.frequencies[mode]);
  }
  if (answer.buckling_factor) estimate("buckling_factor", *answer.buckling_factor);
  if (report.verdict.safety) text += number("safety", *report.verdict.safety);
  return text;
}

}  // namespace sprung
