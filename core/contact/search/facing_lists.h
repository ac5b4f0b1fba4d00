#pragma once
#include <vector>

#include "core/contact/search/contact_front.h"

namespace sprung {

/// A contact point of one surface and a triangle of the other (of the same, where there is one) that may come into
/// contact.
struct FacingPair {
  std::size_t side;  // of the point: 0 or 1; the triangle is of the other
  int point;
  int triangle;  // both: rows of their skins
};

/// The distances of points and triangles that may come into contact, m.
struct ContactRange {
  double margin;   // outside
  double deepest;  // inside: what is deeper came from the other side
};

/// The points and triangles of bricks that are near each other. A point and a triangle that can meet are in a list if
/// their normals face each other; what is in a list beyond that depends on the steps since it was made.
class FacingLists : public NearLists {
 public:
  /// The trees of the front, which must outlive it; `deepest`: inside (m): what is deeper came from the other side.
  FacingLists(SurfaceTree& a, SurfaceTree& b, double deepest) : a_(a), b_(b), deepest_(deepest) {}

  bool fill(const NearBricks& bricks) override;
  bool clear(int list) override;
  void clear() override { lists_.clear(); }

  /// Ascending by side, point and triangle within each.
  [[nodiscard]] const std::vector<std::vector<FacingPair>>& lists() const { return lists_; }

 private:
  [[nodiscard]] bool is_self() const { return &a_ == &b_; }
  [[nodiscard]] SurfaceTree& tree(std::size_t side) { return side == 0 ? a_ : b_; }
  void list_side(std::size_t side, int points_of, int triangles_of, double margin, std::vector<FacingPair>& list);

  SurfaceTree& a_;
  SurfaceTree& b_;
  double deepest_;  // m
  std::vector<std::vector<FacingPair>> lists_;
};

}  // namespace sprung
