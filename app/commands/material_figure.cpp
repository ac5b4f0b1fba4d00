#include "app/commands/material_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/scene/tension_curve.h"
#include "core/law/solid/uniaxial.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr int kPoints = 121;

/// A unit of stress that gives handy numbers.
struct StressUnit {
  std::string_view name;
  double pascal;
};

StressUnit unit_for(double largest) {
  if (largest >= 2e9) return {"GPa", 1e9};
  if (largest >= 2e6) return {"MPa", 1e6};
  if (largest >= 2e3) return {"kPa", 1e3};
  return {"Pa", 1};
}

struct StretchRange {
  double low;
  double high;
};

std::vector<Eigen::Vector2d> response(const Material& material, const StretchRange& stretch) {
  const StrainEnergy psi(material);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < kPoints; ++i) {
    const double s = stretch.low + (stretch.high - stretch.low) * i / (kPoints - 1);
    points.emplace_back(s, uniaxial_state(psi, s).stress);
  }
  return points;
}

double largest_stress(const std::vector<Curve>& curves) {
  double largest = 0;
  for (const Curve& curve : curves) {
    for (const Eigen::Vector2d& point : curve.points) {
      if (std::isfinite(point.y())) largest = std::max(largest, std::abs(point.y()));
    }
  }
  return largest;
}

}  // namespace

Figure material_figure(std::span<const LibraryMaterial> materials) {
  constexpr std::array<std::string_view, 6> kColors{ink::kBlue,   ink::kVermilion, ink::kGreen,
                                                    ink::kPurple, ink::kOrange,    ink::kSky};
  std::vector<TensionCurve> measured(materials.size());
  StretchRange stretch{1, 1};
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i].curve.empty()) continue;
    measured[i] = read_tension_curve(materials[i].curve);
    for (const double s : measured[i].stretches) stretch = {std::min(stretch.low, s), std::max(stretch.high, s)};
  }
  if (stretch.low == stretch.high) stretch = {0.5, 2};
  SvgPlot plot;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const std::string_view color = kColors[i % kColors.size()];
    Curve points{.color = color, .marker = Marker::kCircle, .width = 0};
    for (std::size_t k = 0; k < measured[i].stretches.size(); ++k) {
      points.points.emplace_back(measured[i].stretches[k], measured[i].stresses[k]);
    }
    if (!points.points.empty()) plot.curves.push_back(std::move(points));
    plot.curves.push_back(
        {.name = materials.size() == 1 ? std::string(law_name(materials[i].law.kind)) : materials[i].name,
         .points = response(materials[i].material(), stretch),
         .color = color,
         .width = 2.6});
  }
  const LibraryMaterial& first = materials.front();
  if (materials.size() == 1 && first.law.kind != StrainEnergyKind::kNeoHooke) {
    Material plain = first.material();
    plain.law = {};
    plot.curves.push_back(
        {.name = "neo-hooke", .points = response(plain, stretch), .color = ink::kGrey, .dashed = true, .width = 1.6});
  }
  const StressUnit unit = unit_for(largest_stress(plot.curves));
  for (Curve& curve : plot.curves) {
    for (Eigen::Vector2d& point : curve.points) point.y() /= unit.pascal;
  }
  plot.x = {.label = "stretch (length over rest length)"};
  plot.y = {.label = fmt::format("nominal stress ({})", unit.name)};
  plot.reference = 0;
  Figure figure{.name = "materials", .title = materials.size() == 1 ? first.name : "Materials at large strain"};
  figure.subtitle = "pulled or pressed along one axis, sides free";
  if (materials.size() == 1) {
    figure.subtitle = fmt::format("E = {}, ν = {:g}, law {}", readable(first.young, Dimension::kPressure),
                                  first.poisson, law_name(first.law.kind));
    if (!first.curve.empty()) figure.subtitle += "; circles: " + first.curve.filename().string();
  }
  figure.plots = {std::move(plot)};
  return figure;
}

}  // namespace sprung
