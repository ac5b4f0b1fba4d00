#pragma once
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/bricks/column_caster.h"
#include "core/disjoint_sets.h"
#include "core/mesh/query/triangle_grid.h"

namespace sprung {

/// Samples of a cell along each axis: at (i + 1/2) / 8.
inline constexpr int kSamplesAlong = 8;
inline constexpr double kSamplePitch = 1.0 / kSamplesAlong;  // brick lengths

/// A stretch inside the surface of a line through samples.
struct InsideRun {
  int u;        // sample numbers along the two axes that follow the line's own one: its place
  int v;        //
  double from;  // cells
  double to;
};

/// What is inside the surface of the lines through all samples of the box along `axis`, by place and from low to high.
/// Inside is where the surface winds around a point at all. Ties are broken as in cast_columns(). A line that does not
/// leave the surface as often as it enters says nothing.
[[nodiscard]] std::vector<InsideRun> inside_runs(const CellSurface& surface, int axis);

/// Finds the brick whose solid is under a place of the surface, by the grid's patches.
class SolidFinder {
 public:
  explicit SolidFinder(const BrickGrid& grid);

  /// `place` and `inward` (unit, or zero where unknown) in lattice units. -1: nothing is known near the place.
  [[nodiscard]] int under(const Vec3& place, const Vec3& inward) const;

 private:
  struct Nearest {
    int brick = -1;
    double cost;  // squared bricks
  };
  void consider(const Eigen::Vector3i& cell, const Vec3& place, const Vec3& inward, Nearest& nearest) const;

  const BrickGrid& grid_;
  CellIndex bricks_;
  CellIndex patches_;
};

/// A stretch of a line through samples that lies inside, in a cell, but too short to hold a sample.
struct Spot {
  Vec3 place;    // its middle, in cells
  float weight;  // samples' worth of solid
};

/// The samples of a cell that the surface cuts. Sample x + 8 y + 64 z is at (x, y, z) + 1/2 eighths of the cell; spot i
/// counts as sample 512 + i.
struct CutCell {
  int brick;
  std::array<std::uint8_t, 512> lines{};  // bit axis: inside, by the line along it; 3 + axis: up to the next sample too
  std::array<std::uint8_t, 512> below{};  // bit axis: inside down to the sample before
  std::vector<Spot> spots;
  std::vector<std::uint8_t> piece;  // of each sample and spot, counted from 1; 0: outside, or too little
  std::vector<float> weights;       // of the pieces, in samples
};

/// Samples of two neighbouring cells on one line with nothing between them, of which one is a spot.
struct SpotLink {
  int low_cell;  // rows of cut_cells; -1: that cell is not cut
  int low_sample;
  int low_brick;
  int high_cell;
  int high_sample;
  int high_brick;
  int axis;
};

/// What straight lines tell of the solid in the cells of a grid, each of which comes once.
class SolidSamples {
 public:
  SolidSamples(const CellSurface& surface, const BrickGrid& grid);

  /// The cut cell of a brick, or -1 where the surface does not cut it.
  [[nodiscard]] int cut_cell_of(int brick) const { return cut_cell_of_[brick]; }
  [[nodiscard]] const std::vector<CutCell>& cut_cells() const { return cut_cells_; }
  [[nodiscard]] const std::vector<SpotLink>& spot_links() const { return spot_links_; }
  /// The brick at a cell, or -1.
  [[nodiscard]] int brick_at(const Eigen::Vector3i& cell) const;
  /// In cells.
  [[nodiscard]] Vec3 place_of(const CutCell& cell, int sample) const;
  /// Whether a straight line meets no triangle.
  [[nodiscard]] bool sees(const Vec3& from, const Vec3& to) const { return !triangles_.is_blocked(from, to); }

 private:
  void mark_cut(const std::vector<InsideRun>& runs, int axis);
  /// The first and the last of a run's samples in a cell; its only spot; -1: too short for one.
  struct Stretch {
    int first;
    int last;
  };
  void add_run(const InsideRun& run, int axis);
  static Stretch add_stretch(const InsideRun& run, int axis, int c, CutCell& cell);
  static Stretch add_spot(const InsideRun& run, int axis, int c, CutCell& cell);
  void find_pieces(CutCell& cell) const;
  void join_spots(const CutCell& cell, DisjointSets& sets) const;
  void join_diagonally(const CutCell& cell, DisjointSets& sets) const;

  const BrickGrid& grid_;
  Eigen::Vector3i counts_;
  TriangleGrid triangles_;
  std::vector<int> brick_at_;     // by cell of the box
  std::vector<int> cut_cell_of_;  // by brick
  std::vector<CutCell> cut_cells_;
  std::vector<SpotLink> spot_links_;
};

}  // namespace sprung
