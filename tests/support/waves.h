#pragma once
#include <array>
#include <cmath>
#include <random>

#include "core/world/world.h"

namespace sprung::test {

/// Smooth random waves of velocity through a body.
class Waves {
 public:
  Waves(std::mt19937& random, double speed) {
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
    for (Wave& wave : waves_) wave = {40 * vector(), speed * vector(), 30 * normal(random), normal(random)};
    spin_ = 3 * vector();
    drift_ = speed * vector();
  }

  void set_velocities(SoftBody& body, double time) const {
    const Vec3 middle = body.positions.colwise().mean();
    for (int node = 0; node < body.node_count(); ++node) {
      const Vec3 at = body.rest_positions.row(node);
      Vec3 velocity = drift_ * std::cos(3 * time) + spin_.cross(Vec3(body.positions.row(node)) - middle);
      for (const Wave& wave : waves_) {
        velocity += std::sin(wave.along.dot(at) + wave.frequency * time + wave.phase) * wave.speed;
      }
      body.velocities.row(node) = velocity.transpose();
    }
  }

 private:
  struct Wave {
    Vec3 along;
    Vec3 speed;
    double frequency;
    double phase;
  };
  std::array<Wave, 3> waves_{};
  Vec3 spin_ = Vec3::Zero();
  Vec3 drift_ = Vec3::Zero();
};

}  // namespace sprung::test
