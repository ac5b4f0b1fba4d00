#include <cmath>

#include "core/body/kernel/pack.h"
#include "tests/bench/machine_limits.h"
#include "tests/bench/spring_rows.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

void step_rows(test::SpringRows& rows, double dt);

namespace {

class Rows {
 public:
  explicit Rows(test::SpringRows& rows)
      : row_(rows.nodes[0]), layer_(row_ * rows.nodes[1]), shares_(rows.shares.data()) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      positions_[axis] = rows.positions[axis].data();
      forces_[axis] = rows.forces[axis].data();
    }
  }

  /// The springs of a row of bricks that begin at its lowest row of nodes, each spring once.
  void pull(int first, bool has_row, bool has_layer) const {
    const double diagonal = std::sqrt(3.0);
    for (int i = 0; i < row_; i += kLanes) {
      const int node = first + i;
      const Pack bricks = load(shares_ + i);
      pull(node, node + 1, 1, bricks);
      if (has_row) pull(node, node + row_, 1, 1.0);
      if (has_layer) pull(node, node + layer_, 1, 1.0);
      if (!has_row || !has_layer) continue;
      pull(node, node + 1 + row_ + layer_, diagonal, bricks);
      pull(node + 1, node + row_ + layer_, diagonal, bricks);
      pull(node + row_, node + 1 + layer_, diagonal, bricks);
      pull(node + 1 + row_, node + layer_, diagonal, bricks);
    }
  }

 private:
  [[nodiscard]] [[gnu::always_inline]] Pack3 position(int node) const {
    return {load(positions_[0] + node), load(positions_[1] + node), load(positions_[2] + node)};
  }

  [[gnu::always_inline]] void pull(int from, int to, double rest, const Pack& share) const {
    const Pack3 d = position(to) - position(from);
    const Pack3 force = (share * (1.0 - rest * inverse_root(dot(d, d)))) * d;
    add(force, from);
    add(-force, to);
  }

  [[gnu::always_inline]] void add(const Pack3& force, int node) const {
    SPRUNG_INSTRUCTION_SET::add(force.x, forces_[0] + node);
    SPRUNG_INSTRUCTION_SET::add(force.y, forces_[1] + node);
    SPRUNG_INSTRUCTION_SET::add(force.z, forces_[2] + node);
  }

  int row_;
  int layer_;
  const double* shares_;
  std::array<const double*, 3> positions_{};
  std::array<double*, 3> forces_{};
};

void move(double* __restrict positions, double* __restrict velocities, double* __restrict forces, double dt,
          std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    velocities[i] += dt * forces[i];
    positions[i] += dt * velocities[i];
    forces[i] = 0;
  }
}

}  // namespace

void step_rows(test::SpringRows& rows, double dt) {
  const Rows springs(rows);
  for (int layer = 0; layer < rows.nodes[2]; ++layer) {
    for (int row = 0; row < rows.nodes[1]; ++row) {
      springs.pull((layer * rows.nodes[1] + row) * rows.nodes[0], row + 1 < rows.nodes[1], layer + 1 < rows.nodes[2]);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    move(rows.positions[axis].data(), rows.velocities[axis].data(), rows.forces[axis].data(), dt,
         rows.positions[axis].size());
  }
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
