#include "tests/bench/spring_list.h"

#include <cmath>
#include <map>
#include <utility>

#include "core/body/brick_kernel.h"

namespace sprung::test {
namespace {

using Pair = std::pair<int, int>;

Vec3 between(const Points& values, int from, int to) { return (values.row(to) - values.row(from)).transpose(); }

/// (L^2 - rest^2) / (L + rest): the difference of two nearly equal lengths would lose half its digits.
double stretch_of(const Vec3& vector, double length, double rest) {
  return (vector.squaredNorm() - rest * rest) / (length + rest);
}

}  // namespace

SpringList::SpringList(const Body& body) {
  const double h = body.grid.brick_size;
  std::map<Pair, std::size_t> edge_of;
  std::map<Pair, std::size_t> face_of;
  for (std::size_t i = 0; i < body.grid.nodes.size(); ++i) {
    const auto& nodes = body.grid.nodes[i];
    const auto ends = [&](CornerPair pair) { return Pair(nodes[pair.from], nodes[pair.to]); };
    const double share = body.stiffness_scale[i];
    Brick brick{.edges = {}, .nodes = nodes, .share = share};
    for (std::size_t e = 0; e < 12; ++e) {
      const auto [found, is_new] = edge_of.emplace(ends(kEdges[e]), edges_.size());
      if (is_new) edges_.push_back({.from = found->first.first, .to = found->first.second, .stiffness = 0});
      edges_[found->second].stiffness += share * body.law.edge;
      brick.edges[e] = int(found->second);
    }
    bricks_.push_back(brick);
    for (const CornerPair pair : kFaceDiagonals) {
      if (body.law.face == 0) break;
      const auto [found, is_new] = face_of.emplace(ends(pair), diagonals_.size());
      if (is_new) diagonals_.push_back({found->first.first, found->first.second, std::numbers::sqrt2 * h, 0});
      diagonals_[found->second].stiffness += share * body.law.face;
    }
    for (const CornerPair pair : kInnerDiagonals) {
      if (body.law.inner == 0) break;
      const auto [from, to] = ends(pair);
      diagonals_.push_back({from, to, std::numbers::sqrt3 * h, share * body.law.inner});
    }
  }
}

void SpringList::measure(const Body& body, Edge& edge) const {
  const Vec3 vector = between(body.positions, edge.from, edge.to);
  const double length = vector.norm();
  edge.direction = vector / length;
  edge.driving = stretch_of(vector, length, body.grid.brick_size) +
                 body.damping.beta * edge.direction.dot(between(body.velocities, edge.from, edge.to));
  edge.tension = edge.stiffness * edge.driving;
}

void SpringList::couple(const Body& body, const Brick& brick, Points& forces) {
  BrickLaw corrections = body.law;
  corrections.edge = 0;
  std::array<double, 12> driving{};
  for (std::size_t e = 0; e < 12; ++e) driving[e] = edges_[brick.edges[e]].driving;
  const std::array<double, 12> tensions = detail::edge_tensions(corrections, driving);
  for (std::size_t e = 0; e < 12; ++e) {
    edges_[brick.edges[e]].tension += brick.share * tensions[e];
  }
  CornerVectors<double> x{};
  CornerVectors<double> rates{};
  CornerVectors<double> force{};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t index = 3 * corner + std::size_t(k);
      x[index] = body.positions(brick.nodes[corner], k);
      rates[index] = body.damping.beta * body.velocities(brick.nodes[corner], k);
    }
  }
  detail::axes_energy(body.law, body.grid.brick_size, x, body.damping.beta > 0 ? &rates : nullptr, force);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    forces.row(brick.nodes[corner]) += brick.share * Eigen::Map<const Vec3>(&force[3 * corner]).transpose();
  }
}

void SpringList::forces(const Body& body, Points& forces) {
  forces.setZero(body.node_count(), 3);
  const auto pull = [&](int from, int to, const Vec3& force) {
    forces.row(from) += force.transpose();
    forces.row(to) -= force.transpose();
  };
  for (Edge& edge : edges_) measure(body, edge);
  for (const Brick& brick : bricks_) couple(body, brick, forces);
  for (const Edge& edge : edges_) pull(edge.from, edge.to, edge.tension * edge.direction);
  for (const Spring& spring : diagonals_) {
    const Vec3 vector = between(body.positions, spring.from, spring.to);
    const double length = vector.norm();
    const Vec3 direction = vector / length;
    const double driving = stretch_of(vector, length, spring.rest) +
                           body.damping.beta * direction.dot(between(body.velocities, spring.from, spring.to));
    pull(spring.from, spring.to, spring.stiffness * driving * direction);
  }
}

}  // namespace sprung::test
