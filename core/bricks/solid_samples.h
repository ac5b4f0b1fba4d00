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

/// An interval inside the surface on a line of samples.
struct InsideRun {
  int u;        // the line's position: sample indices along the two axes after its own
  int v;        //
  double from;  // cells
  double to;
};

/// The intervals inside the surface on all lines of samples along `axis`, by position and from low to high. Inside is
/// where the winding number is not 0. Ties are broken as in cast_columns(). A line that does not leave the surface as
/// often as it enters is ignored.
[[nodiscard]] std::vector<InsideRun> inside_runs(const CellSurface& surface, int axis);

/// Finds the brick whose solid lies under a point of the surface, by the grid's patches.
class SolidFinder {
 public:
  explicit SolidFinder(const BrickGrid& grid);

  /// `position` and `inward` (unit, or zero if unknown) in lattice units. -1: no patch nearby.
  [[nodiscard]] int under(const Vec3& position, const Vec3& inward) const;

 private:
  struct Nearest {
    int brick = -1;
    double cost;  // squared bricks
  };
  void consider(const Eigen::Vector3i& cell, const Vec3& position, const Vec3& inward, Nearest& nearest) const;

  const BrickGrid& grid_;
  CellIndex bricks_;
  CellIndex patches_;
};

/// An interval inside the surface, in one cell, too short to contain a sample.
struct Spot {
  Vec3 position;  // its middle, in cells
  float weight;   // amount of solid, in samples
};

/// The samples of a cell that the surface cuts. Sample x + 8 y + 64 z is at (x, y, z) + 1/2 eighths of the cell; spot i
/// is sample 512 + i.
struct CutCell {
  int brick;
  std::array<std::uint8_t, 512> lines{};  // bit axis: inside by that axis's line; 3 + axis: up to the next sample
  std::array<std::uint8_t, 512> below{};  // bit axis: inside down to the sample before
  std::vector<Spot> spots;
  std::vector<std::uint8_t> piece;     // of each sample and spot, counted from 1; 0: outside, or too small
  std::vector<float> weights;          // of the pieces, in samples
  std::vector<LineIntegrals> solid{};  // of the pieces
};

/// Two samples on one line in neighbouring cells, at least one a spot, with no surface between them.
struct SpotLink {
  int low_cell;  // rows of cut_cells; -1: that cell is not cut
  int low_sample;
  int low_brick;
  int high_cell;
  int high_sample;
  int high_brick;
  int axis;
};

/// Samples of the solid along lines through a grid of distinct cells.
class SolidSamples {
 public:
  SolidSamples(const CellSurface& surface, const BrickGrid& grid);

  /// The cut cell of a brick, or -1 if the surface does not cut it.
  [[nodiscard]] int cut_cell_of(int brick) const { return cut_cell_of_[brick]; }
  [[nodiscard]] const std::vector<CutCell>& cut_cells() const { return cut_cells_; }
  [[nodiscard]] const std::vector<SpotLink>& spot_links() const { return spot_links_; }
  /// The brick at a cell, or -1.
  [[nodiscard]] int brick_at(const Eigen::Vector3i& cell) const;
  /// In cells.
  [[nodiscard]] Vec3 position_of(const CutCell& cell, int sample) const;
  /// Returns whether a straight line meets no triangle.
  [[nodiscard]] bool sees(const Vec3& from, const Vec3& to) const { return !triangles_.is_blocked(from, to); }

 private:
  void mark_cut(const std::vector<InsideRun>& runs, int axis);
  /// The first and the last sample of a run in a cell, or its spot; -1: too short for a spot.
  struct Stretch {
    int first;
    int last;
  };
  void add_run(const InsideRun& run, int axis);
  static Stretch add_stretch(const InsideRun& run, int axis, int c, CutCell& cell);
  static Stretch add_spot(const InsideRun& run, int axis, int c, CutCell& cell);
  void find_pieces(CutCell& cell) const;
  void integrate(const InsideRun& run, int axis, std::vector<int>& spots_passed);
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
