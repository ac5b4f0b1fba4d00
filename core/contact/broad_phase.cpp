#include "core/contact/broad_phase.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "core/body/forces.h"
#include "core/contact/contact_candidates.h"
#include "core/disjoint_sets.h"

namespace sprung {
namespace {

constexpr double kMaxCells = 2e6;  // along an axis, so that a cell's number fits

struct Entry {
  std::int64_t cell;
  int box;
};

/// Cells of the middles of boxes, numbered along x first; a free one lies beyond each row and each layer.
class Cells {
 public:
  explicit Cells(const std::vector<AlignedBox>& boxes) {
    AlignedBox all;
    Vec3 largest = Vec3::Zero();
    for (const AlignedBox& box : boxes) {
      if (!is_finite(box)) continue;
      all.extend(box.center());
      largest = largest.cwiseMax(box.sizes());
    }
    if (all.isEmpty()) return;
    low_ = all.min();
    side_ = std::max({largest.maxCoeff(), all.sizes().maxCoeff() / kMaxCells, 1e-300});
    const Eigen::Array3d counts = (all.sizes() / side_).array().floor() + 3;
    row_ = static_cast<std::int64_t>(counts.x());
    layer_ = row_ * static_cast<std::int64_t>(counts.y());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (!is_finite(boxes[i])) continue;
      const Eigen::Array3d place = ((boxes[i].center() - low_) / side_).array().floor();
      entries_.push_back({static_cast<std::int64_t>(place.x()) + row_ * static_cast<std::int64_t>(place.y()) +
                              layer_ * static_cast<std::int64_t>(place.z()),
                          int(i)});
    }
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.cell != b.cell ? a.cell < b.cell : a.box < b.box; });
  }

  /// Each pair of boxes in one or two touching cells, once.
  template <class Visit>
  void each_pair(const Visit& visit) const {
    // The cell itself and the one after it; then three rows ahead, each three cells long. Their starts only go up.
    const std::array<std::int64_t, 4> rows{row_ - 1, layer_ - row_ - 1, layer_ - 1, layer_ + row_ - 1};
    std::array<std::size_t, 4> starts{};
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const std::int64_t cell = entries_[i].cell;
      for (std::size_t j = i + 1; j < entries_.size() && entries_[j].cell <= cell + 1; ++j) {
        visit(entries_[i].box, entries_[j].box);
      }
      for (std::size_t row = 0; row < rows.size(); ++row) {
        std::size_t& start = starts[row];
        while (start < entries_.size() && entries_[start].cell < cell + rows[row]) ++start;
        for (std::size_t j = start; j < entries_.size() && entries_[j].cell <= cell + rows[row] + 2; ++j) {
          visit(entries_[i].box, entries_[j].box);
        }
      }
    }
  }

 private:
  static bool is_finite(const AlignedBox& box) { return box.min().allFinite() && box.max().allFinite(); }

  Vec3 low_ = Vec3::Zero();
  double side_ = 1;
  std::int64_t row_ = 3;
  std::int64_t layer_ = 9;
  std::vector<Entry> entries_;
};

}  // namespace

AlignedBox widened(const AlignedBox& box, double by) {
  return {box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by)};
}

std::vector<std::pair<int, int>> overlapping_boxes(const std::vector<AlignedBox>& boxes,
                                                   const std::function<bool(int, int)>& is_kept) {
  std::vector<std::pair<int, int>> pairs;
  Cells(boxes).each_pair([&](int a, int b) {
    if (!boxes[a].intersects(boxes[b])) return;
    const std::pair<int, int> pair = std::minmax(a, b);
    if (is_kept(pair.first, pair.second)) pairs.push_back(pair);
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

namespace {

constexpr double kFurthestMove = 0.5;  // of a brick

/// s, until something with this speed and accelerated by gravity has moved that far.
double time_to_move(double way, double speed, double gravity, double most) {
  if (speed * most + gravity * most * most / 2 <= way) return most;
  return 2 * way / (speed + std::sqrt(speed * speed + 2 * gravity * way));
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> broad_phase(const World& world, const Group& group, double margin) {
  std::vector<AlignedBox> boxes;
  std::vector<std::pair<std::size_t, std::size_t>> near;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Body& body = *group[i];
    boxes.push_back(
        widened(bounding_box(body.positions), margin + body.grid.brick_size));  // skins may lie outside bricks
    if (group[i]->contact.with_itself) near.emplace_back(i, i);
  }
  if (world.bodies_collide) {
    for (const auto& [a, b] : overlapping_boxes(boxes)) near.emplace_back(a, b);
  }
  return near;
}

double max_step_size(const World& world, const Group& group, double dt) {
  std::vector<const ContactSurface*> skins;
  for (SoftBody* body : group) skins.push_back(&contact_surface_of(*body));
  double fastest = 0;
  for (const SoftBody* body : group) fastest = std::max(fastest, body->velocities.rowwise().norm().maxCoeff());
  double stride = dt;
  for (const auto& [a, b] : broad_phase(world, group, 2 * (fastest + world.gravity.norm() * dt) * dt)) {
    ContactCandidates pairs(skins, a, b);
    const double brick = std::min(group[a]->grid.brick_size, group[b]->grid.brick_size);
    const double gravity = a == b ? 0 : world.gravity.norm();  // all of a body falls equally
    // Two approaching each other are twice as fast.
    pairs.seek(group, brick + 2 * pairs.fastest(group) * dt + gravity * dt * dt / 2);
    if (!pairs.has_near_bricks()) continue;
    stride = std::min(stride, time_to_move(kFurthestMove * brick, pairs.closing_speed(group, dt), gravity, dt));
  }
  return stride;
}

namespace {

/// The region that a body can reach, m: it moves as a whole, and its nodes move relative to it.
AlignedBox reach_of(const Body& body, const Vec3& gravity, double time) {
  const Vec3 mean = linear_momentum(body) / body.masses.sum();
  const double about = std::sqrt((body.velocities.rowwise() - mean.transpose()).rowwise().squaredNorm().maxCoeff());
  const Vec3 low = body.positions.colwise().minCoeff();
  const Vec3 high = body.positions.colwise().maxCoeff();
  AlignedBox reach(low, high);
  for (const Vec3& way : {Vec3(mean * time), Vec3((mean + gravity * time) * time)}) {
    reach.extend(low + way);
    reach.extend(high + way);
  }
  const Vec3 around = Vec3::Constant(about * time + body.grid.brick_size / 2);
  return {reach.min() - around, reach.max() + around};
}

}  // namespace

std::vector<std::vector<std::size_t>> contact_groups(const World& world, double time) {
  const auto count = world.bodies.size();
  DisjointSets sets(count);
  if (world.bodies_collide && count > 1) {
    std::vector<AlignedBox> boxes;
    for (const SoftBody& body : world.bodies) boxes.push_back(reach_of(body, world.gravity, time));
    for (const auto& [a, b] : overlapping_boxes(boxes)) sets.merge(a, b);
  }
  for (const GluedPoint& point : world.glue) {
    sets.merge(int(point.bodies[0]), int(point.bodies[1]));
  }
  std::map<int, std::vector<std::size_t>> members;  // by the lowest
  for (std::size_t i = 0; i < count; ++i) members[sets.find(int(i))].push_back(i);
  std::vector<std::vector<std::size_t>> groups;
  groups.reserve(members.size());
  for (auto& [first, group] : members) groups.push_back(std::move(group));
  return groups;
}

}  // namespace sprung
