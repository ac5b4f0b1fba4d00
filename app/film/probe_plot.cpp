#include "app/film/probe_plot.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sprung {
namespace {

constexpr std::array<Ink, 4> kInks{{{26, 92, 168}, {196, 84, 20}, {32, 128, 72}, {132, 60, 150}}};

struct Unit {
  double from;  // m, the smallest range that it is good for
  double size;  // m
  const char* name;
};
constexpr std::array<Unit, 4> kUnits{{{1, 1, "m"}, {0.02, 0.01, "cm"}, {2e-4, 1e-3, "mm"}, {0, 1e-6, "um"}}};

}  // namespace

Eigen::Vector3f probe_color(std::size_t probe) {
  const Ink& ink = kInks[probe % kInks.size()];
  return Eigen::Vector3f(ink[0], ink[1], ink[2]) / 255.0F;
}

Plot plot_of(const Recording& recording, std::size_t now) {
  Plot plot{.title = {}, .curves = {}, .now = now};
  double furthest = 0;
  for (std::size_t probe = 0; probe < recording.probes.size(); ++probe) {
    const ProbeTrack& track = recording.probes[probe];
    Plot::Curve& curve = plot.curves.emplace_back();
    curve.name = track.name;
    curve.ink = kInks[probe % kInks.size()];
    for (const ProbeSample& sample : track.samples) curve.values.push_back(sample.displacement.norm());
    for (const double value : curve.values) furthest = std::max(furthest, value);
  }
  std::size_t unit = 0;
  while (unit + 1 < kUnits.size() && furthest < kUnits[unit].from) ++unit;
  for (Plot::Curve& curve : plot.curves) {
    for (double& value : curve.values) value /= kUnits[unit].size;
  }
  plot.title = fmt::format("Displacement, {}", kUnits[unit].name);
  return plot;
}

}  // namespace sprung
