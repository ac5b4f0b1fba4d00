#pragma once
#include <array>
#include <vector>

#include "core/body/body.h"

namespace sprung::test {

/// The simplest computation of a body's springs: a list of them, each adding its force to its two nodes, and for every
/// brick its corrections. One thread, one spring at a time. The oracle of the kernels and what their
/// speed is compared with.
class SpringList {
 public:
  explicit SpringList(const Body& body);

  /// Like spring_forces(): m x 3, N.
  void forces(const Body& body, Points& forces);

 private:
  struct Spring {
    int from;
    int to;
    double rest;       // m
    double stiffness;  // N/m
  };
  struct Edge {
    int from;
    int to;
    double stiffness;    // N/m, of its own spring
    double driving = 0;  // stretch + beta * its rate, m
    double tension = 0;  // N
    Vec3 direction = Vec3::Zero();
  };
  struct Brick {
    std::array<int, 12> edges;
    std::array<int, 8> nodes;
    double share;
  };

  void measure(const Body& body, Edge& edge) const;
  void couple(const Body& body, const Brick& brick, Points& forces);

  std::vector<Spring> diagonals_;
  std::vector<Edge> edges_;
  std::vector<Brick> bricks_;
};

}  // namespace sprung::test
