#pragma once
#include <cstddef>
#include <numeric>
#include <vector>

namespace sprung {

/// Numbers from 0 that are joined into sets; the root of a set stands for it.
class DisjointSets {
 public:
  explicit DisjointSets(std::ptrdiff_t count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  [[nodiscard]] int root(int of) {
    while (parent(of) != of) of = parent(of) = parent(parent(of));
    return of;
  }
  void join(int a, int b) { parent(root(a)) = root(b); }

 private:
  int& parent(int of) { return parent_[static_cast<std::size_t>(of)]; }
  std::vector<int> parent_;
};

}  // namespace sprung
