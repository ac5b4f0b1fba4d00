#include "app/report/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "app/report/locking.h"
#include "app/report/uniaxial.h"
#include "core/files.h"

namespace sprung {

namespace {

constexpr double kReferenceError = 0.02;  // %, the least error worth drawing
constexpr double kMechanism = 100;        // %, beyond it the bricks hold nothing and no scale would be of use

/// How a model looks in every plot.
struct ModelStyle {
  std::string_view model;
  std::string_view name;
  std::string_view color;
  Marker marker;
  bool dashed;
  double width;
};

constexpr std::array<ModelStyle, 6> kStyles{
    {{"calibrated", "calibrated (default)", ink::kBlue, Marker::kCircle, false, 3.2},
     {"fem", "fem (hexahedron)", ink::kVermilion, Marker::kSquare, false, 2},
     {"tensile", "tensile (the paper)", ink::kGreen, Marker::kDiamond, false, 2},
     {"m1", "m1 (the paper)", ink::kPurple, Marker::kTriangle, false, 2},
     {"m2-plain", "m2-plain", ink::kGrey, Marker::kCross, true, 1.6},
     {"m1-plain", "m1-plain", ink::kOrange, Marker::kCross, true, 1.6}}};

constexpr std::size_t kCompared = 3;  // the first of them, where there is no room for all

Curve styled_curve(const ModelStyle& style) {
  return {.name = std::string(style.name),
          .points = {},
          .color = style.color,
          .marker = style.marker,
          .dashed = style.dashed,
          .width = style.width};
}

std::string poisson_text(double poisson) { return fmt::format("ν = {:g}", poisson); }

Curve convergence_curve(const ModelStyle& style, const std::vector<Check>& checks, double poisson) {
  Curve curve = styled_curve(style);
  for (const Check& check : checks) {
    if (check.model != style.model || std::abs(check.poisson - poisson) > 1e-9) continue;
    const double percent = 100 * std::abs(check.error());
    if (percent <= kMechanism) curve.points.emplace_back(check.bricks_across, std::max(percent, kReferenceError));
  }
  std::sort(curve.points.begin(), curve.points.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
  return curve;
}

SvgPlot convergence_plot(const std::vector<Check>& checks, double poisson) {
  SvgPlot plot{.title = poisson_text(poisson)};
  plot.x = {.label = "bricks across the thickness", .scale = Scale::kLog, .ticks = {1, 2, 4, 8}};
  plot.y = {.label = "error of the tip's deflection (%)", .scale = Scale::kLog};
  for (const ModelStyle& style : kStyles) {
    Curve curve = convergence_curve(style, checks, poisson);
    if (!curve.points.empty()) plot.curves.push_back(std::move(curve));
  }
  return plot;
}

/// All panels show what the widest needs, so that they can be compared.
void share_y_axis(std::vector<Panel>& panels) {
  double low = 1e300;
  double high = -1e300;
  for (const Panel& panel : panels) {
    for (const Curve& curve : panel.plot.curves) {
      for (const Eigen::Vector2d& point : curve.points) {
        if (!point.allFinite()) continue;
        low = std::min(low, point.y());
        high = std::max(high, point.y());
      }
    }
  }
  if (low > high) return;
  for (Panel& panel : panels) {
    panel.plot.y.low = low;
    panel.plot.y.high = high;
  }
}

/// The color of the nth of several grids, from coarse and light to fine and dark.
std::string_view grid_color(std::size_t n) {
  constexpr std::array<std::string_view, 4> kColors{ink::kOrange, ink::kGreen, ink::kSky, ink::kBlack};
  return kColors[std::min(n, kColors.size() - 1)];
}

Marker grid_marker(std::size_t n) {
  constexpr std::array<Marker, 4> kMarkers{Marker::kDiamond, Marker::kSquare, Marker::kCircle, Marker::kNone};
  return kMarkers[std::min(n, kMarkers.size() - 1)];
}

/// 8x2x2 as people write it.
std::string with_crosses(const std::string& grid) {
  std::string text;
  for (const char c : grid) text += c == 'x' ? std::string("×") : std::string(1, c);
  return text;
}

/// The deflection's error in per cent, below zero where it is too small: at every node, and the mean of each section.
std::array<Curve, 2> node_error_curves(const NodeErrors& errors, std::size_t nth) {
  Curve means{.name = with_crosses(errors.grid), .points = {}, .color = grid_color(nth), .marker = grid_marker(nth)};
  Curve nodes{.name = "", .points = {}, .color = grid_color(nth), .marker = Marker::kDot, .width = 0};
  std::map<double, Eigen::Vector2d> sections;  // sum of errors, count
  for (const NodeError& node : errors.nodes) {
    const double sign = node.known.y() < 0 ? -1 : 1;
    const double percent = 100 * sign * node.error.y() / errors.largest;
    nodes.points.emplace_back(node.along, percent);
    auto [place, is_new] = sections.try_emplace(std::round(1e6 * node.along) / 1e6, 0, 0);
    place->second += Eigen::Vector2d(percent, 1);
  }
  for (const auto& [along, sum] : sections) means.points.emplace_back(along, sum.x() / sum.y());
  return {std::move(means), std::move(nodes)};
}

Curve deflection_curve(const ModelStyle& style, int across) {
  Curve curve = styled_curve(style);
  curve.name = fmt::format("{} {}×{}×{}", style.model, 4 * across, across, across);
  curve.marker = Marker::kNone;
  curve.width = 2;
  curve.dashed = across == 2;
  for (const double poisson : {0.0, 0.1, 0.2, 0.3, 0.35, 0.4, 0.43, 0.45, 0.47, 0.48, 0.485, 0.49, 0.495, 0.499}) {
    curve.points.emplace_back(poisson, cantilever_deflection(model_from_name(style.model), poisson, across));
  }
  return curve;
}

SvgPlot locking_plot() {
  SvgPlot plot{.title = "A clamped beam under its own weight"};
  plot.x = {.label = "Poisson's ratio ν", .high = 0.5};
  plot.y = {.label = "tip deflection / (ρ g L⁴ / 8 E I)", .low = 0};
  Curve reference{.name = "reference", .points = {}, .color = ink::kBlack, .marker = Marker::kCircle};
  for (const DeflectionAt& at : reference_deflections()) reference.points.emplace_back(at.poisson, at.deflection);
  plot.curves.push_back(std::move(reference));
  for (const std::size_t style : {0U, 1U}) {
    for (const int across : {4, 2}) plot.curves.push_back(deflection_curve(kStyles[style], across));
  }
  return plot;
}

constexpr double kLeastStretch = 0.5;
constexpr double kMostStretch = 2;

/// `value` of the response of `law` at every stretch.
template <class Law, class Value>
void fill_by_stretch(Curve& curve, const Law& law, const Value& value) {
  constexpr int kSteps = 75;
  for (int i = 0; i <= kSteps; ++i) {
    const double stretch = kLeastStretch + (kMostStretch - kLeastStretch) * i / kSteps;
    curve.points.emplace_back(stretch, value(stretch, law(stretch)));
  }
}

/// The bricks of some models and the textbook laws, plotted over the stretch.
template <class Value>
std::vector<Curve> stretch_curves(const Material& material, std::initializer_list<Model> models, const Value& value) {
  std::vector<Curve> curves;
  for (const Model model : models) {
    const auto style = std::find_if(kStyles.begin(), kStyles.end(),
                                    [&](const ModelStyle& candidate) { return candidate.model == model_name(model); });
    Curve curve = styled_curve(*style);
    curve.name = style->model;
    curve.marker = Marker::kNone;
    fill_by_stretch(
        curve, [&](double stretch) { return brick_uniaxial(model, material, stretch); }, value);
    curves.push_back(std::move(curve));
  }
  Curve neo{.name = "neo-Hookean", .points = {}, .color = ink::kBlack, .dashed = true};
  fill_by_stretch(
      neo, [&](double stretch) { return neo_hookean_uniaxial(material, stretch); }, value);
  curves.push_back(std::move(neo));
  Curve venant{.name = "St. Venant–Kirchhoff", .points = {}, .color = ink::kVermilion, .dashed = true};
  fill_by_stretch(
      venant, [&](double stretch) { return st_venant_kirchhoff_uniaxial(material, stretch); }, value);
  curves.push_back(std::move(venant));
  return curves;
}

Material unit_material(double poisson) {
  return {.name = "unit", .young = 1, .poisson = poisson, .density = 1, .damping = 0, .source = ""};
}

const std::vector<double> kStretchTicks{0.5, 0.75, 1, 1.25, 1.5, 1.75, 2};

SvgPlot volume_plot() {
  SvgPlot plot{.title = "A brick stretched along one axis, ν = 0.49"};
  plot.x = {.label = "stretch (length / rest length)", .ticks = {0.5, 1, 1.5, 2}};
  plot.y = {.label = "volume / volume at rest", .low = 0};
  const auto volume = [](double stretch, const UniaxialResponse& response) {
    return stretch * response.sideways * response.sideways;
  };
  plot.curves = stretch_curves(unit_material(0.49), {Model::kCalibrated}, volume);
  return plot;
}

}  // namespace

Figure convergence_figure(const std::vector<Check>& checks) {
  Figure figure{.title = "How far off is the tip of a clamped beam?",
                .subtitle =
                    "400 × 100 × 100 mm under its own weight, small deflection; |error| against converged "
                    "quadratic finite elements (CalculiX)",
                .width = 980,
                .height = 560};
  const double top = kHeadingHeight + 4;
  const double height = figure.height - top - 6;
  figure.panels = {{convergence_plot(checks, 0.3), 12, top, 600, height},
                   {convergence_plot(checks, 0), 624, top, 344, 0.46 * height},
                   {convergence_plot(checks, 0.49), 624, top + 0.46 * height, 344, 0.54 * height}};
  share_y_axis(figure.panels);
  for (Curve& curve : figure.panels.front().plot.curves) {
    curve.shows_values = curve.name.starts_with("calibrated") || curve.name.starts_with("fem");
  }
  for (std::size_t i = 1; i < figure.panels.size(); ++i) {
    figure.panels[i].plot.names_curves = false;
    figure.panels[i].plot.y.label.clear();
  }
  figure.panels[1].plot.x.label.clear();
  return figure;
}

Figure node_error_figure(const std::vector<NodeErrors>& errors, double poisson) {
  Figure figure{
      .title = "How far off is every node of a clamped beam?",
      .subtitle = fmt::format("error of the deflection at every node, {}, over the largest displacement; below "
                              "zero: too stiff; lines: means of the sections",
                              poisson_text(poisson)),
      .width = 980};
  for (const ModelStyle& style : std::span(kStyles).first(kCompared)) {
    SvgPlot plot{.title = std::string(style.name)};
    plot.x = {.label = "place along the beam, x / L", .ticks = {0, 0.5, 1}};
    std::vector<Curve> nodes;
    for (const NodeErrors& one : errors) {
      if (one.model != style.model || std::abs(one.poisson - poisson) > 1e-9) continue;
      auto [means, all] = node_error_curves(one, nodes.size());
      plot.curves.push_back(std::move(means));
      nodes.push_back(std::move(all));
    }
    if (nodes.empty()) continue;
    plot.curves.insert(plot.curves.end(), nodes.begin(), nodes.end());
    plot.guide = GuideLine{0, ""};
    figure.panels.push_back({.plot = std::move(plot)});
  }
  const double wide = (figure.width - 24) / double(std::max<std::size_t>(1, figure.panels.size()));
  double left = 12;
  for (Panel& panel : figure.panels) {
    panel = {std::move(panel.plot), left, kHeadingHeight, wide, figure.height - kHeadingHeight - 6};
    if (left == 12) panel.plot.y.label = "error (% of the largest displacement)";
    left += wide;
  }
  share_y_axis(figure.panels);
  return figure;
}

Figure incompressibility_figure() {
  Figure figure{.title = "Towards ν = 1/2",
                .subtitle =
                    "left: locking, against converged quadratic finite elements (CalculiX); right: the volume of "
                    "springs at large strains",
                .width = 980};
  const double height = figure.height - kHeadingHeight - 6;
  figure.panels = {{locking_plot(), 12, kHeadingHeight, 478, height},
                   {volume_plot(), 496, kHeadingHeight, 472, height}};
  return figure;
}

Figure stress_stretch_figure() {
  SvgPlot plot;
  plot.x = {.label = "stretch (length / rest length)", .ticks = kStretchTicks};
  plot.y = {.label = "nominal stress / E"};
  const auto stress = [](double, const UniaxialResponse& response) { return response.stress; };
  plot.curves = stretch_curves(unit_material(0.3), {Model::kCalibrated, Model::kTensile, Model::kM1}, stress);
  plot.guide = GuideLine{0, ""};
  return single_plot("A brick of springs at large strains",
                     "uniaxial stretch with free sides, ν = 0.3; all laws share E and ν at rest", std::move(plot));
}

void write_svg(const Figure& figure, const std::filesystem::path& file) {
  write_file(file, svg_text(figure, SvgUse::kFile));
}

}  // namespace sprung
