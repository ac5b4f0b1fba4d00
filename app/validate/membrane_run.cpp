#include "app/validate/membrane_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/statics/membrane_statics.h"

namespace sprung {
namespace {

constexpr double kYoung = 1000;     // Pa
constexpr double kSlenderness = 4;  // length over height of a chosen grid

constexpr MembraneModel kCalibrated{.model = RectangleModel::kCalibrated, .name = "2d-calibrated"};
constexpr MembraneModel kCorrected{.model = RectangleModel::kCorrected, .name = "2d-corrected"};
constexpr MembraneModel kPlain{.model = RectangleModel::kPlain, .name = "2d-plain"};

}  // namespace

std::vector<MembraneModel> membrane_models(const Choice& choice) {
  if (!choice.model) return {kCalibrated, kCorrected, kPlain};
  switch (*choice.model) {
    case Model::kCalibrated:
      return {kCalibrated};
    case Model::kTensile:
    case Model::kM1:
      return {kCorrected};
    case Model::kM2Plain:
    case Model::kM1Plain:
      return {kPlain};
    case Model::kFem:
      break;
  }
  return {};
}

std::vector<MembraneCounts> membrane_counts(const Choice& choice, std::vector<MembraneCounts> varied) {
  if (!choice.bricks) return varied;
  return {{*choice.bricks, std::max(1, int(std::lround(*choice.bricks / kSlenderness)))}};
}

Material membrane_material(double poisson) {
  return {.name = "membrane", .young = kYoung, .poisson = poisson, .density = 1, .damping = 0, .source = ""};
}

bool is_exact(RectangleModel model, double poisson) {
  return model != RectangleModel::kPlain || std::abs(poisson - 1.0 / 3) < 1e-12;
}

Check membrane_check(std::string_view experiment, const MembraneModel& model, double poisson,
                     const MembraneCounts& counts) {
  Check check;
  check.experiment = experiment;
  check.model = model.name;
  check.poisson = std::round(poisson * 1e4) / 1e4;
  check.grid = fmt::format("{}x{}", counts[0], counts[1]);
  check.bricks_across = counts[1];
  check.measured = std::numeric_limits<double>::quiet_NaN();
  check.tolerance = std::numeric_limits<double>::quiet_NaN();
  return check;
}

MembraneRun::MembraneRun(const MembraneCounts& counts, const Vec2& size, RectangleModel model, double poisson)
    : counts_(counts),
      size_(size),
      membrane_(make_membrane(counts[0], counts[1], size, model, membrane_material(poisson))),
      loads_(Points2::Zero(membrane_.node_count(), 2)) {}

void MembraneRun::pull_column(int column, const Vec2& traction) {
  for (int row = 0; row <= rows(); ++row) {
    const double share = row == 0 || row == rows() ? 0.5 : 1;
    loads_.row(node(column, row)) += share * size_.y() / rows() * traction.transpose();
  }
}

void MembraneRun::pull_row(int row, const Vec2& traction) {
  for (int column = 0; column <= columns(); ++column) {
    const double share = column == 0 || column == columns() ? 0.5 : 1;
    loads_.row(node(column, row)) += share * size_.x() / columns() * traction.transpose();
  }
}

Points2 MembraneRun::displacements() const { return solve_linear(membrane_, loads_); }

}  // namespace sprung
