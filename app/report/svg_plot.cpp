#include "app/report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace sprung {

namespace {

constexpr double kTickSize = 13;  // px, height of the letters
constexpr double kLabelSize = 13.5;
constexpr double kTitleSize = 14.5;
constexpr double kLetter = 0.58;  // width of a letter over its height, generous
constexpr double kNameStep = 18;  // between the names of two curves
constexpr double kNameGap = 26;   // from the frame to the names
constexpr double kMarkerRadius = 4.6;
constexpr std::string_view kFonts = "Inter, 'Segoe UI', 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif";

double text_width(std::string_view text, double size) {
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
  return kLetter * size * double(letters);
}

/// Where a plot's data are drawn, px, and what its axes show.
struct Field {
  double left, top, right, bottom;
  AxisRange x, y;

  [[nodiscard]] Eigen::Vector2d at(double vx, double vy) const {
    return {left + x.fraction(vx) * (right - left), bottom - y.fraction(vy) * (bottom - top)};
  }
};

AxisRange range_over(const Axis& axis, const SvgPlot& plot, int coordinate) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto include = [&](double value) {
    if (axis.scale == Scale::kLog && value <= 0) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const Curve& curve : plot.curves) {
    for (const Eigen::Vector2d& point : curve.points) {
      if (point.allFinite()) include(point[coordinate]);
    }
  }
  if (coordinate == 1 && plot.guide) include(plot.guide->y);
  if (low > high) low = high = 1;
  return axis_range(axis, low, high);
}

Field make_field(const Panel& panel) {
  const SvgPlot& plot = panel.plot;
  Field field{panel.x,
              panel.y,
              panel.x + panel.width,
              panel.y + panel.height,
              range_over(plot.x, plot, 0),
              range_over(plot.y, plot, 1)};
  double ticks = 0;
  for (const std::string& text : tick_texts(field.y)) ticks = std::max(ticks, text_width(text, kTickSize));
  double names = 0;
  for (const Curve& curve : plot.curves) names = std::max(names, text_width(curve.name, kLabelSize));
  field.left += ticks + (plot.y.label.empty() ? 14 : 38);
  field.top += plot.title.empty() ? 8 : 30;
  field.right -= plot.names_curves && names > 0 ? names + kNameGap : 14;
  field.bottom -= plot.x.label.empty() ? 26 : 48;
  return field;
}

std::string line(double x1, double y1, double x2, double y2, std::string_view style) {
  return fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" {}/>)"
                     "\n",
                     x1, y1, x2, y2, style);
}

/// anchor: start, middle or end. `more` are further attributes.
std::string words(double x, double y, double size, std::string_view anchor, std::string_view color,
                  std::string_view text, std::string_view more = "") {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" font-size="{}" text-anchor="{}" fill="{}"{}>{}</text>)"
                     "\n",
                     x, y, size, anchor, color, more, escaped(text));
}

std::string grid_lines(const Field& f) {
  constexpr std::string_view kMinor = R"(stroke="#f1f1f1" stroke-width="1")";
  constexpr std::string_view kMajor = R"(stroke="#dedede" stroke-width="1")";
  std::string out;
  for (const double v : f.y.minor) out += line(f.left, f.at(f.x.low, v).y(), f.right, f.at(f.x.low, v).y(), kMinor);
  for (const double v : f.x.minor) out += line(f.at(v, f.y.low).x(), f.top, f.at(v, f.y.low).x(), f.bottom, kMinor);
  for (const double v : f.y.ticks) out += line(f.left, f.at(f.x.low, v).y(), f.right, f.at(f.x.low, v).y(), kMajor);
  for (const double v : f.x.ticks) out += line(f.at(v, f.y.low).x(), f.top, f.at(v, f.y.low).x(), f.bottom, kMajor);
  out += line(f.left, f.bottom, f.right, f.bottom, R"(stroke="#555" stroke-width="1.2")");
  out += line(f.left, f.top, f.left, f.bottom, R"(stroke="#555" stroke-width="1.2")");
  return out;
}

std::string axis_words(const Field& f, const Panel& panel) {
  std::string out;
  const std::vector<std::string> across = tick_texts(f.x);
  double free_from = -1e9;  // a label that would touch the one before it is left out
  for (std::size_t i = 0; i < across.size(); ++i) {
    const double x = f.at(f.x.ticks[i], f.y.low).x();
    const double half = 0.5 * text_width(across[i], kTickSize);
    if (x - half < free_from) continue;
    out += words(x, f.bottom + 18, kTickSize, "middle", "#333", across[i]);
    free_from = x + half + 4;
  }
  const std::vector<std::string> up = tick_texts(f.y);
  for (std::size_t i = 0; i < up.size(); ++i) {
    out += words(f.left - 8, f.at(f.x.low, f.y.ticks[i]).y() + 4.5, kTickSize, "end", "#333", up[i]);
  }
  const SvgPlot& plot = panel.plot;
  if (!plot.title.empty()) {
    out += words(f.left, f.top - 11, kTitleSize, "start", "#111", plot.title, R"( font-weight="600")");
  }
  if (!plot.x.label.empty()) {
    out += words(0.5 * (f.left + f.right), f.bottom + 40, kLabelSize, "middle", "#333", plot.x.label);
  }
  if (!plot.y.label.empty()) {
    const double x = panel.x + 14;
    const double y = 0.5 * (f.top + f.bottom);
    out += words(x, y, kLabelSize, "middle", "#333", plot.y.label,
                 fmt::format(R"x( transform="rotate(-90 {:.1f} {:.1f})")x", x, y));
  }
  return out;
}

std::string guide_line(const Field& f, const GuideLine& guide) {
  const double y = f.at(f.x.low, guide.y).y();
  return line(f.left, y, f.right, y, R"(stroke="#777" stroke-width="1.2" stroke-dasharray="5 4")") +
         words(f.left + 8, y - 5, 12, "start", "#666", guide.name);
}

std::string marker_shape(Marker marker, const Eigen::Vector2d& p, std::string_view color) {
  const double r = kMarkerRadius;
  const std::string style = fmt::format(R"(fill="{}" stroke="#fff" stroke-width="1.2")", color);
  const auto path = [&](double x1, double y1, double x2, double y2, double x3, double y3, double x4, double y4) {
    return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z\" {}/>\n", p.x() + x1,
                       p.y() + y1, p.x() + x2, p.y() + y2, p.x() + x3, p.y() + y3, p.x() + x4, p.y() + y4, style);
  };
  switch (marker) {
    case Marker::kNone:
      return "";
    case Marker::kDot:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.5\" fill=\"{}\" opacity=\"0.5\"/>\n", p.x(), p.y(),
                         color);
    case Marker::kCircle:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" {}/>\n", p.x(), p.y(), r, style);
    case Marker::kSquare:
      return path(-0.9 * r, -0.9 * r, 0.9 * r, -0.9 * r, 0.9 * r, 0.9 * r, -0.9 * r, 0.9 * r);
    case Marker::kDiamond:
      return path(0, -1.25 * r, 1.25 * r, 0, 0, 1.25 * r, -1.25 * r, 0);
    case Marker::kTriangle:
      return path(0, -1.2 * r, 1.15 * r, 0.85 * r, -1.15 * r, 0.85 * r, -1.15 * r, 0.85 * r);
    case Marker::kCross:
      break;
  }
  const std::string bar = fmt::format(R"(stroke="{}" stroke-width="2.2")", color);
  const double d = 0.8 * r;
  return line(p.x() - d, p.y() - d, p.x() + d, p.y() + d, bar) + line(p.x() - d, p.y() + d, p.x() + d, p.y() - d, bar);
}

std::string curve_shape(const Field& f, const Curve& curve) {
  std::string path;
  std::string markers;
  bool goes_on = false;
  for (const Eigen::Vector2d& value : curve.points) {
    const bool shown = value.allFinite();
    if (shown) {
      const Eigen::Vector2d p = f.at(value.x(), value.y());
      path += fmt::format("{}{:.2f} {:.2f}", goes_on ? "L" : "M", p.x(), p.y());
      markers += marker_shape(curve.marker, p, curve.color);
    }
    goes_on = shown;
  }
  if (path.empty() || curve.width <= 0) return markers;
  return fmt::format(
             R"(<path d="{}" fill="none" stroke="{}" stroke-width="{}" stroke-linejoin="round" stroke-linecap="round"{}/>)"
             "\n",
             path, curve.color, curve.width, curve.dashed ? R"( stroke-dasharray="6 5")" : "") +
         markers;
}

/// "34", "1.8", "0.42".
std::string two_digits(double value) {
  const int decimals = value == 0 ? 0 : std::clamp(1 - int(std::floor(std::log10(std::abs(value)))), 0, 6);
  return fmt::format("{:.{}f}", value, decimals);
}

std::string values_at_points(const Field& f, const Curve& curve) {
  if (!curve.shows_values) return "";
  constexpr std::string_view kHalo = R"( font-weight="600" stroke="#fff" stroke-width="4" paint-order="stroke")";
  std::string out;
  for (const Eigen::Vector2d& value : curve.points) {
    if (!value.allFinite()) continue;
    const Eigen::Vector2d p = f.at(value.x(), value.y());
    out += words(p.x(), p.y() + 20, kTickSize, "middle", curve.color, two_digits(value.y()), kHalo);
  }
  return out;
}

struct CurveName {
  const Curve* curve;
  Eigen::Vector2d end;  // of the curve, px
  double y;             // of the name
};

/// Moves names apart, as little as the order and the field allow.
void spread(std::vector<CurveName>& names, double top, double bottom) {
  std::stable_sort(names.begin(), names.end(), [](const auto& a, const auto& b) { return a.end.y() < b.end.y(); });
  const int rounds = 200;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 1; i < names.size(); ++i) {
      const double deficit = kNameStep - (names[i].y - names[i - 1].y);
      if (deficit <= 0) continue;
      names[i - 1].y -= 0.5 * deficit;
      names[i].y += 0.5 * deficit;
    }
    if (names.front().y < top) names.front().y = top;
    if (names.back().y > bottom) names.back().y = bottom;
  }
}

std::string curve_names(const Field& f, const SvgPlot& plot) {
  std::vector<CurveName> names;
  for (const Curve& curve : plot.curves) {
    const auto last =
        std::find_if(curve.points.rbegin(), curve.points.rend(), [](const auto& p) { return p.allFinite(); });
    if (curve.name.empty() || last == curve.points.rend()) continue;
    const Eigen::Vector2d end = f.at(last->x(), last->y());
    names.push_back({&curve, end, end.y()});
  }
  if (names.empty()) return "";
  spread(names, f.top + 4, f.bottom - 4);
  std::string out;
  for (const CurveName& name : names) {
    const double x = f.right + kNameGap - 5;
    out += line(name.end.x() + 7, name.end.y(), x - 4, name.y,
                fmt::format(R"(stroke="{}" stroke-width="1" opacity="0.55")", name.curve->color));
    out += words(x, name.y + 4.7, kLabelSize, "start", name.curve->color, name.curve->name, R"( font-weight="600")");
  }
  return out;
}

std::string panel_shape(const Panel& panel) {
  const Field field = make_field(panel);
  std::string out = grid_lines(field) + axis_words(field, panel);
  if (panel.plot.guide) out += guide_line(field, *panel.plot.guide);
  for (auto curve = panel.plot.curves.rbegin(); curve != panel.plot.curves.rend(); ++curve) {
    out += curve_shape(field, *curve);
  }
  for (const Curve& curve : panel.plot.curves) out += values_at_points(field, curve);
  return panel.plot.names_curves ? out + curve_names(field, panel.plot) : out;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

Figure single_plot(std::string title, std::string subtitle, SvgPlot plot) {
  Figure figure{.title = std::move(title), .subtitle = std::move(subtitle)};
  figure.panels.push_back({std::move(plot), 14, kHeadingHeight, figure.width - 28, figure.height - kHeadingHeight - 6});
  return figure;
}

std::string svg_text(const Figure& figure, SvgUse use) {
  std::string out = fmt::format(R"(<svg {}viewBox="0 0 {} {}" width="{}" height="{}" role="img" font-family="{}">)"
                                "\n<title>{}</title>\n"
                                R"(<rect width="100%" height="100%" fill="#fff"/>)"
                                "\n",
                                use == SvgUse::kFile ? R"(xmlns="http://www.w3.org/2000/svg" )" : "", figure.width,
                                figure.height, figure.width, figure.height, kFonts, escaped(figure.title));
  out += words(20, 28, 17, "start", "#111", figure.title, R"( font-weight="700")");
  out += words(20, 48, 13, "start", "#555", figure.subtitle);
  for (const Panel& panel : figure.panels) out += panel_shape(panel);
  return out + "</svg>\n";
}

}  // namespace sprung
