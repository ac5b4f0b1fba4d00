#include "core/bricks/pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "core/bricks/brick_grid.h"
#include "core/bricks/brick_topology.h"

namespace sprung {
namespace {

constexpr double kHalf = 0.5;  // a cell in which no line crosses the surface is full from this fill on, else empty

}  // namespace

PieceList::PieceList(const CellSurface& surface, const BrickGrid& grid) : grid_(grid), samples_(surface, grid) {
  for (int brick = 0; brick < grid_.brick_count(); ++brick) {
    first_.push_back(count());
    const double fill = grid_.fill[brick];
    const CutCell* cell = cut(brick);
    if (cell == nullptr || cell->weights.size() < 2) {
      pieces_.push_back({brick, fill});
      continue;
    }
    ++divided_;
    const double sum = std::accumulate(cell->weights.begin(), cell->weights.end(), 0.0);
    for (const float weight : cell->weights) pieces_.push_back({brick, fill * double(weight) / sum});
  }
  first_.push_back(count());
}

const CutCell* PieceList::cut(int brick) const {
  const int cell = samples_.cut_cell_of(brick);
  return cell < 0 ? nullptr : &samples_.cut_cells()[cell];
}

bool PieceList::is_whole(int brick) const { return cut(brick) == nullptr && grid_.fill[brick] >= kHalf; }

int PieceList::at(int brick, int sample) const {
  const CutCell* cell = cut(brick);
  if (cell == nullptr) return is_whole(brick) ? first(brick) : -1;
  const int number = cell->piece[sample];
  return number == 0 ? -1 : first(brick) + number - 1;
}

int PieceList::beside(int brick, const Eigen::Vector3i& offset) const {
  return samples_.brick_at(grid_.cells[brick] + offset);
}

SolidIntegrals PieceList::solid_of(int piece) const {
  const auto [brick, fill] = pieces_[piece];
  const CutCell* cell = cut(brick);
  if (cell == nullptr || cell->solid.empty()) return integrals_of(fill, {});
  return cell->solid[piece - first(brick)].best(fill);
}

std::vector<PieceItem> PieceList::items(int brick) const {
  std::vector<PieceItem> items;
  const CutCell* cell = cut(brick);
  const CutCell whole{.brick = brick, .spots = {}, .piece = {}, .weights = {}};
  const int samples = int(whole.lines.size() + (cell == nullptr ? 0 : cell->spots.size()));
  for (int sample = 0; sample < samples; ++sample) {
    const int piece = at(brick, sample);
    if (piece >= 0) items.push_back({samples_.position_of(cell == nullptr ? whole : *cell, sample), piece});
  }
  return items;
}

namespace {

constexpr double kFaceReach = 1.5;   // pitches: how near to a face links through it are searched ...
constexpr double kReach = 2.2;       // ... and how far apart linked items may be
constexpr double kUnknownGap = 0.5;  // cells, between two pieces of which one has no samples

/// Pieces of two sets that are neighbours: through a face across `axis`, or (-1) in the same cell.
struct PieceContact {
  int low;
  int high;
  int axis;
  double gap;  // cells
};

class Linker {
 public:
  explicit Linker(const PieceList& list)
      : list_(list),
        links_{DisjointSets(8 * list.pieces().size()), std::vector<int>(list.pieces().size()), 0},
        sets_(list.pieces().size()),
        faces_of_(list.pieces().size()) {
    std::iota(links_.same_brick.begin(), links_.same_brick.end(), 0);
  }

  PieceLinks run() {
    const int bricks = list_.grid().brick_count();
    for (int brick = 0; brick < bricks; ++brick) {
      for (int axis = 0; axis < 3; ++axis) join_across(brick, axis);
    }
    for (const SpotLink& link : list_.samples().spot_links()) {
      join(list_.at(link.low_brick, link.low_sample), list_.at(link.high_brick, link.high_sample), link.axis);
    }
    attach();
    for (int brick = 0; brick < bricks; ++brick) join_around_edges(brick);
    return std::move(links_);
  }

 private:
  [[nodiscard]] bool are_joined(int low, int high) const {
    const auto& faces = faces_of_[low];
    return std::find(faces.begin(), faces.end(), high) != faces.end();
  }

  void join(int low, int high, int axis) {
    if (low < 0 || high < 0 || are_joined(low, high)) return;
    faces_of_[low].push_back(high);
    sets_.merge(low, high);
    for (int corner = 0; corner < 8; ++corner) {
      if (!on_high_side(corner, axis)) links_.corners.merge(8 * low + corner + (1 << axis), 8 * high + corner);
    }
  }

  void join_across(int brick, int axis) {
    const int other = list_.beside(brick, Eigen::Vector3i::Unit(axis));
    if (other < 0) return;
    const bool low_whole = list_.is_whole(brick);
    const bool high_whole = list_.is_whole(other);
    if (low_whole && high_whole) return join(list_.first(brick), list_.first(other), axis);
    const CutCell* low = list_.cut(brick);
    const CutCell* high = list_.cut(other);
    if ((low == nullptr && !low_whole) || (high == nullptr && !high_whole)) return;
    const int stride = axis == 0 ? 1 : (axis == 1 ? kSamplesAlong : kSamplesAlong * kSamplesAlong);
    for (int sample = 0; sample < kSamplesAlong * kSamplesAlong * kSamplesAlong; ++sample) {
      if (sample / stride % kSamplesAlong != 0) continue;
      const int last = sample + (kSamplesAlong - 1) * stride;
      const bool goes_up = low == nullptr || (low->lines[last] >> (3 + axis) & 1) != 0;
      const bool goes_down = high == nullptr || (high->below[sample] >> axis & 1) != 0;
      if (goes_up && goes_down) join(list_.at(brick, last), list_.at(other, sample), axis);
    }
    join_by_sight(brick, other, axis);
  }

  /// Links pieces that no line joins.
  void join_by_sight(int brick, int other, int axis) {
    bool are_all_joined = true;
    for (int low = list_.first(brick); low < list_.first(brick + 1); ++low) {
      for (int high = list_.first(other); high < list_.first(other + 1); ++high) {
        are_all_joined = are_all_joined && are_joined(low, high);
      }
    }
    if (are_all_joined) return;
    const double face = list_.grid().cells[other][axis];
    const std::vector<PieceItem> low = items_near(brick, axis, face);
    const std::vector<PieceItem> high = items_near(other, axis, face);
    for (const PieceItem& a : low) {
      for (const PieceItem& b : high) {
        const bool is_far = (a.position - b.position).squaredNorm() > kReach * kReach * kSamplePitch * kSamplePitch;
        if (is_far || are_joined(a.piece, b.piece)) continue;
        if (list_.samples().sees(a.position, b.position)) join(a.piece, b.piece, axis);
      }
    }
  }

  /// Items near the face of a cell across `axis` at `face`.
  [[nodiscard]] std::vector<PieceItem> items_near(int brick, int axis, double face) const {
    std::vector<PieceItem> items = list_.items(brick);
    std::erase_if(items, [&](const PieceItem& item) {
      return std::abs(item.position[axis] - face) >= kFaceReach * kSamplePitch;
    });
    return items;
  }

  void attach() {
    std::vector<double> volume(list_.pieces().size(), 0);
    for (int piece = 0; piece < list_.count(); ++piece) {
      volume[sets_.find(piece)] += list_.pieces()[piece].fill;
    }
    const auto main = int(std::max_element(volume.begin(), volume.end()) - volume.begin());
    std::vector<PieceContact> contacts;
    for (int piece = 0; piece < list_.count(); ++piece) {
      if (sets_.find(piece) != main) list_piece_contacts(piece, contacts);
    }
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const PieceContact& a, const PieceContact& b) { return a.gap < b.gap; });
    for (const PieceContact& contact : contacts) {
      if (sets_.find(contact.low) == sets_.find(contact.high)) continue;
      ++links_.attached;
      if (contact.axis >= 0) {
        join(contact.low, contact.high, contact.axis);
      } else {
        unite(contact.low, contact.high);
      }
    }
  }

  void list_piece_contacts(int piece, std::vector<PieceContact>& contacts) {
    const int brick = list_.brick_of(piece);
    const auto add = [&](int other_brick, int axis, bool is_above) {
      for (int other = list_.first(other_brick); other < list_.first(other_brick + 1); ++other) {
        if (sets_.find(other) == sets_.find(piece)) continue;
        const double gap = gap_between(piece, other);
        contacts.push_back(is_above ? PieceContact{piece, other, axis, gap} : PieceContact{other, piece, axis, gap});
      }
    };
    add(brick, -1, true);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        const int other = list_.beside(brick, step * Eigen::Vector3i::Unit(axis));
        if (other >= 0) add(other, axis, step > 0);
      }
    }
  }

  [[nodiscard]] std::vector<Vec3> places_of(int piece) const {
    std::vector<Vec3> places;
    const int brick = list_.brick_of(piece);
    for (const PieceItem& item : list_.items(brick)) {
      if (item.piece == piece) places.push_back(item.position);
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

  /// Merges two pieces of a cell into one brick.
  void unite(int a, int b) {
    sets_.merge(a, b);
    std::vector<int>& same = links_.same_brick;
    const int from = std::max(same[a], same[b]);
    const int to = std::min(same[a], same[b]);
    const int brick = list_.brick_of(a);
    std::replace(same.begin() + list_.first(brick), same.begin() + list_.first(brick + 1), from, to);
    for (int corner = 0; corner < 8; ++corner) links_.corners.merge(8 * a + corner, 8 * b + corner);
  }

  /// With the bricks beyond the edges and corners on one side.
  void join_around_edges(int brick) {
    for (int z = 0; z <= 1; ++z) {
      for (int y = z == 0 ? 0 : -1; y <= 1; ++y) {
        for (int x = z == 0 && y == 0 ? 1 : -1; x <= 1; ++x) {
          const Eigen::Vector3i offset(x, y, z);
          if (offset.squaredNorm() < 2) continue;
          const int other = list_.beside(brick, offset);
          if (other < 0) continue;
          for (int a = list_.first(brick); a < list_.first(brick + 1); ++a) {
            for (int b = list_.first(other); b < list_.first(other + 1); ++b) join_around(a, b, offset);
          }
        }
      }
    }
  }

  void join_around(int a, int b, const Eigen::Vector3i& offset) {
    std::vector<std::pair<int, int>> shared;
    for (int corner = 0; corner < 8; ++corner) {
      int across = corner;
      bool is_shared = true;
      for (int axis = 0; axis < 3; ++axis) {
        if (offset[axis] == 0) continue;
        is_shared = is_shared && on_high_side(corner, axis) == (offset[axis] > 0);
        across ^= 1 << axis;
      }
      if (is_shared) shared.emplace_back(8 * a + corner, 8 * b + across);
    }
    const auto is_one = [&](const auto& pair) {
      return links_.corners.find(pair.first) == links_.corners.find(pair.second);
    };
    if (std::all_of(shared.begin(), shared.end(), is_one) || !see_each_other(a, b, offset)) return;
    for (const auto& [one, other] : shared) links_.corners.merge(one, other);
  }

  /// The items nearest to the edge or corner between two pieces.
  [[nodiscard]] bool see_each_other(int a, int b, const Eigen::Vector3i& offset) const {
    const Vec3 middle =
        list_.grid().cells[list_.brick_of(a)].cast<double>() + Vec3::Constant(0.5) + offset.cast<double>() / 2;
    const auto nearest = [&](int piece, const Vec3& to) {
      const std::vector<Vec3> places = places_of(piece);
      const auto found = std::min_element(places.begin(), places.end(), [&](const Vec3& p, const Vec3& q) {
        return (p - to).squaredNorm() < (q - to).squaredNorm();
      });
      return found == places.end() ? Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN())) : *found;
    };
    const Vec3 from = nearest(a, middle);
    if (!from.allFinite()) return false;
    const Vec3 to = nearest(b, from);
    return to.allFinite() && list_.samples().sees(from, to);
  }

  const PieceList& list_;
  PieceLinks links_;
  DisjointSets sets_;                       // of pieces
  std::vector<std::vector<int>> faces_of_;  // by piece: those joined on its high sides
};

}  // namespace

PieceLinks link_pieces(const PieceList& list) { return Linker(list).run(); }

namespace {

/// Records the solid of each piece, used to assign points to bricks.
SolidPatch patch_of(const PieceList& list, int piece, int row) {
  const int brick = list.brick_of(piece);
  const CutCell& cell = *list.cut(brick);
  const Eigen::Vector3i& at = list.grid().cells[brick];
  SolidPatch patch{.cell = at, .brick = row, .samples = {}, .spots = {}, .solid = list.solid_of(piece)};
  for (std::size_t sample = 0; sample < cell.piece.size(); ++sample) {
    if (list.at(brick, int(sample)) != piece) continue;
    if (sample < patch.samples.size()) {
      patch.samples.set(sample);
    } else {
      const Vec3 position = list.samples().position_of(cell, int(sample));
      patch.spots.emplace_back((position - at.cast<double>()).cast<float>());
    }
  }
  return patch;
}

/// Specks without samples.
bool is_unseen(const PieceList& list, int brick) {
  const CutCell* cell = list.cut(brick);
  return cell == nullptr ? !list.is_whole(brick) : cell->weights.empty();
}

/// A brick for each piece; `unseen` by brick.
BrickGrid rebuilt(const PieceList& list, PieceLinks& links, std::vector<bool>& unseen) {
  BrickGrid grid;
  grid.origin = list.grid().origin;
  grid.brick_size = list.grid().brick_size;
  std::vector<int> row(list.pieces().size(), -1);
  for (int piece = 0; piece < list.count(); ++piece) {
    const auto [brick, fill] = list.pieces()[piece];
    int& first = row[links.same_brick[piece]];
    if (first < 0) {
      first = grid.brick_count();
      grid.cells.push_back(list.grid().cells[brick]);
      grid.fill.push_back(0);
      unseen.push_back(is_unseen(list, brick));
    }
    row[piece] = first;
    grid.fill[first] += fill;
    if (list.cut(brick) != nullptr) grid.patches.push_back(patch_of(list, piece, first));
  }
  DisjointSets corners(8 * grid.cells.size());
  const auto of_brick = [&](int corner) { return 8 * row[corner / 8] + corner % 8; };
  for (int corner = 0; corner < 8 * list.count(); ++corner) {
    corners.merge(of_brick(corner), of_brick(links.corners.find(corner)));
  }
  number_nodes(grid, corners);
  return grid;
}

/// Adds the solid of unseen bricks to their fullest neighbour, since their connectivity is unknown.
void give_away(const std::vector<bool>& unseen, BrickGrid& grid) {
  const CellIndex index(grid);
  std::vector<bool> gone(grid.cells.size(), false);
  std::vector<int> heir(grid.cells.size(), -1);
  const std::vector<double> fill = grid.fill;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (!unseen[i]) continue;
    for (const int other : face_neighbours(grid, index, i)) {
      const std::size_t row = other;
      if (other < 0 || unseen[row]) continue;
      if (heir[i] < 0 || fill[row] > fill[heir[i]]) heir[i] = other;
    }
    if (heir[i] < 0) continue;
    gone[i] = true;
    grid.fill[heir[i]] += fill[i];
  }
  remove_bricks(grid, gone, heir);
}

/// Disconnected components, by size.
void drop_specks(BrickGrid& grid, PieceReport& report) {
  DisjointSets sets(grid.lattice.size());
  for (const auto& nodes : grid.nodes) {
    for (const int node : nodes) sets.merge(nodes[0], node);
  }
  std::vector<double> volume(grid.lattice.size(), 0);
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    volume[sets.find(grid.nodes[i][0])] += grid.fill[i];
  }
  const double sum = std::accumulate(grid.fill.begin(), grid.fill.end(), 0.0);
  std::vector<bool> gone(grid.cells.size(), false);
  double lost = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (volume[sets.find(grid.nodes[i][0])] >= kSpeckShare * sum) continue;
    gone[i] = true;
    ++report.dropped;
    lost += grid.fill[i];
  }
  report.floating =
      int(std::count_if(volume.begin(), volume.end(), [&](double v) { return v >= kSpeckShare * sum; })) - 1;
  if (report.dropped == 0) return;
  report.dropped_volume = lost * grid.brick_volume();
  std::erase_if(grid.patches, [&](const SolidPatch& patch) { return gone[patch.brick]; });
  remove_bricks(grid, gone, std::vector<int>(gone.size(), 0));
  double cut = 0;
  for (const double fill : grid.fill) cut += fill < 1 ? fill : 0;
  const bool is_by_cut_ones = cut > lost;  // full bricks stay full where those that the surface cuts can take it
  const double factor = 1 + lost / (is_by_cut_ones ? cut : sum - lost);
  for (double& fill : grid.fill) {
    if (fill < 1 || !is_by_cut_ones) fill *= factor;
  }
}

Eigen::Vector3i counts_of(const BrickGrid& grid) {
  Eigen::Vector3i counts = Eigen::Vector3i::Ones();
  for (const Eigen::Vector3i& cell : grid.cells) counts = counts.cwiseMax(cell + Eigen::Vector3i::Ones());
  return counts;
}

}  // namespace

PieceReport split_pieces(const Solid& solid, BrickGrid& grid) {
  // Samples along lines need a surface that the lines enter as often as they leave it.
  if (grid.cells.empty() || !solid.closed || solid.thickness > 0) return {};
  const Eigen::Vector3i counts = counts_of(grid);
  Points points = (solid.points.rowwise() - grid.origin.transpose()) / grid.brick_size;
  for (int axis = 0; axis < 3; ++axis) points.col(axis) = points.col(axis).cwiseMax(0.0).cwiseMin(counts[axis]);
  const CellSurface surface{std::move(points), solid.triangles, counts};
  const PieceList list(surface, grid);
  PieceLinks links = link_pieces(list);
  PieceReport report{.divided = list.divided(), .attached = links.attached};
  std::vector<bool> unseen;
  grid = rebuilt(list, links, unseen);
  give_away(unseen, grid);
  drop_specks(grid, report);
  return report;
}

}  // namespace sprung
