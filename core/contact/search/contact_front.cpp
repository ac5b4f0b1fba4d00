#include "core/contact/search/contact_front.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr std::size_t kGrown = 2;  // times, plus a constant: a front that has grown this much is rebuilt
constexpr std::size_t kGrownBy = 500;
constexpr double kFar = 0.5;     // bricks: pairs of subtrees that are further apart stay whole
constexpr double kSlow = 0.2;    // of its way, that a watched pair may go by the motions of its clusters
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

const SurfaceTree::Motion& ContactFront::brick_motion(SurfaceTree& tree, int leaf) const {
  return tree.brick_motion(tree.brick_of(tree.nodes()[leaf]), is_self());
}

double ContactFront::bricks_moved_closer(int a, int b) const {
  return reach_between(brick_motion(a_, a).moved, brick_motion(b_, b).moved);
}

double ContactFront::bricks_moving_closer(int a, int b) const {
  return reach_between(brick_motion(a_, a).moving, brick_motion(b_, b).moving);
}

bool ContactFront::advance() {
  has_changed_ = false;
  if (size_ > kGrown * size_when_new_ + kGrownBy) {
    blocks_.clear();
    known_blocks_.clear();
    lists_.clear();
    watched_.clear();
    free_numbers_.clear();
    size_ = 0;
    has_changed_ = true;
  }
  if (blocks_.empty()) {
    if (!a_.nodes().empty() && !b_.nodes().empty()) look(0, 0, -1);
    size_when_new_ = size_;
    return has_changed_;
  }
  due_.clear();
  due_watched_.clear();
  for (int number = 0; number < isize(watched_); ++number) {
    Watched& pair = watched_[number];
    if (pair.a < 0) continue;
    double moved = moved_closer(pair.a, pair.b);
    pair.moving = moving_closer(pair.a, pair.b);
    if (moved + pair.moving > kSlow * pair.wake) {
      moved = bricks_moved_closer(pair.a, pair.b);
      pair.moving = bricks_moving_closer(pair.a, pair.b);
    }
    pair.closer += moved;
    if (pair.wake <= pair.closer + pair.moving) due_watched_.push_back(number);
  }
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
  for (const int number : due_watched_) look(watched_[number].a, watched_[number].b, number);
  for (const Pair& pair : due_) look(pair.a, pair.b, -1);
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

void ContactFront::keep(int a, int b, double budget) {
  Block& block = blocks_[block_of(a, b)];
  block.heap.push_back({block.closer + budget, a, b});
  std::push_heap(block.heap.begin(), block.heap.end());
  ++size_;
}

int ContactFront::watch() {
  ++size_;
  if (free_numbers_.empty()) {
    watched_.emplace_back();
    return isize(watched_) - 1;
  }
  const int number = free_numbers_.back();
  free_numbers_.pop_back();
  return number;
}

void ContactFront::clear_list(int number) {
  if (!watched_[number].is_listed) return;
  const bool changed = lists_.clear(number);
  has_changed_ = has_changed_ || changed;
}

void ContactFront::put_off(int a, int b, double budget, int number) {
  if (number >= 0) {
    clear_list(number);
    watched_[number] = {};
    free_numbers_.push_back(number);
    --size_;
  }
  keep(a, b, budget);
}

void ContactFront::look(int a, int b, int number) {
  const SurfaceTree::Node& one = a_.nodes()[a];
  const SurfaceTree::Node& other = b_.nodes()[b];
  if (is_self() && one.is_leaf() && other.is_leaf()) {
    const std::vector<int>& connected = a_.skin().connected[a_.brick_of(one)];
    if (std::binary_search(connected.begin(), connected.end(), b_.brick_of(other))) return;
  }
  if (is_self() && a == b) return split(a, b);
  const double distance = a_.box(a).exteriorDistance(b_.box(b));
  const bool are_leaves = one.is_leaf() && other.is_leaf();
  // Pairs that may be needed in this step count as near.
  const double moving = moving_closer(a, b);
  if (distance > std::max(are_leaves ? margin_ : kFar * brick_, moving)) return put_off(a, b, distance, number);
  if (const double turn = turn_until_facing(a, b); is_self() && turn > kBent) {
    return put_off(a, b, std::max(kTurned * turn * brick_, distance), number);
  }
  if (!are_leaves) return split(a, b);
  if (number < 0) number = watch();
  const double needed = bricks_moving_closer(a, b);
  if (distance <= std::max(margin_, needed)) return fill_list(a, b, std::max(margin_, needed), number);
  clear_list(number);
  watched_[number] = {.a = a, .b = b, .moving = needed, .wake = distance};
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

void ContactFront::fill_list(int a, int b, double margin, int number) {
  const NearBricks bricks{
      .list = number, .a = a_.brick_of(a_.nodes()[a]), .b = b_.brick_of(b_.nodes()[b]), .margin = margin};
  const bool changed = lists_.fill(bricks);
  has_changed_ = has_changed_ || changed;
  watched_[number] = {
      .a = a, .b = b, .moving = bricks_moving_closer(a, b), .wake = lists_.budget(bricks), .is_listed = true};
}

}  // namespace sprung
