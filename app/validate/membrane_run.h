#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "app/validate/case_result.h"
#include "core/body/membrane.h"

namespace sprung {

/// Columns and rows of a membrane.
using MembraneCounts = std::array<int, 2>;

struct MembraneModel {
  RectangleModel model;
  std::string_view name;
};

/// The rectangles that answer to a choice of bricks: all three without one, none for a model that has no 2D
/// counterpart. M1 and M2 are the same in 2D, where edges and diagonals are all there is.
[[nodiscard]] std::vector<MembraneModel> membrane_models(const Choice& choice);

/// The grids of a membrane four times as long as high that answer to a choice, else the given ones.
[[nodiscard]] std::vector<MembraneCounts> membrane_counts(const Choice& choice, std::vector<MembraneCounts> varied);

/// Of a membrane of E = 1 kPa and 1 kg/m2.
[[nodiscard]] Material membrane_material(double poisson);

/// Whether the model's springs represent the ratio: plain ones only 1/3.
[[nodiscard]] bool is_exact(RectangleModel model, double poisson);

/// A check of a membrane, without its numbers.
[[nodiscard]] Check membrane_check(std::string_view experiment, const MembraneModel& model, double poisson,
                                   const MembraneCounts& counts);

/// One membrane and what becomes of it under its loads.
class MembraneRun {
 public:
  /// `size` in m. Throws Error(kBadInput) where the model's springs cannot take the shape of the rectangles.
  MembraneRun(const MembraneCounts& counts, const Vec2& size, RectangleModel model, double poisson);

  [[nodiscard]] int node(int column, int row) const { return column + row * (counts_[0] + 1); }
  [[nodiscard]] int columns() const { return counts_[0]; }
  [[nodiscard]] int rows() const { return counts_[1]; }
  Membrane& membrane() { return membrane_; }
  Points2& loads() { return loads_; }

  /// A traction (Pa) on the side at that column, and at that row.
  void pull_column(int column, const Vec2& traction);
  void pull_row(int row, const Vec2& traction);

  /// Small displacements under the loads, m.
  [[nodiscard]] Points2 displacements() const;

 private:
  MembraneCounts counts_;
  Vec2 size_;
  Membrane membrane_;
  Points2 loads_;
};

}  // namespace sprung
