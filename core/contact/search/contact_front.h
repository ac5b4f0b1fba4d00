#pragma once
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "core/contact/search/surface_tree.h"

namespace sprung {

/// A contact point of one surface and a triangle of the other (of the same, where there is one) that may come to touch.
struct FacingPair {
  std::size_t side;  // of the point: 0 or 1; the triangle is of the other
  int point;
  int triangle;  // both: rows of their skins
};

/// How far apart points and triangles are that may come to touch, m.
struct ContactRange {
  double margin;   // outside
  double deepest;  // inside: what is deeper came from the other side
};

/// Which parts of two surfaces, or of one with itself, are near each other, and which points face which triangles
/// there. Pairs of subtrees make up a front through the product of the two trees: each has a distance that its parts
/// must come closer by before it has to be looked at again, and is charged with how far any two points of the
/// two can have come closer: bodies that fall or turn together cost nothing. Where a pair's distance is used up, it is
/// measured anew, and splits if it is near; pairs of bricks that are near list their points and triangles.
///
/// Rigorous: a point and a triangle that can meet before the trees are followed again are in a list, except that within
/// one surface bricks with a neighbour in common are left out, and that normals have to face each other, which is asked
/// for again when they may have turned by kBent. What is in a list beyond that depends on the steps since it was made.
class ContactFront {
 public:
  /// The trees, the same twice for one surface with itself, must outlive it.
  ContactFront(SurfaceTree& a, SurfaceTree& b, const ContactRange& range);

  /// To be called after SurfaceTree::follow(). Returns whether any list has changed.
  bool advance();

  /// The lists of the pairs of bricks that are near, ascending by side, point and triangle within each.
  [[nodiscard]] const std::vector<std::vector<FacingPair>>& lists() const { return lists_; }

 private:
  /// Two subtrees.
  struct Pair {
    double wake;  // m, by which its block may have come closer before it is looked at again
    int a;
    int b;
    int list;  // row in lists_; -1: none
    bool operator<(const Pair& other) const {
      return std::tuple(other.wake, other.a, other.b) < std::tuple(wake, a, b);  // the first to wake is the largest
    }
  };
  /// Pairs whose subtrees have the same motions: those of two clusters.
  struct Block {
    int a;
    int b;              // the clusters' nodes
    double closer = 0;  // m, that any two points of the two can have come closer, since it was made
    std::vector<Pair> heap{};
  };

  [[nodiscard]] bool is_self() const { return &a_ == &b_; }
  /// By how much (rad) their parts have to turn before any of their normals may face each other.
  [[nodiscard]] double turn_until_facing(int a, int b);
  /// How far any two points of two subtrees have come closer since they were last followed, and may until the next
  /// time.
  [[nodiscard]] double moved_closer(int a, int b) const;
  [[nodiscard]] double moving_closer(int a, int b) const;
  void keep(int a, int b, double budget, int list);
  /// Keeps what a pair of subtrees that is due is to be replaced by; `list`: the one that it had.
  void look(int a, int b, int list);
  void split(int a, int b);
  [[nodiscard]] int fill_list(int a, int b, double margin, int list);
  void list_side(std::size_t side, int points_of, int triangles_of, double margin, std::vector<FacingPair>& list);
  [[nodiscard]] SurfaceTree& tree(std::size_t side) { return side == 0 ? a_ : b_; }

  SurfaceTree& a_;
  SurfaceTree& b_;
  ContactRange range_;
  double brick_;  // m, of the finer of the two
  bool has_changed_ = false;
  std::size_t size_ = 0;  // pairs
  std::size_t size_when_new_ = 0;
  std::vector<Block> blocks_;
  std::unordered_map<std::uint64_t, std::size_t> block_of_;  // by the clusters' nodes
  std::vector<Pair> due_;
  std::vector<std::vector<FacingPair>> lists_;
  std::vector<int> free_lists_;
};

}  // namespace sprung
