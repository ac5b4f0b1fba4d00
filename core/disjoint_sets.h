#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace sprung {

/// Disjoint sets of the numbers 0 .. count - 1 (union-find); a set is named by its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  [[nodiscard]] int find(int item) {
    while (parent_[item] != item) {
      int& up = parent_[item];
      up = parent_[up];
      item = up;
    }
    return item;
  }

  void merge(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  [[nodiscard]] std::size_t size() const { return parent_.size(); }

 private:
  std::vector<int> parent_;
};

}  // namespace sprung
