#include "core/contact/inversion_guard.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/body/body.h"
#include "core/body/forces.h"
#include "core/bricks/brick_topology.h"

namespace sprung {
namespace {

constexpr int kStepsBetweenLooks = 8;       // at most
constexpr double kMoveBetweenLooks = 0.25;  // of a brick: what meets an obstacle may lose as much in a few steps
constexpr std::size_t kBricksPerTask = 512;
constexpr double kSuspectVolume = 0.4;
constexpr double kUnfoldSteps = 20;  // a brick found too flat or inverted recovers within about this many steps
constexpr double kFastestRecovery =
    0.02;  // of the speed of sound, at which its corners separate: adds negligible energy

/// The three edges at a corner, or the mean axes, as columns, each from its low to its high end.
Mat3 edges_at(int corner, const BrickColumns& x) {
  if (corner == InversionRate::kMeanAxes) return mean_axes_of(x);
  Mat3 edges;
  for (int axis = 0; axis < 3; ++axis) edges.col(axis) = x.col(corner | 1 << axis) - x.col(corner & ~(1 << axis));
  return edges;
}

/// The volumes that the edges span at the eight corners, and the mean axes between them.
double smallest_volume(const BrickColumns& x) {
  std::array<Vec3, 12> edges;
  for (std::size_t i = 0; i < edges.size(); ++i) edges[i] = x.col(kEdges[i].to) - x.col(kEdges[i].from);
  const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); };
  const auto mean = [&](std::size_t axis) {
    const Vec3* four = &edges[4 * axis];
    return Vec3(0.25 * ((four[0] + four[1]) + (four[2] + four[3])));
  };
  double smallest = volume(mean(0), mean(1), mean(2));
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t high_x = corner & 1;
    const std::size_t high_y = corner >> 1 & 1;
    const std::size_t high_z = corner >> 2 & 1;
    smallest = std::min(
        smallest, volume(edges[high_y + 2 * high_z], edges[4 + high_z + 2 * high_x], edges[8 + high_x + 2 * high_y]));
  }
  return smallest;
}

}  // namespace

void InversionGuard::look(const Body& body, double dt) {
  const double least = kSuspectVolume * body.grid.brick_volume();
  is_suspect_.resize(body.grid.nodes.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, is_suspect_.size(), kBricksPerTask),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t brick = range.begin(); brick < range.end(); ++brick) {
                        const auto& nodes = body.grid.nodes[brick];
                        const BrickColumns now = columns_of(nodes, body.positions);
                        const BrickColumns later = now + kStepsBetweenLooks * dt * columns_of(nodes, body.velocities);
                        is_suspect_[brick] = std::min(smallest_volume(now), smallest_volume(later)) < least ? 1 : 0;
                      }
                    });
  suspects_.clear();
  for (int brick = 0; brick < body.grid.brick_count(); ++brick) {
    if (is_suspect_[brick] != 0) suspects_.push_back(brick);
  }
}

const std::vector<InversionRate>& InversionGuard::find(const Body& body, double dt) {
  if (to_look_.is_due()) {
    look(body, dt);
    const double move = largest_speed(body) * dt / body.grid.brick_size;
    const bool is_fast = move * kStepsBetweenLooks > kMoveBetweenLooks;  // not if it is not a number
    to_look_.restart(is_fast ? std::max(1, int(kMoveBetweenLooks / move)) : kStepsBetweenLooks);
  }
  to_look_.tick();
  found_.clear();
  flattest_ = {};
  const double volume = body.grid.brick_volume();
  const double fastest = kFastestRecovery * std::sqrt(body.material.young / body.material.density) * dt;  // m
  for (const int brick : suspects_) {
    const auto& nodes = body.grid.nodes[brick];
    const BrickColumns x = columns_of(nodes, body.positions);
    const BrickColumns v = columns_of(nodes, body.velocities);
    for (int corner = 0; corner <= InversionRate::kMeanAxes; ++corner) {
      const Mat3 edges = edges_at(corner, x);
      const Mat3 areas = areas_of(edges) / volume;
      const double volume_ratio = edges.col(0).dot(areas.col(0));
      const double deficit = kMinVolume - volume_ratio;
      const double rate = edges_at(corner, v).cwiseProduct(areas).sum();
      if (corner == InversionRate::kMeanAxes) {
        flattest_ = flatter_of(flattest_, {volume_ratio, volume_ratio + dt * std::min(rate, 0.0)});
      }
      const double recovery = std::min(deficit / kUnfoldSteps, fastest * areas.norm());
      const double min_rate = (deficit > 0 ? recovery : deficit) / dt;
      if (!(rate < min_rate)) continue;  // nor if a number is not finite
      found_.push_back({.brick = brick, .corner = corner, .gradient = areas, .min_rate = min_rate});
    }
  }
  return found_;
}

Eigen::Matrix<double, 3, 8> corner_gradients(const InversionRate& rate) {
  Eigen::Matrix<double, 3, 8> gradients = Eigen::Matrix<double, 3, 8>::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 8; ++corner) {
      const bool is_end = rate.corner == InversionRate::kMeanAxes || (corner | 1 << axis) == (rate.corner | 1 << axis);
      if (!is_end) continue;
      const double share = rate.corner == InversionRate::kMeanAxes ? 0.25 : 1;
      gradients.col(corner) += (on_high_side(corner, axis) ? share : -share) * rate.gradient.col(axis);
    }
  }
  return gradients;
}

}  // namespace sprung
