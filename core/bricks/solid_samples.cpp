#include "core/bricks/solid_samples.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/bricks/column_caster.h"
#include "core/disjoint_sets.h"

namespace sprung {
namespace {

constexpr std::int64_t kSnapPitch = kSnap / kSamplesAlong;

struct LineCrossing {
  std::int64_t line;
  double depth;  // cells
  int turn;      // +1 entering, -1 leaving
};

/// The first and last line between two positions (both at least 0).
std::pair<std::int64_t, std::int64_t> lines_between(std::int64_t low, std::int64_t high) {
  return {(low + kSnapPitch / 2 - 1) / kSnapPitch, (high + kSnapPitch / 2) / kSnapPitch - 1};
}

class LineCaster {
 public:
  LineCaster(const CellSurface& surface, int axis)
      : surface_(surface), axis_(axis), along_u_(std::int64_t{surface.counts[(axis + 1) % 3]} * kSamplesAlong) {}

  std::vector<InsideRun> runs() {
    for (int t = 0; t < surface_.triangles.rows(); ++t) cross_triangle(t);
    sort_crossings();
    std::vector<InsideRun> runs;
    runs.reserve(crossings_.size() / 2);
    for (std::size_t begin = 0; begin < crossings_.size();) begin = add_line(begin, runs);
    return runs;
  }

 private:
  void cross_triangle(int t) {
    const SnappedTriangle triangle(surface_, t, axis_);
    if (triangle.is_empty()) return;
    const auto [low_u, low_v] = triangle.low();
    const auto [high_u, high_v] = triangle.high();
    const auto [first_u, last_u] = lines_between(low_u, high_u);
    const auto [first_v, last_v] = lines_between(low_v, high_v);
    for (std::int64_t v = first_v; v <= last_v; ++v) {
      for (std::int64_t u = first_u; u <= last_u; ++u) {
        const std::optional<double> depth =
            triangle.depth_at({u * kSnapPitch + kSnapPitch / 2, v * kSnapPitch + kSnapPitch / 2});
        if (depth) crossings_.push_back({v * along_u_ + u, *depth, triangle.turn()});
      }
    }
  }

  void sort_crossings() {
    std::stable_sort(crossings_.begin(), crossings_.end(), [](const LineCrossing& a, const LineCrossing& b) {
      return a.line != b.line ? a.line < b.line : a.depth < b.depth;
    });
  }

  /// Returns where the next line begins.
  std::size_t add_line(std::size_t begin, std::vector<InsideRun>& runs) const {
    const std::int64_t line = crossings_[begin].line;
    const std::size_t runs_before = runs.size();
    int winding = 0;
    std::size_t i = begin;
    double entered = 0;
    for (; i < crossings_.size() && crossings_[i].line == line; ++i) {
      const int before = winding;
      winding += crossings_[i].turn;
      if (before == 0) entered = crossings_[i].depth;
      if (winding != 0 || crossings_[i].depth <= entered) continue;
      runs.push_back({int(line % along_u_), int(line / along_u_), entered, crossings_[i].depth});
    }
    if (winding != 0) runs.resize(runs_before);
    return i;
  }

  const CellSurface& surface_;
  int axis_;
  std::int64_t along_u_;
  std::vector<LineCrossing> crossings_;
};

}  // namespace

std::vector<InsideRun> inside_runs(const CellSurface& surface, int axis) { return LineCaster(surface, axis).runs(); }

namespace {

constexpr double kNudge = 1e-3;  // bricks, an inward shift, so that a point on a face is in the cell of its solid
constexpr double kOutward = 16;  // cost of an outward distance relative to an inward one
constexpr double kNear = 0.25;   // bricks: solid this near in the point's own cell is taken without further search

std::vector<Eigen::Vector3i> cells_of(const std::vector<SolidPatch>& patches) {
  std::vector<Eigen::Vector3i> cells;
  cells.reserve(patches.size());
  for (const SolidPatch& patch : patches) cells.push_back(patch.cell);
  return cells;
}

double cost_of(const Vec3& way, const Vec3& inward) {
  const double along = way.dot(inward);
  return way.squaredNorm() + (along < 0 ? kOutward * along * along : 0);
}

double cost_to(const SolidPatch& patch, const Vec3& position, const Vec3& inward) {
  double least = std::numeric_limits<double>::infinity();
  const Vec3 local = position - patch.cell.cast<double>();
  for (std::size_t i = patch.samples._Find_first(); i < patch.samples.size(); i = patch.samples._Find_next(i)) {
    const Vec3 sample = (Vec3(double(i & 7), double(i >> 3 & 7), double(i >> 6)).array() + 0.5) / 8;
    least = std::min(least, cost_of(sample - local, inward));
  }
  for (const Eigen::Vector3f& spot : patch.spots) least = std::min(least, cost_of(spot.cast<double>() - local, inward));
  return least;
}

}  // namespace

SolidFinder::SolidFinder(const BrickGrid& grid) : grid_(grid), bricks_(grid.cells), patches_(cells_of(grid.patches)) {}

void SolidFinder::consider(const Eigen::Vector3i& cell, const Vec3& position, const Vec3& inward,
                           Nearest& nearest) const {
  const auto offer = [&](int brick, double cost) {
    if (cost < nearest.cost) nearest = {brick, cost};
  };
  const int first = patches_.at(cell);
  if (first < 0) {
    const int brick = bricks_.at(cell);
    const Vec3 low = cell.cast<double>();
    if (brick >= 0) offer(brick, cost_of(position.cwiseMax(low).cwiseMin(low + Vec3::Ones()) - position, inward));
    return;
  }
  for (auto i = std::size_t(first); i < grid_.patches.size() && grid_.patches[i].cell == cell; ++i) {
    offer(grid_.patches[i].brick, cost_to(grid_.patches[i], position, inward));
  }
}

int SolidFinder::under(const Vec3& position, const Vec3& inward) const {
  if (grid_.patches.empty()) return -1;
  const Eigen::Vector3i centre = (position + kNudge * inward).array().floor().cast<int>();
  Nearest nearest{.cost = std::numeric_limits<double>::infinity()};
  consider(centre, position, inward, nearest);
  if (nearest.cost <= kNear * kNear) return nearest.brick;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i offset(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (i != 13) consider(centre + offset, position, inward, nearest);
  }
  return nearest.brick;
}

namespace {

constexpr int kSamples = 512;
constexpr double kShortest = 1e-3;  // cells: shorter intervals inside are ignored
constexpr double kSpotReach = 2.2;  // pitches: the range in which a spot is linked
constexpr float kMinPiece = 4;      // samples
constexpr std::size_t kMaxPieces = 100;

constexpr std::array<int, 3> kStride{1, kSamplesAlong, kSamplesAlong* kSamplesAlong};

int inside_bits(const CutCell& cell, int sample) { return cell.lines[sample] & 7; }
bool is_inside(const CutCell& cell, int sample) { return inside_bits(cell, sample) == 7; }

int along(int sample, int axis) { return sample / kStride[axis] % kSamplesAlong; }

/// Calls visit(sample) for the samples of the cell within `reach` pitches of a position along every axis.
template <class Visit>
void for_each_near(const Vec3& local, double reach, const Visit& visit) {
  const Eigen::Array3d middle = local.array() * kSamplesAlong - 0.5;
  const Eigen::Array3i low = (middle - reach).ceil().cast<int>().max(0);
  const Eigen::Array3i high = (middle + reach).floor().cast<int>().min(kSamplesAlong - 1);
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) visit(x + kSamplesAlong * (y + kSamplesAlong * z));
    }
  }
}

/// The c-th cell along a run.
Eigen::Vector3i cell_on(const InsideRun& run, int axis, int c) {
  Eigen::Vector3i cell;
  cell[axis] = c;
  cell[(axis + 1) % 3] = run.u / kSamplesAlong;
  cell[(axis + 2) % 3] = run.v / kSamplesAlong;
  return cell;
}

/// Inside samples connected along the lines.
void join_along_lines(const CutCell& cell, DisjointSets& sets) {
  for (int sample = 0; sample < kSamples; ++sample) {
    if (!is_inside(cell, sample)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const int next = sample + kStride[axis];
      const bool goes_on = (cell.lines[sample] >> (3 + axis) & 1) != 0;
      if (goes_on && along(sample, axis) + 1 < kSamplesAlong && is_inside(cell, next)) sets.merge(sample, next);
    }
  }
}

float weight_of(const CutCell& cell, int item) {
  if (item >= kSamples) return cell.spots[item - kSamples].weight;
  return is_inside(cell, item) ? 1.0F : 0.0F;
}

bool is_solid(const CutCell& cell, int item) { return item >= kSamples || is_inside(cell, item); }

/// Numbers the sets in the order of their first members; small ones next to a larger one are 0.
void number_pieces(DisjointSets& sets, CutCell& cell) {
  const int count = isize(sets);
  std::vector<float> weights(sets.size(), 0);
  for (int item = 0; item < count; ++item) weights[sets.find(item)] += weight_of(cell, item);
  const float heaviest = *std::max_element(weights.begin(), weights.end());
  const float least = std::min(heaviest, kMinPiece);
  std::vector<std::uint8_t> number(sets.size(), 0);
  cell.piece.assign(sets.size(), 0);
  for (int item = 0; item < count; ++item) {
    if (!is_solid(cell, item)) continue;
    const std::size_t set = sets.find(item);
    if (number[set] == 0 && weights[set] >= least && cell.weights.size() < kMaxPieces) {
      cell.weights.push_back(weights[set]);
      number[set] = static_cast<std::uint8_t>(cell.weights.size());
    }
    cell.piece[item] = number[set];
  }
}

}  // namespace

SolidSamples::SolidSamples(const CellSurface& surface, const BrickGrid& grid)
    : grid_(grid), counts_(surface.counts), triangles_(surface.points, surface.triangles, surface.counts) {
  brick_at_.assign(counts_.cast<std::int64_t>().prod(), -1);
  for (int brick = 0; brick < grid.brick_count(); ++brick) {
    const Eigen::Vector3i& cell = grid.cells[brick];
    brick_at_[(std::size_t(cell.z()) * std::size_t(counts_.y()) + std::size_t(cell.y())) * std::size_t(counts_.x()) +
              cell.x()] = brick;
  }
  cut_cell_of_.assign(grid.cells.size(), -1);
  std::array<std::vector<InsideRun>, 3> runs;
  for (int axis = 0; axis < 3; ++axis) {
    runs[axis] = inside_runs(surface, axis);
    mark_cut(runs[axis], axis);
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const InsideRun& run : runs[axis]) add_run(run, axis);
  }
  tbb::parallel_for(std::size_t{0}, cut_cells_.size(), [&](std::size_t i) { find_pieces(cut_cells_[i]); });
  std::vector<int> spots_passed(cut_cells_.size(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const InsideRun& run : runs[axis]) integrate(run, axis, spots_passed);
  }
}

int SolidSamples::brick_at(const Eigen::Vector3i& cell) const {
  if ((cell.array() < 0).any() || (cell.array() >= counts_.array()).any()) return -1;
  return brick_at_[(std::size_t(cell.z()) * std::size_t(counts_.y()) + std::size_t(cell.y())) *
                       std::size_t(counts_.x()) +
                   cell.x()];
}

Vec3 SolidSamples::position_of(const CutCell& cell, int sample) const {
  if (sample >= kSamples) return cell.spots[sample - kSamples].position;
  const Vec3 local(along(sample, 0) + 0.5, along(sample, 1) + 0.5, along(sample, 2) + 0.5);
  return grid_.cells[cell.brick].cast<double>() + local * kSamplePitch;
}

/// The cells where a run begins or ends, except those that it only touches.
void SolidSamples::mark_cut(const std::vector<InsideRun>& runs, int axis) {
  for (const InsideRun& run : runs) {
    for (const double end : {run.from, run.to}) {
      if (end == std::floor(end)) continue;
      const int brick = brick_at(cell_on(run, axis, int(std::floor(end))));
      if (brick < 0 || cut_cell_of_[brick] >= 0) continue;
      cut_cell_of_[brick] = isize(cut_cells_);
      cut_cells_.push_back({.brick = brick, .spots = {}, .piece = {}, .weights = {}});
    }
  }
}

void SolidSamples::add_run(const InsideRun& run, int axis) {
  SpotLink link{.low_cell = -1,
                .low_sample = 0,
                .low_brick = -1,
                .high_cell = -1,
                .high_sample = 0,
                .high_brick = -1,
                .axis = axis};
  const int last_cell = std::min(int(std::ceil(run.to)), counts_[axis]) - 1;
  for (int c = int(run.from); c <= last_cell; ++c) {
    link.high_brick = brick_at(cell_on(run, axis, c));
    link.high_cell = link.high_brick < 0 ? -1 : cut_cell_of_[link.high_brick];
    Stretch stretch{0, 0};
    if (link.high_cell >= 0) {
      stretch = add_stretch(run, axis, c, cut_cells_[link.high_cell]);
      if (stretch.first < 0) link.high_brick = -1;
    }
    link.high_sample = stretch.first;
    const bool low_is_spot = link.low_cell >= 0 && link.low_sample >= kSamples;
    if (link.low_brick >= 0 && link.high_brick >= 0 && (stretch.first >= kSamples || low_is_spot)) {
      spot_links_.push_back(link);
    }
    link.low_brick = link.high_brick;
    link.low_cell = link.high_cell;
    link.low_sample = stretch.last;
  }
}

namespace {

/// The samples of a line of samples along `axis` that are in a run's c-th cell.
struct RunSamples {
  int first;  // of the run, along the line
  int last;
  int begin;  // of these, those in the cell
  int end;
  int across;  // of the cell's sample at the beginning of the line

  RunSamples(const InsideRun& run, int axis, int c)
      : first(int(std::ceil(run.from * kSamplesAlong - 0.5))),
        last(int(std::floor(run.to * kSamplesAlong - 0.5))),
        begin(std::max(first, c * kSamplesAlong)),
        end(std::min(last, c * kSamplesAlong + kSamplesAlong - 1)),
        across(run.u % kSamplesAlong * kStride[(axis + 1) % 3] + run.v % kSamplesAlong * kStride[(axis + 2) % 3]) {}

  [[nodiscard]] bool is_spot() const { return begin > end; }
};

}  // namespace

/// The part of a run in its c-th cell.
SolidSamples::Stretch SolidSamples::add_stretch(const InsideRun& run, int axis, int c, CutCell& cell) {
  const RunSamples samples(run, axis, c);
  if (samples.is_spot()) return add_spot(run, axis, c, cell);
  const auto sample_at = [&](int s) { return samples.across + (s - c * kSamplesAlong) * kStride[axis]; };
  for (int s = samples.begin; s <= samples.end; ++s) {
    const std::size_t sample = sample_at(s);
    cell.lines[sample] |= static_cast<std::uint8_t>(1U << axis | (s < samples.last ? 8U << axis : 0U));
    cell.below[sample] |= static_cast<std::uint8_t>(s > samples.first ? 1U << axis : 0U);
  }
  return {sample_at(samples.begin), sample_at(samples.end)};
}

SolidSamples::Stretch SolidSamples::add_spot(const InsideRun& run, int axis, int c, CutCell& cell) {
  const double from = std::max(run.from, double(c));
  const double to = std::min(run.to, c + 1.0);
  if (to - from < kShortest) return {-1, -1};
  Vec3 middle;
  middle[axis] = (from + to) / 2;
  middle[(axis + 1) % 3] = (run.u + 0.5) * kSamplePitch;
  middle[(axis + 2) % 3] = (run.v + 0.5) * kSamplePitch;
  const int spot = kSamples + isize(cell.spots);
  cell.spots.push_back({middle, float((to - from) / kSamplePitch / 3)});
  return {spot, spot};
}

/// Adds a run's share of the pieces of the cells that it passes. Runs come in the order in which they made their spots;
/// `spots_passed` counts these per cell.
void SolidSamples::integrate(const InsideRun& run, int axis, std::vector<int>& spots_passed) {
  const int last_cell = std::min(int(std::ceil(run.to)), counts_[axis]) - 1;
  for (int c = int(run.from); c <= last_cell; ++c) {
    const int brick = brick_at(cell_on(run, axis, c));
    const int row = brick < 0 ? -1 : cut_cell_of_[brick];
    if (row < 0) continue;
    CutCell& cell = cut_cells_[row];
    const double from = std::max(run.from, double(c));
    const double to = std::min(run.to, c + 1.0);
    const RunSamples samples(run, axis, c);
    if (samples.is_spot() && to - from < kShortest) continue;
    const int item = samples.is_spot() ? kSamples + spots_passed[row]++
                                       : samples.across + (samples.begin - c * kSamplesAlong) * kStride[axis];
    const int piece = cell.piece[item];
    if (piece == 0) continue;
    if (cell.solid.empty()) cell.solid.resize(cell.weights.size());
    Vec3 line = Vec3::Zero();
    line[(axis + 1) % 3] = (run.u % kSamplesAlong + 0.5) * kSamplePitch - 0.5;
    line[(axis + 2) % 3] = (run.v % kSamplesAlong + 0.5) * kSamplePitch - 0.5;
    const int ends = (run.from > c ? 1 : 0) + (run.to < c + 1 ? 1 : 0);
    cell.solid[piece - 1].add(axis, line, from - c - 0.5, to - c - 0.5, ends);
  }
}

void SolidSamples::find_pieces(CutCell& cell) const {
  DisjointSets sets(kSamples + cell.spots.size());
  join_along_lines(cell, sets);
  join_diagonally(cell, sets);
  join_spots(cell, sets);
  number_pieces(sets, cell);
}

/// If several sets remain: joins diagonal neighbours in the lattice of samples.
void SolidSamples::join_diagonally(const CutCell& cell, DisjointSets& sets) const {
  int first = -1;
  bool is_one = true;
  for (int sample = 0; sample < kSamples && is_one; ++sample) {
    if (!is_inside(cell, sample)) continue;
    if (first < 0) first = sample;
    is_one = sets.find(sample) == sets.find(first);
  }
  if (is_one) return;
  const Vec3 corner = grid_.cells[cell.brick].cast<double>();
  for (int sample = 0; sample < kSamples; ++sample) {
    if (!is_inside(cell, sample)) continue;
    const Vec3 position = position_of(cell, sample);
    for_each_near(position - corner, 1.01, [&](int other) {
      if (other <= sample || !is_inside(cell, other) || sets.find(other) == sets.find(sample)) return;
      if (sees(position, position_of(cell, other))) sets.merge(sample, other);
    });
  }
}

void SolidSamples::join_spots(const CutCell& cell, DisjointSets& sets) const {
  const Vec3 corner = grid_.cells[cell.brick].cast<double>();
  for (std::size_t i = 0; i < cell.spots.size(); ++i) {
    const int item = kSamples + int(i);
    const Vec3& position = cell.spots[i].position;
    const auto join = [&](int other) {
      if (sets.find(other) != sets.find(item) && sees(position, position_of(cell, other))) sets.merge(item, other);
    };
    for_each_near(position - corner, 1.5, [&](int other) {
      if (is_inside(cell, other)) join(other);
    });
    for (std::size_t j = 0; j < i; ++j) {
      if ((cell.spots[j].position - position).norm() < kSpotReach * kSamplePitch) join(kSamples + int(j));
    }
  }
}

}  // namespace sprung
