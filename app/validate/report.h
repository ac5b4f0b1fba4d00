#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/validate/cases.h"
#include "app/validate/svg_plot.h"

namespace sprung {

/// A case and its result.
struct FinishedCase {
  Case definition{};
  CaseResult result{};
};

/// A case as the page shows it.
struct ReportSection {
  std::string title{};
  std::string about{};
  CaseResult result{};
  std::vector<Figure> figures{};
  std::optional<CasePicture> picture{};
};

struct Report {
  std::vector<ReportSection> sections{};  // those with nothing to show are left out
  std::vector<Figure> figures{};          // of the summary
  std::string date{};                     // and time of the run
  double seconds = 0;                     // that the checks took
};

/// The report as one HTML page that loads nothing: figures are SVG, pictures PNG within it.
[[nodiscard]] std::string html_report(const Report& report);

/// Draws a picture of every case, and the figures, and writes report.html and the figures (SVG) to the folder.
/// `seconds` that the checks took. Throws Error(kFailed), and what the observer throws to stop.
void make_report(const std::filesystem::path& folder, const std::vector<FinishedCase>& cases, double seconds,
                 const Observer& observer);

/// report.html: the page with a comment <!--name--> in place of each of its parts.
[[nodiscard]] std::string_view report_template();

}  // namespace sprung
