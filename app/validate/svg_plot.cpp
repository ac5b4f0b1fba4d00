#include "app/validate/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "render/image/legend.h"

namespace sprung {
namespace {

constexpr double kSlack = 1e-9;   // relative, against rounding
constexpr double kTickSize = 13;  // px, letters
constexpr double kLabelSize = 13.5;
constexpr double kNameStep = 18;  // px, between the names of two curves
constexpr double kNameGap = 26;   // px, from the frame to the names

/// A generous estimate, px.
double text_width(std::string_view text, double size) {
  return 0.58 * size * double(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// The rectangle of a plot's data, px, and the ranges of its axes.
struct PlotField {
  double left, top, right, bottom;
  AxisRange x, y;

  [[nodiscard]] double px(double value) const { return left + x.fraction(value) * (right - left); }
  [[nodiscard]] double py(double value) const { return bottom - y.fraction(value) * (bottom - top); }
};

AxisRange range_over(const SvgPlot& plot, const Axis& axis, int coordinate) {
  std::vector<double> values;
  for (const Curve& curve : plot.curves) {
    for (const Eigen::Vector2d& point : curve.points) {
      if (point.allFinite()) values.push_back(point[coordinate]);
    }
  }
  if (plot.reference && coordinate == 1) values.push_back(*plot.reference);
  if (axis.scale == Scale::kLog) std::erase_if(values, [](double value) { return value <= 0; });
  if (values.empty()) values = {1};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return axis_range(axis, *low, *high);
}

PlotField make_field(const SvgPlot& plot, const Figure& figure) {
  const AxisRange x = range_over(plot, plot.x, 0);
  const AxisRange y = range_over(plot, plot.y, 1);
  double ticks = 0;
  for (const std::string& text : tick_texts(y)) ticks = std::max(ticks, text_width(text, kTickSize));
  double names = 0;
  for (const Curve& curve : plot.curves) names = std::max(names, text_width(curve.name, kLabelSize));
  const double right = plot.width > 0 ? plot.left + plot.width : figure.width - 14;
  const double bottom = plot.height > 0 ? plot.top + plot.height : figure.height - 6;
  return {plot.left + ticks + (plot.y.label.empty() ? 14 : 38),
          plot.top + (plot.title.empty() ? 8 : 30),
          right - (plot.has_legend && names > 0 ? names + kNameGap : 14),
          bottom - (plot.x.label.empty() ? 26 : 48),
          x,
          y};
}

std::string path(std::string_view data, std::string_view color, double width, std::string_view more = "") {
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" {}/>\n", data, color, width, more);
}

/// `anchor`: start, middle or end. `more` are further attributes.
std::string words(double x, double y, double size, std::string_view anchor, std::string_view color,
                  std::string_view text, std::string_view more = "") {
  if (text.empty()) return "";
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\" {}>{}</text>\n",
                     x, y, size, anchor, color, more, escaped(text));
}

std::string axes(const PlotField& f, const SvgPlot& plot) {
  const auto grid = [&](const std::vector<double>& xs, const std::vector<double>& ys, std::string_view color) {
    std::string data;
    for (const double x : xs) data += fmt::format("M{:.1f} {:.1f}V{:.1f}", f.px(x), f.top, f.bottom);
    for (const double y : ys) data += fmt::format("M{:.1f} {:.1f}H{:.1f}", f.left, f.py(y), f.right);
    return path(data, color, 1);
  };
  std::string out = grid(f.x.minor, f.y.minor, "#f1f1f1") + grid(f.x.ticks, f.y.ticks, "#dedede") +
                    path(fmt::format("M{:.1f} {:.1f}V{:.1f}H{:.1f}", f.left, f.top, f.bottom, f.right), "#555", 1.2);
  const std::vector<std::string> up = tick_texts(f.y);
  for (std::size_t i = 0; i < up.size(); ++i) {
    out += words(f.left - 8, f.py(f.y.ticks[i]) + 4.5, kTickSize, "end", "#333", up[i]);
  }
  const std::vector<std::string> across = tick_texts(f.x);
  double free_from = -1e9;  // a label that would overlap the one before it is left out
  for (std::size_t i = 0; i < across.size(); ++i) {
    const double x = f.px(f.x.ticks[i]);
    const double half = 0.5 * text_width(across[i], kTickSize);
    if (x - half < free_from) continue;
    out += words(x, f.bottom + 18, kTickSize, "middle", "#333", across[i]);
    free_from = x + half + 4;
  }
  const double middle = 0.5 * (f.top + f.bottom);
  out += words(f.left, f.top - 11, 14.5, "start", "#111", plot.title, "font-weight=\"600\"");
  out += words(0.5 * (f.left + f.right), f.bottom + 40, kLabelSize, "middle", "#333", plot.x.label);
  out += words(plot.left + 14, middle, kLabelSize, "middle", "#333", plot.y.label,
               fmt::format("transform=\"rotate(-90 {:.1f} {:.1f})\"", plot.left + 14, middle));
  if (!plot.reference) return out;
  const std::string line = fmt::format("M{:.1f} {:.1f}H{:.1f}", f.left, f.py(*plot.reference), f.right);
  return out + path(line, "#777", 1.2, "stroke-dasharray=\"5 4\"");
}

std::string drawn(const PlotField& f, const Curve& curve) {
  constexpr std::array<const char*, 7> kShapes{"",
                                               "h0",
                                               "m-4.6 0a4.6 4.6 0 1 0 9.2 0a4.6 4.6 0 1 0 -9.2 0z",
                                               "m-4.1-4.1h8.2v8.2h-8.2z",
                                               "m0-5.8l5.8 5.8l-5.8 5.8l-5.8-5.8z",
                                               "m0-5.5l5.3 9.4h-10.6z",
                                               "m-3.7-3.7l7.4 7.4m-7.4 0l7.4-7.4"};
  std::string line;
  std::string markers;
  std::string values;
  bool is_joined = false;
  for (const Eigen::Vector2d& point : curve.points) {
    const bool is_shown = point.allFinite();
    if (is_shown) {
      const double x = f.px(point.x());
      const double y = f.py(point.y());
      line += fmt::format("{}{:.2f} {:.2f}", is_joined ? 'L' : 'M', x, y);
      markers += fmt::format("M{:.1f} {:.1f}{}", x, y, kShapes[std::size_t(curve.marker)]);
      const int decimals = std::clamp(1 - int(std::floor(std::log10(std::abs(point.y()) + kSlack))), 0, 6);
      values += words(x, y + 20, kTickSize, "middle", curve.color, fmt::format("{:.{}f}", point.y(), decimals),
                      "font-weight=\"600\" stroke=\"#fff\" stroke-width=\"4\" paint-order=\"stroke\"");
    }
    is_joined = is_shown;
  }
  const std::string_view style =
      curve.dashed ? "stroke-linejoin=\"round\" stroke-dasharray=\"6 5\"" : "stroke-linejoin=\"round\"";
  std::string out = curve.width > 0 ? path(line, curve.color, curve.width, style) : "";
  if (curve.marker == Marker::kDot) {
    out += path(markers, curve.color, 3, "stroke-linecap=\"round\"");
  } else if (curve.marker == Marker::kCross) {
    out += path(markers, curve.color, 2.2);
  } else if (curve.marker != Marker::kNone) {
    out += fmt::format("<path d=\"{}\" fill=\"{}\" stroke=\"#fff\" stroke-width=\"1.2\"/>\n", markers, curve.color);
  }
  return curve.shows_values ? out + values : out;
}

std::string legend(const PlotField& f, const std::vector<Curve>& curves) {
  struct Name {
    const Curve* curve;
    Eigen::Vector2d end;  // px, of the curve
    double y;             // px, of the name
  };
  std::vector<Name> names;
  for (const Curve& curve : curves) {
    const auto is_shown = [](const Eigen::Vector2d& point) { return point.allFinite(); };
    const auto last = std::find_if(curve.points.rbegin(), curve.points.rend(), is_shown);
    if (curve.name.empty() || last == curve.points.rend()) continue;
    names.push_back({&curve, {f.px(last->x()), f.py(last->y())}, f.py(last->y())});
  }
  std::stable_sort(names.begin(), names.end(), [](const Name& a, const Name& b) { return a.y < b.y; });
  for (std::size_t i = 1; i < names.size(); ++i) names[i].y = std::max(names[i].y, names[i - 1].y + kNameStep);
  double most = f.bottom - 4;
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    name->y = std::min(name->y, most);
    most = name->y - kNameStep;
  }
  std::string out;
  const double x = f.right + kNameGap - 5;
  for (const Name& name : names) {
    out += path(fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", name.end.x() + 7, name.end.y(), x - 4, name.y),
                name.curve->color, 1, "opacity=\"0.55\"");
    out += words(x, name.y + 4.7, kLabelSize, "start", name.curve->color, name.curve->name, "font-weight=\"600\"");
  }
  return out;
}

}  // namespace

double AxisRange::fraction(double value) const {
  if (scale == Scale::kLinear) return (value - low) / (high - low);
  return std::log(std::max(value, low) / low) / std::log(high / low);
}

AxisRange axis_range(const Axis& axis, double low, double high) {
  std::vector<double> shown = axis.ticks;
  shown.insert(shown.end(), {low, high, axis.low, axis.high});
  std::erase_if(shown, [](double value) { return !std::isfinite(value); });
  low = *std::min_element(shown.begin(), shown.end());
  high = *std::max_element(shown.begin(), shown.end());
  AxisRange range{.scale = axis.scale, .low = low, .high = high, .ticks = axis.ticks};
  const bool is_log = axis.scale == Scale::kLog;
  if (!axis.ticks.empty()) {
    const double factor = is_log ? std::pow(high / low, 0.05) : 1;
    const double room = is_log ? 0 : 0.05 * (high - low);
    range.low = low / factor - room;
    range.high = high * factor + room;
    return range;
  }
  if (high - low <= kSlack * std::max(std::abs(low), std::abs(high))) {
    const double room = low == 0 ? 1 : 0.1 * std::abs(low);
    low -= room;
    high += room;
  }
  if (!is_log) {
    const double step = round_length((high - low) / 3.5);
    const double last = std::ceil(high / step - kSlack);
    for (double i = std::floor(low / step + kSlack); i <= last; ++i) range.ticks.push_back(i * step);
    range.low = range.ticks.front();
    range.high = range.ticks.back();
    return range;
  }
  std::vector<double> powers;
  std::vector<double> round;
  for (double decade = std::floor(std::log10(low)); decade <= std::ceil(std::log10(high)); ++decade) {
    for (int lead = 1; lead <= 9; ++lead) {
      range.minor.push_back(lead * std::pow(10.0, decade));
      if (lead == 1) powers.push_back(range.minor.back());
      if (lead == 1 || lead == 2 || lead == 5) round.push_back(range.minor.back());
    }
  }
  range.low = *std::prev(std::upper_bound(round.begin(), round.end(), low * (1 + kSlack)));
  range.high = *std::lower_bound(round.begin(), round.end(), high * (1 - kSlack));
  range.ticks = high > 100 * low ? powers : round;
  for (std::vector<double>* values : {&range.ticks, &range.minor}) {
    std::erase_if(*values, [&](double value) { return value < range.low || value > range.high; });
  }
  return range;
}

std::vector<std::string> tick_texts(const AxisRange& range) {
  std::size_t decimals = 0;
  bool is_fixed = range.scale == Scale::kLinear;
  for (const double tick : range.ticks) {
    const std::string text = fmt::format("{:.6g}", tick);
    if (text.find('.') != std::string::npos) decimals = std::max(decimals, text.size() - text.find('.') - 1);
    if (text.find('e') != std::string::npos) is_fixed = false;
  }
  std::vector<std::string> texts;
  for (const double tick : range.ticks) {
    texts.push_back(with_minus(is_fixed ? fmt::format("{:.{}f}", tick, decimals) : fmt::format("{:.6g}", tick)));
  }
  return texts;
}

std::string with_minus(std::string text) {
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) text.replace(at, 1, "\u2212");
  return text;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const std::string_view name = c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : "";
    out += name.empty() ? std::string_view(&c, 1) : name;
  }
  return out;
}

std::string svg_text(const Figure& figure) {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
      "font-family=\"Inter, 'Segoe UI', 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      figure.width, figure.height, escaped(figure.title));
  out += words(20, 28, 17, "start", "#111", figure.title, "font-weight=\"700\"");
  out += words(20, 48, 13, "start", "#555", figure.subtitle);
  for (const SvgPlot& plot : figure.plots) {
    const PlotField field = make_field(plot, figure);
    out += axes(field, plot);
    for (auto curve = plot.curves.rbegin(); curve != plot.curves.rend(); ++curve) out += drawn(field, *curve);
    if (plot.has_legend) out += legend(field, plot.curves);
  }
  return out + "</svg>\n";
}

}  // namespace sprung
