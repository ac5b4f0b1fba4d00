#include "core/contact/search/contact_front.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr std::size_t kGrown = 2;  // times, plus a constant: a front that has grown this much is rebuilt
constexpr std::size_t kGrownBy = 500;
constexpr double kFar = 0.5;     // bricks: pairs of subtrees that are further apart stay whole
constexpr double kTurned = 0.4;  // bricks that parts of bricks move, at least, as these turn by a radian
}  // namespace

ContactFront::ContactFront(SurfaceTree& a, SurfaceTree& b, double margin, NearLists& lists)
    : a_(a),
      b_(b),
      margin_(margin),
      lists_(lists),
      brick_(std::min(a.body().grid.brick_size, b.body().grid.brick_size)) {}

double ContactFront::turn_until_facing(int a, int b) {
  const NormalCone& one = a_.cone(a);
  const NormalCone& other = b_.cone(b);
  const double rest = std::acos(kFacing) - one.spread - other.spread;
  if (rest <= kBent) return 0;
  return rest - std::acos(std::clamp(one.axis.dot(other.axis), -1.0, 1.0));
}

double ContactFront::moved_closer(int a, int b) const {
  if (is_self()) return reach_between(a_.own_motion(a).moved, a_.own_motion(b).moved);
  return reach_between(a_.motion(a).moved, b_.motion(b).moved);
}

double ContactFront::moving_closer(int a, int b) const {
  if (is_self()) return reach_between(a_.own_motion(a).moving, a_.own_motion(b).moving);
  return reach_between(a_.motion(a).moving, b_.motion(b).moving);
}

bool ContactFront::advance() {
  has_changed_ = false;
  if (size_ > kGrown * size_when_new_ + kGrownBy) {
    blocks_.clear();
    known_blocks_.clear();
    lists_.clear();
    list_count_ = 0;
    free_lists_.clear();
    size_ = 0;
    has_changed_ = true;
  }
  if (blocks_.empty()) {
    if (!a_.nodes().empty() && !b_.nodes().empty()) look(0, 0, -1);
    size_when_new_ = size_;
    return has_changed_;
  }
  due_.clear();
  for (Block& block : blocks_) {
    if (block.heap.empty()) continue;
    block.closer += moved_closer(block.a, block.b);
    const double soon = block.closer + moving_closer(block.a, block.b);
    while (!block.heap.empty() && block.heap.front().wake <= soon) {
      due_.push_back(block.heap.front());
      std::pop_heap(block.heap.begin(), block.heap.end());
      block.heap.pop_back();
      --size_;
    }
  }
  for (const Pair& pair : due_) look(pair.a, pair.b, pair.list);
  return has_changed_;
}

std::size_t ContactFront::block_of(int a, int b) {
  const int cluster_a = a_.cluster_node(a);
  const int cluster_b = b_.cluster_node(b);
  const std::uint64_t key = std::uint64_t(cluster_a) << 32 | std::uint64_t(cluster_b);
  const auto [known, is_new] = known_blocks_.try_emplace(key, blocks_.size());
  if (is_new) blocks_.push_back({.a = cluster_a, .b = cluster_b});
  return known->second;
}

void ContactFront::keep(int a, int b, double budget, int list) {
  Block& block = blocks_[block_of(a, b)];
  block.heap.push_back({block.closer + budget, a, b, list});
  std::push_heap(block.heap.begin(), block.heap.end());
  ++size_;
}

void ContactFront::look(int a, int b, int list) {
  const SurfaceTree::Node& one = a_.nodes()[a];
  const SurfaceTree::Node& other = b_.nodes()[b];
  const auto drop_list = [&] {
    if (list < 0) return;
    const bool changed = lists_.clear(list);
    has_changed_ = has_changed_ || changed;
    free_lists_.push_back(list);
  };
  if (is_self() && one.is_leaf() && other.is_leaf()) {
    const std::vector<int>& connected = a_.skin().connected[a_.brick_of(one)];
    if (std::binary_search(connected.begin(), connected.end(), b_.brick_of(other))) return;
  }
  if (is_self() && a == b) return split(a, b);
  const double distance = a_.box(a).exteriorDistance(b_.box(b));
  const bool are_leaves = one.is_leaf() && other.is_leaf();
  // Pairs that may be needed in this step count as near.
  const double needed = moving_closer(a, b);
  if (distance > std::max((are_leaves ? margin_ : kFar * brick_), needed)) {
    drop_list();
    return keep(a, b, distance, -1);
  }
  if (const double turn = turn_until_facing(a, b); is_self() && turn > kBent) {
    drop_list();
    return keep(a, b, std::max(kTurned * turn * brick_, distance), -1);
  }
  if (!are_leaves) return split(a, b);
  fill_list(a, b, std::max(margin_, needed), list);
}

void ContactFront::split(int a, int b) {
  const SurfaceTree::Node& one = a_.nodes()[a];
  const SurfaceTree::Node& other = b_.nodes()[b];
  if (is_self() && a == b) {
    if (one.is_leaf()) return;
    look(a + 1, a + 1, -1);
    look(one.second_child, one.second_child, -1);
    look(a + 1, one.second_child, -1);
  } else if (other.is_leaf() || (!one.is_leaf() && one.last - one.first >= other.last - other.first)) {
    look(a + 1, b, -1);
    look(one.second_child, b, -1);
  } else {
    look(a, b + 1, -1);
    look(a, other.second_child, -1);
  }
}

void ContactFront::fill_list(int a, int b, double margin, int list) {
  if (list < 0) {
    if (free_lists_.empty()) free_lists_.push_back(list_count_++);
    list = free_lists_.back();
    free_lists_.pop_back();
  }
  const NearBricks bricks{.list = list,
                          .a = a_.brick_of(a_.nodes()[a]),
                          .b = b_.brick_of(b_.nodes()[b]),
                          .margin = margin,
                          .block = block_of(a, b)};
  const bool changed = lists_.fill(bricks);
  has_changed_ = has_changed_ || changed;
  keep(a, b, lists_.budget(bricks), list);
}

}  // namespace sprung
