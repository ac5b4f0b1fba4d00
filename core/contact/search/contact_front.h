#pragma once
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "core/contact/search/surface_tree.h"

namespace sprung {

/// Two bricks that are near each other.
struct NearBricks {
  int list;       // number of the list that is kept of them
  int a;          // rows of their skins
  int b;          //
  double margin;  // m: what lies within it is near
};

/// The lists that a front keeps of bricks that are near each other.
class NearLists {
 public:
  NearLists() = default;
  NearLists(const NearLists&) = delete;
  NearLists& operator=(const NearLists&) = delete;
  virtual ~NearLists() = default;

  /// Refills a list; its number is at most one more than any before. Returns whether it changed.
  virtual bool fill(const NearBricks& bricks) = 0;
  /// How far (m) bricks may approach before their list must be refilled: at least `margin`.
  [[nodiscard]] virtual double budget(const NearBricks& bricks) { return bricks.margin; }
  /// Empties one list. Returns whether it changed.
  virtual bool clear(int list) = 0;
  /// Removes all lists.
  virtual void clear() = 0;
};

/// Which parts of two surfaces, or of one with itself, are near each other. Pairs of subtrees make up a front through
/// the product of the two trees: each has a distance by which its parts must approach before it is checked again, and
/// is charged with how far any two points of the two can have come closer: bodies that fall or turn together cost
/// nothing. When a pair's distance is used up, it is measured again, and split if it is near; pairs of bricks that are
/// near are listed. Subtrees move as their clusters of bricks do; pairs of bricks that these motions would have
/// measured in every step are watched one by one, by their own.
///
/// Rigorous: bricks whose points, edges or triangles can meet before the trees are followed again are listed, except,
/// of one surface, those that share a node and those whose normals do not face each other: bricks with similar normals
/// are near without approaching. That is checked again when normals may have turned by kBent.
class ContactFront {
 public:
  /// The trees, the same twice for one surface with itself, and the lists must outlive it. Bricks within `margin` (m)
  /// are near.
  ContactFront(SurfaceTree& a, SurfaceTree& b, double margin, NearLists& lists);

  /// Call after SurfaceTree::follow(). Returns whether any list has changed.
  bool advance();

  /// How far (m) anything of two listed bricks can have come closer since their list was last filled, and may until the
  /// trees are followed again.
  [[nodiscard]] double closer(int list) const { return watched_[list].closer; }
  [[nodiscard]] double moving_closer(int list) const { return watched_[list].moving; }

 private:
  /// Two subtrees.
  struct Pair {
    double wake;  // m, by which its block may have come closer before it is checked again
    int a;
    int b;
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

  /// Two leaves that are near, or would be checked in every step by the motions of their clusters.
  struct Watched {
    int a = -1;  // -1: none, the number is free
    int b = -1;
    double closer = 0;  // m, that anything of the two can have come closer since they were checked,
    double moving = 0;  // and may until the trees are followed again
    double wake = 0;    // m, by which they may before they are checked again
    bool is_listed = false;
  };

  [[nodiscard]] bool is_self() const { return &a_ == &b_; }
  /// The angle (rad) that their parts have to turn before any of their normals may face each other.
  [[nodiscard]] double turn_until_facing(int a, int b);
  /// How far any two points of two subtrees have come closer since they were last followed, and may until the next
  /// time.
  [[nodiscard]] double moved_closer(int a, int b) const;
  [[nodiscard]] double moving_closer(int a, int b) const;
  /// Likewise of two leaves.
  [[nodiscard]] double bricks_moved_closer(int a, int b) const;
  [[nodiscard]] double bricks_moving_closer(int a, int b) const;
  [[nodiscard]] const SurfaceTree::Motion& brick_motion(SurfaceTree& tree, int leaf) const;
  [[nodiscard]] std::size_t block_of(int a, int b);
  void keep(int a, int b, double budget);
  /// Stores the replacements of a pair of subtrees that is due; `number`: of it among those watched, or -1.
  void look(int a, int b, int number);
  void split(int a, int b);
  /// Returns the number of a further pair.
  [[nodiscard]] int watch();
  void clear_list(int number);
  /// Keeps a pair that is no longer near.
  void put_off(int a, int b, double budget, int number);
  void fill_list(int a, int b, double margin, int number);

  SurfaceTree& a_;
  SurfaceTree& b_;
  double margin_;  // m
  NearLists& lists_;
  double brick_;  // m, of the finer of the two
  bool has_changed_ = false;
  std::size_t size_ = 0;  // pairs
  std::size_t size_when_new_ = 0;
  std::vector<Block> blocks_;
  std::unordered_map<std::uint64_t, std::size_t> known_blocks_;  // by the clusters' nodes
  std::vector<Pair> due_;
  std::vector<Watched> watched_;  // by their number, which is also that of their list
  std::vector<int> free_numbers_;
  std::vector<int> due_watched_;
};

}  // namespace sprung
