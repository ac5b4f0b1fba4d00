#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "app/validate/check.h"

/// Made-up checks, and readers of SVG and HTML text, for tests of plots and reports.
namespace sprung::test {

/// The error in a piece of XML: tags that do not match, attributes without quotes, a stray < or &. Empty: none.
inline std::string xml_fault(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < xml.size(); ++at) {
    if (xml[at] == '&') {
      const std::size_t end = xml.find(';', at);
      if (end == std::string::npos || end - at > 6) return "stray & at " + std::to_string(at);
    }
    if (xml[at] != '<') continue;
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return "open < at " + std::to_string(at);
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos) return "< in a tag: " + tag;
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return "odd quotes: " + tag;
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag.front() == '/') {
      if (open.empty() || "/" + open.back() != tag) return "unexpected <" + tag + ">";
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// The heights of texts that hold the word, px.
inline std::vector<double> heights_of(const std::string& svg, const std::string& word) {
  std::vector<double> heights;
  for (std::size_t at = svg.find(">" + word); at != std::string::npos; at = svg.find(">" + word, at + 1)) {
    const std::size_t y = svg.find(" y=\"", svg.rfind("<text", at));
    heights.push_back(std::stod(svg.substr(y + 4)));
  }
  return heights;
}

inline Check check(const std::string& experiment, const std::string& model, double across, double measured,
                   double tolerance = kNaN, double poisson = 0.3) {
  Check check;
  check.experiment = experiment;
  check.quantity = "tip <deflection> & \"more\"";
  check.model = model;
  check.poisson = poisson;
  check.grid = "8x2x2";
  check.bricks_across = across;
  check.measured = measured;
  check.expected = 1;
  check.unit = "mm";
  check.source = "theory";
  check.tolerance = tolerance;
  return check;
}

inline std::vector<Check> cantilever_checks() {
  std::vector<Check> checks;
  for (const char* model : {"calibrated", "fem", "tensile", "m1", "m2-plain", "m1-plain"}) {
    for (const double poisson : {0.0, 0.3, 0.49}) {
      for (const double across : {1.0, 2.0, 4.0, 8.0}) {
        checks.push_back(check("cantilever", model, across, 1 - 0.3 / (across * across), kNaN, poisson));
        checks.back().quantity = "tip.displacement.y";
      }
    }
  }
  return checks;
}

}  // namespace sprung::test
