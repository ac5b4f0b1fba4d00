#include "core/bricks/pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/bricks/solid_samples.h"
#include "core/disjoint_sets.h"

namespace sprung {
namespace {

constexpr int kSamples = 512;
constexpr double kPitch = 1.0 / kSamplesAlong;
constexpr double kFaceReach = 1.5;  // pitches: how near to a face what hangs together through it is looked for ...
constexpr double kReach = 2.2;      // ... and how far it may lie apart
constexpr double kHalf = 0.5;       // a cell that no line crosses the surface in is whole from this fill on, else empty
constexpr double kUnknownGap = 0.5;  // cells, between pieces of which one has no samples

/// One piece of the solid in one cell.
struct Piece {
  int brick;   // of the grid given
  int number;  // in its cell, from 1
  double fill;
};

/// A sample or spot, or a place in a cell that is whole.
struct Item {
  Vec3 place;
  int piece;
};

class Splitter {
 public:
  Splitter(const CellSurface& surface, BrickGrid& grid) : grid_(grid), samples_(surface, grid) {}

  PieceReport run() {
    list_pieces();
    for (int brick = 0; brick < grid_.brick_count(); ++brick) {
      for (int axis = 0; axis < 3; ++axis) join_across(brick, axis);
    }
    for (const SpotLink& link : samples_.spot_links()) {
      join(piece_of(link.low_brick, link.low_sample), piece_of(link.high_brick, link.high_sample), link.axis);
    }
    attach();
    rebuild();
    drop_specks();
    return report_;
  }

 private:
  [[nodiscard]] const CutCell* cut(int brick) const {
    const int cell = samples_.cut_cell_of(brick);
    return cell < 0 ? nullptr : &samples_.cut_cells()[static_cast<std::size_t>(cell)];
  }

  [[nodiscard]] bool is_whole(int brick) const {
    return cut(brick) == nullptr && grid_.fill[static_cast<std::size_t>(brick)] >= kHalf;
  }

  [[nodiscard]] int first_piece(int brick) const { return first_piece_[static_cast<std::size_t>(brick)]; }
  [[nodiscard]] int piece_count(int brick) const { return first_piece(brick + 1) - first_piece(brick); }

  /// -1: outside, or too little.
  [[nodiscard]] int piece_of(int brick, int sample) const {
    const CutCell* cell = cut(brick);
    if (cell == nullptr) return is_whole(brick) ? first_piece(brick) : -1;
    const int number = cell->piece[static_cast<std::size_t>(sample)];
    return number == 0 ? -1 : first_piece(brick) + number - 1;
  }

  void list_pieces() {
    for (int brick = 0; brick < grid_.brick_count(); ++brick) {
      first_piece_.push_back(static_cast<int>(pieces_.size()));
      const double fill = grid_.fill[static_cast<std::size_t>(brick)];
      const CutCell* cell = cut(brick);
      if (cell == nullptr || cell->weights.size() < 2) {
        pieces_.push_back({brick, 1, fill});
        continue;
      }
      ++report_.divided;
      const double sum = std::accumulate(cell->weights.begin(), cell->weights.end(), 0.0);
      for (std::size_t k = 0; k < cell->weights.size(); ++k) {
        pieces_.push_back({brick, static_cast<int>(k) + 1, fill * static_cast<double>(cell->weights[k]) / sum});
      }
    }
    first_piece_.push_back(static_cast<int>(pieces_.size()));
    faces_of_.resize(pieces_.size());
  }

  [[nodiscard]] int neighbour(int brick, int axis, int step) const {
    Eigen::Vector3i cell = grid_.cells[static_cast<std::size_t>(brick)];
    cell[axis] += step;
    return samples_.brick_at(cell);
  }

  [[nodiscard]] bool are_joined(int low, int high) const {
    const auto& faces = faces_of_[static_cast<std::size_t>(low)];
    return std::find(faces.begin(), faces.end(), high) != faces.end();
  }

  void join(int low, int high, int axis) {
    if (low < 0 || high < 0 || are_joined(low, high)) return;
    faces_of_[static_cast<std::size_t>(low)].push_back(high);
    faces_.push_back({.low = low, .high = high, .axis = axis});
  }

  void join_across(int brick, int axis) {
    const int other = neighbour(brick, axis, 1);
    if (other < 0) return;
    const bool low_whole = is_whole(brick);
    const bool high_whole = is_whole(other);
    if (low_whole && high_whole) return join(first_piece(brick), first_piece(other), axis);
    const CutCell* low = cut(brick);
    const CutCell* high = cut(other);
    if ((low == nullptr && !low_whole) || (high == nullptr && !high_whole)) return;
    const int stride = axis == 0 ? 1 : (axis == 1 ? kSamplesAlong : kSamplesAlong * kSamplesAlong);
    for (int sample = 0; sample < kSamples; ++sample) {
      if (sample / stride % kSamplesAlong != 0) continue;
      const int last = sample + (kSamplesAlong - 1) * stride;
      const bool goes_up = low == nullptr || (low->lines[static_cast<std::size_t>(last)] >> (3 + axis) & 1) != 0;
      const bool goes_down = high == nullptr || (high->below[static_cast<std::size_t>(sample)] >> axis & 1) != 0;
      if (goes_up && goes_down) join(piece_of(brick, last), piece_of(other, sample), axis);
    }
    join_by_sight(brick, other, axis);
  }

  /// Of pieces that no line joins.
  void join_by_sight(int brick, int other, int axis) {
    bool are_all_joined = true;
    for (int low = first_piece(brick); low < first_piece(brick + 1); ++low) {
      for (int high = first_piece(other); high < first_piece(other + 1); ++high) {
        are_all_joined = are_all_joined && are_joined(low, high);
      }
    }
    if (are_all_joined) return;
    const double face = grid_.cells[static_cast<std::size_t>(other)][axis];
    const std::vector<Item> low = items_near(brick, axis, face);
    const std::vector<Item> high = items_near(other, axis, face);
    for (const Item& a : low) {
      for (const Item& b : high) {
        if ((a.place - b.place).squaredNorm() > kReach * kReach * kPitch * kPitch || are_joined(a.piece, b.piece)) {
          continue;
        }
        if (samples_.sees(a.place, b.place)) join(a.piece, b.piece, axis);
      }
    }
  }

  /// Near the face of a cell that lies across `axis` at `face`.
  [[nodiscard]] std::vector<Item> items_near(int brick, int axis, double face) const {
    std::vector<Item> items;
    const CutCell* cell = cut(brick);
    const CutCell whole{.brick = brick, .spots = {}, .piece = {}, .weights = {}};
    const int count = kSamples + (cell == nullptr ? 0 : static_cast<int>(cell->spots.size()));
    for (int sample = 0; sample < count; ++sample) {
      const int piece = piece_of(brick, sample);
      if (piece < 0) continue;
      const Vec3 place = samples_.place_of(cell == nullptr ? whole : *cell, sample);
      if (std::abs(place[axis] - face) < kFaceReach * kPitch) items.push_back({place, piece});
    }
    return items;
  }

  /// A solid is one piece; where the samples lose a thin link, the nearest neighbours are it.
  void attach() {
    DisjointSets sets(pieces_.size());
    for (const SharedFace& face : faces_) sets.merge(face.low, face.high);
    std::vector<double> volume(pieces_.size(), 0);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      volume[static_cast<std::size_t>(sets.find(static_cast<int>(i)))] += pieces_[i].fill;
    }
    const auto main = static_cast<int>(std::max_element(volume.begin(), volume.end()) - volume.begin());
    std::vector<Contact> contacts;
    for (int piece = 0; piece < static_cast<int>(pieces_.size()); ++piece) {
      if (sets.find(piece) != main) list_contacts(piece, sets, contacts);
    }
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const Contact& a, const Contact& b) { return a.gap < b.gap; });
    same_brick_.resize(pieces_.size());
    std::iota(same_brick_.begin(), same_brick_.end(), 0);
    for (const Contact& contact : contacts) {
      if (sets.find(contact.low) == sets.find(contact.high)) continue;
      sets.merge(contact.low, contact.high);
      ++report_.attached;
      if (contact.axis >= 0) {
        join(contact.low, contact.high, contact.axis);
      } else {
        unite(contact.low, contact.high);
      }
    }
  }

  /// Pieces of two sets that are neighbours: through a face across `axis`, or (-1) in the same cell.
  struct Contact {
    int low;
    int high;
    int axis;
    double gap;  // cells
  };

  void list_contacts(int piece, DisjointSets& sets, std::vector<Contact>& contacts) const {
    const int brick = pieces_[static_cast<std::size_t>(piece)].brick;
    const auto add = [&](int other_brick, int axis, bool is_above) {
      for (int other = first_piece(other_brick); other < first_piece(other_brick + 1); ++other) {
        if (sets.find(other) == sets.find(piece)) continue;
        const double gap = gap_between(piece, other);
        contacts.push_back(is_above ? Contact{piece, other, axis, gap} : Contact{other, piece, axis, gap});
      }
    };
    add(brick, -1, true);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        if (const int other = neighbour(brick, axis, step); other >= 0) add(other, axis, step > 0);
      }
    }
  }

  [[nodiscard]] std::vector<Vec3> places_of(int piece) const {
    std::vector<Vec3> places;
    const int brick = pieces_[static_cast<std::size_t>(piece)].brick;
    const CutCell* cell = cut(brick);
    if (cell == nullptr) return places;
    for (int sample = 0; sample < static_cast<int>(cell->piece.size()); ++sample) {
      if (piece_of(brick, sample) == piece) places.push_back(samples_.place_of(*cell, sample));
    }
    return places;
  }

  [[nodiscard]] double gap_between(int a, int b) const {
    double gap = std::numeric_limits<double>::infinity();
    const std::vector<Vec3> places = places_of(b);
    for (const Vec3& from : places_of(a)) {
      for (const Vec3& to : places) gap = std::min(gap, (from - to).norm());
    }
    return std::isfinite(gap) ? gap : kUnknownGap;
  }

  /// Two pieces of a cell become one brick.
  void unite(int a, int b) {
    const int from = same_brick_[static_cast<std::size_t>(std::max(a, b))];
    const int to = same_brick_[static_cast<std::size_t>(std::min(a, b))];
    std::replace(same_brick_.begin() + first_piece(pieces_[static_cast<std::size_t>(a)].brick),
                 same_brick_.begin() + first_piece(pieces_[static_cast<std::size_t>(a)].brick + 1), from, to);
  }

  /// The grid anew, a brick for each piece.
  void rebuild() {
    std::vector<int> row(pieces_.size(), -1);
    std::vector<Eigen::Vector3i> cells;
    std::vector<double> fill;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const auto same = static_cast<std::size_t>(same_brick_[i]);
      if (row[same] < 0) {
        row[same] = static_cast<int>(cells.size());
        cells.push_back(grid_.cells[static_cast<std::size_t>(pieces_[i].brick)]);
        fill.push_back(0);
      }
      row[i] = row[same];
      fill[static_cast<std::size_t>(row[i])] += pieces_[i].fill;
      add_patch(static_cast<int>(i), row[i]);
    }
    grid_.cells = std::move(cells);
    grid_.fill = std::move(fill);
    for (SharedFace& face : faces_) {
      face.low = row[static_cast<std::size_t>(face.low)];
      face.high = row[static_cast<std::size_t>(face.high)];
    }
    number_nodes(grid_, faces_);
  }

  void add_patch(int piece, int row) {
    const int brick = pieces_[static_cast<std::size_t>(piece)].brick;
    const CutCell* cell = cut(brick);
    if (cell == nullptr) return;
    const Eigen::Vector3i& at = grid_.cells[static_cast<std::size_t>(brick)];
    SolidPatch patch{.cell = at, .brick = row, .samples = {}, .spots = {}};
    for (int sample = 0; sample < static_cast<int>(cell->piece.size()); ++sample) {
      if (piece_of(brick, sample) != piece) continue;
      if (sample < kSamples) {
        patch.samples.set(static_cast<std::size_t>(sample));
      } else {
        patch.spots.emplace_back((samples_.place_of(*cell, sample) - at.cast<double>()).cast<float>());
      }
    }
    grid_.patches.push_back(std::move(patch));
  }

  /// What hangs together with nothing, by its size.
  void drop_specks() {
    DisjointSets sets(grid_.lattice.size());
    for (const auto& nodes : grid_.nodes) {
      for (const int node : nodes) sets.merge(nodes[0], node);
    }
    std::vector<double> volume(grid_.lattice.size(), 0);
    for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
      volume[static_cast<std::size_t>(sets.find(grid_.nodes[i][0]))] += grid_.fill[i];
    }
    const double sum = std::accumulate(grid_.fill.begin(), grid_.fill.end(), 0.0);
    std::vector<bool> gone(grid_.cells.size(), false);
    double lost = 0;
    for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
      if (volume[static_cast<std::size_t>(sets.find(grid_.nodes[i][0]))] >= kSpeckShare * sum) continue;
      gone[i] = true;
      ++report_.dropped;
      lost += grid_.fill[i];
    }
    report_.floating = static_cast<int>(std::count_if(volume.begin(), volume.end(),
                                                      [&](double v) { return v >= kSpeckShare * sum; })) -
                       1;
    if (report_.dropped == 0) return;
    report_.dropped_volume = lost * grid_.brick_volume();
    std::erase_if(grid_.patches, [&](const SolidPatch& patch) { return gone[static_cast<std::size_t>(patch.brick)]; });
    remove_bricks(grid_, gone, std::vector<int>(gone.size(), 0));
    for (double& fill : grid_.fill) fill *= sum / (sum - lost);
  }

  BrickGrid& grid_;
  SolidSamples samples_;
  std::vector<Piece> pieces_;
  std::vector<int> first_piece_;            // by brick of the grid given
  std::vector<SharedFace> faces_;           // between pieces
  std::vector<std::vector<int>> faces_of_;  // by piece: those joined on its high sides
  std::vector<int> same_brick_;             // by piece: the first one of its brick
  PieceReport report_;
};

/// The box of cells and the solid's points in it.
Eigen::Vector3i counts_of(const BrickGrid& grid) {
  Eigen::Vector3i counts = Eigen::Vector3i::Ones();
  for (const Eigen::Vector3i& cell : grid.cells) counts = counts.cwiseMax(cell + Eigen::Vector3i::Ones());
  return counts;
}

}  // namespace

PieceReport split_pieces(const Solid& solid, BrickGrid& grid) {
  // What follows lines through the solid needs a surface that they enter as often as they leave it.
  if (grid.cells.empty() || !solid.closed || solid.thickness > 0) return {};
  const Eigen::Vector3i counts = counts_of(grid);
  Points points = (solid.points.rowwise() - grid.origin.transpose()) / grid.brick_size;
  for (int axis = 0; axis < 3; ++axis) points.col(axis) = points.col(axis).cwiseMax(0.0).cwiseMin(counts[axis]);
  return Splitter(CellSurface{std::move(points), solid.triangles, counts}, grid).run();
}

}  // namespace sprung
