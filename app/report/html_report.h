#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/report/experiment_picture.h"
#include "app/report/svg_plot.h"
#include "app/validate/case_result.h"

namespace sprung {

/// What an experiment is, in words. `name` is what its checks call it.
struct ReportExperiment {
  std::string name{};
  std::string title{};
  std::string what{};  // one or more sentences
};

/// A picture of an experiment; an empty experiment stands for the summary.
struct ReportPicture {
  std::string experiment{};
  std::string caption{};
  Image image{};
  ColorBar colors{};
};

/// A plot of an experiment; an empty experiment stands for the summary.
struct ReportPlot {
  std::string experiment{};
  std::string caption{};
  Figure figure{};
};

/// A table of an experiment.
struct ReportTable {
  std::string experiment{};
  TextTable table{};
};

struct Report {
  std::vector<Check> checks{};
  std::vector<ReportExperiment> experiments{};  // in the order of the page; others follow as their checks do
  std::vector<ReportPicture> pictures{};
  std::vector<ReportPlot> plots{};
  std::vector<ReportTable> tables{};
  std::string made{};  // date and time of the run, for the header
  double seconds = 0;  // that the run took
};

/// The report as one HTML page that needs nothing from outside: plots as SVG, pictures as PNG within it. Throws
/// Error(kFailed) where a picture cannot be encoded.
[[nodiscard]] std::string html_report(const Report& report);

/// Writes that page beside its name and renames it. Throws Error(kFailed).
void write_html_report(const Report& report, const std::filesystem::path& file);

}  // namespace sprung
