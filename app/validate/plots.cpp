#include "app/validate/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "app/validate/responses.h"

namespace sprung {
namespace {

constexpr double kReferenceError = 0.02;  // %
constexpr double kMechanism = 100;        // %, the error of bricks without stiffness
constexpr double kShownRatio = 0.3;       // Poisson's

/// The look of a model in every plot.
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

bool is_same_ratio(double a, double b) { return std::abs(a - b) < 1e-9; }

SvgPlot convergence_plot(const std::vector<Check>& checks, double poisson) {
  SvgPlot plot{.title = fmt::format("ν = {:g}", poisson)};
  plot.x = {.label = "bricks across the thickness", .scale = Scale::kLog, .ticks = {1, 2, 4, 8}};
  plot.y = {.scale = Scale::kLog};
  for (const ModelStyle& style : kStyles) {
    Curve curve{.name = std::string(style.name),
                .color = style.color,
                .marker = style.marker,
                .dashed = style.dashed,
                .width = style.width};
    for (const Check& check : checks) {
      const bool is_shown =
          check.quantity == "tip.displacement.y" && check.model == style.model && is_same_ratio(check.poisson, poisson);
      const double percent = 100 * std::abs(check.error());
      if (!is_shown || !(percent <= kMechanism)) continue;
      curve.points.emplace_back(check.bricks_across, std::max(percent, kReferenceError));
    }
    std::sort(curve.points.begin(), curve.points.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
    if (!curve.points.empty()) plot.curves.push_back(std::move(curve));
  }
  return plot;
}

/// Gives all plots the same y axis.
void share_y_axis(std::vector<SvgPlot>& plots) {
  std::vector<double> values;
  for (const SvgPlot& plot : plots) {
    for (const Curve& curve : plot.curves) {
      for (const Eigen::Vector2d& point : curve.points) values.push_back(point.y());
    }
  }
  if (values.empty()) return;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  for (SvgPlot& plot : plots) {
    plot.y.low = *low;
    plot.y.high = *high;
  }
}

/// Adds the errors of one grid in per cent, negative if the deflection is too small: the mean of each section as a
/// curve, which is drawn on top, and every node as a dot.
void add_node_errors(const NodeErrors& errors, SvgPlot& plot) {
  constexpr std::array<std::string_view, 4> kColors{ink::kOrange, ink::kGreen, ink::kSky, ink::kBlack};
  constexpr std::array<Marker, 4> kMarkers{Marker::kDiamond, Marker::kSquare, Marker::kCircle, Marker::kNone};
  const std::size_t nth = plot.curves.size() / 2;
  const std::size_t style = std::min(nth, kColors.size() - 1);
  Curve means{.color = kColors[style], .marker = kMarkers[style]};
  Curve nodes{.color = kColors[style], .marker = Marker::kDot, .width = 0};
  for (const char c : errors.grid) means.name += c == 'x' ? std::string("×") : std::string(1, c);
  std::map<double, Eigen::Vector2d> sections;  // sum of errors, count
  for (const NodeError& node : errors.nodes) {
    const double percent = 100 * (node.known.y() < 0 ? -1 : 1) * node.error.y() / errors.largest;
    nodes.points.emplace_back(node.along, percent);
    sections.try_emplace(std::round(1e6 * node.along), 0, 0).first->second += Eigen::Vector2d(percent, 1);
  }
  for (const auto& [along, sum] : sections) means.points.emplace_back(1e-6 * along, sum.x() / sum.y());
  plot.curves.insert(plot.curves.begin() + std::ptrdiff_t(nth), std::move(means));
  plot.curves.push_back(std::move(nodes));
}

SvgPlot locking_plot() {
  SvgPlot plot{.title = "A clamped beam under its own weight"};
  plot.x = {.label = "Poisson's ratio ν", .high = 0.5};
  plot.y = {.label = "tip deflection / (ρ g L⁴ / 8 E I)", .low = 0};
  Curve& reference = plot.curves.emplace_back(Curve{.name = "reference", .marker = Marker::kCircle});
  for (const DeflectionAt& at : reference_deflections()) reference.points.emplace_back(at.poisson, at.deflection);
  for (const ModelStyle& style : std::span(kStyles).first(2)) {
    for (const int across : {4, 2}) {
      Curve curve{.name = fmt::format("{} {}×{}×{}", style.model, 4 * across, across, across),
                  .color = style.color,
                  .dashed = across == 2};
      for (const double poisson : {0.0, 0.1, 0.2, 0.3, 0.35, 0.4, 0.43, 0.45, 0.47, 0.48, 0.485, 0.49, 0.495, 0.499}) {
        curve.points.emplace_back(poisson, cantilever_deflection(model_from_name(style.model), poisson, across));
      }
      plot.curves.push_back(std::move(curve));
    }
  }
  return plot;
}

/// A plot over the stretch of one brick of each model and of the textbook laws, E = 1 Pa.
template <class Value>
SvgPlot stretch_plot(double poisson, std::span<const Model> models, const Value& value) {
  constexpr int kSteps = 75;
  SvgPlot plot;
  plot.x = {.label = "stretch (length / rest length)", .ticks = {0.5, 1, 1.5, 2}};
  for (const UniaxialLaw& law : uniaxial_laws(models, light_material(1, poisson))) {
    Curve curve{.name = law.name, .dashed = !law.model};
    if (law.name.starts_with("St.")) curve.color = ink::kVermilion;
    for (const ModelStyle& style : kStyles) {
      if (style.model != law.name) continue;
      curve.color = style.color;
      curve.width = style.width;
    }
    for (int i = 0; i <= kSteps; ++i) {
      const double stretch = 0.5 + 1.5 * i / kSteps;
      curve.points.emplace_back(stretch, value(stretch, law.response(stretch)));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

}  // namespace

Figure convergence_figure(const std::vector<Check>& checks) {
  Figure figure{
      .name = "convergence",
      .title = "Error of the tip deflection of a clamped beam",
      .subtitle =
          "400 × 100 × 100 mm under its own weight, small deflection; absolute error against converged "
          "quadratic finite elements (CalculiX)",
      .caption =
          "Error of the tip deflection over the number of bricks across the beam. Springs with corrections "
          "converge to the correct solution, plain springs to a wrong one unless ν = 1/4.",
      .width = 980,
      .height = 560,
      .plots = {convergence_plot(checks, kShownRatio), convergence_plot(checks, 0), convergence_plot(checks, 0.49)}};
  share_y_axis(figure.plots);
  SvgPlot& large = figure.plots[0];
  large.y.label = "error of the tip deflection (%)";
  large.width = 600;
  for (Curve& curve : large.curves) {
    curve.shows_values = curve.name.starts_with("calibrated") || curve.name.starts_with("fem");
  }
  for (SvgPlot* small : {&figure.plots[1], &figure.plots[2]}) {
    small->has_legend = false;
    small->left = 626;
  }
  figure.plots[1].x.label.clear();
  figure.plots[1].height = 224;
  figure.plots[2].top += 224;
  return figure;
}

Figure node_error_figure(const std::vector<NodeErrors>& errors) {
  Figure figure{
      .name = "node_errors",
      .title = "Error at every node of a clamped beam",
      .subtitle = fmt::format("error of the deflection over the largest displacement, ν = {:g}; negative: too "
                              "stiff; lines: means of the cross sections",
                              kShownRatio),
      .caption = "Every node, as in the paper's Figure 5.",
      .width = 980};
  for (const ModelStyle& style : std::span(kStyles).first(3)) {
    SvgPlot plot{.title = std::string(style.name), .reference = 0};
    plot.x = {.label = "x / L", .ticks = {0, 0.5, 1}};
    for (const NodeErrors& one : errors) {
      if (one.model == style.model && is_same_ratio(one.poisson, kShownRatio)) add_node_errors(one, plot);
    }
    if (!plot.curves.empty()) figure.plots.push_back(std::move(plot));
  }
  share_y_axis(figure.plots);
  const double width = (figure.width - 28) / std::max(1.0, double(figure.plots.size()));
  for (std::size_t i = 0; i < figure.plots.size(); ++i) {
    figure.plots[i].left += double(i) * width;
    figure.plots[i].width = width;
  }
  if (!figure.plots.empty()) figure.plots.front().y.label = "error (% of the largest displacement)";
  return figure;
}

Figure incompressibility_figure() {
  constexpr std::array<Model, 2> kModels{Model::kCalibrated, Model::kTensile};
  SvgPlot volume = stretch_plot(0.49, kModels, [](double stretch, const UniaxialResponse& response) {
    return stretch * response.sideways * response.sideways;
  });
  volume.title = "A brick stretched along one axis, ν = 0.49";
  volume.y = {.label = "volume / rest volume", .low = 0};
  Figure figure{
      .name = "incompressibility",
      .title = "Towards ν = 1/2",
      .subtitle =
          "left: locking, against converged quadratic finite elements (CalculiX); right: the volume "
          "of a brick at large strain",
      .caption =
          "Towards a Poisson's ratio of 1/2: the hexahedron locks, the brick does not, and it preserves volume "
          "at large strain, which the paper's springs do not.",
      .width = 980,
      .plots = {locking_plot(), std::move(volume)}};
  figure.plots[0].width = 476;
  figure.plots[1].left = 504;
  return figure;
}

Figure stress_stretch_figure() {
  constexpr std::array<Model, 3> kModels{Model::kCalibrated, Model::kTensile, Model::kM1};
  SvgPlot plot =
      stretch_plot(kShownRatio, kModels, [](double, const UniaxialResponse& response) { return response.stress; });
  plot.x.ticks = {0.5, 0.75, 1, 1.25, 1.5, 1.75, 2};
  plot.y = {.label = "nominal stress / E"};
  plot.reference = 0;
  return {.name = "stress_stretch",
          .title = "A brick at large strain",
          .subtitle = "uniaxial stretch with free sides, ν = 0.3; all laws share E and ν at rest",
          .caption = "Large strain: the brick as a hyperelastic law.",
          .plots = {std::move(plot)}};
}

}  // namespace sprung
