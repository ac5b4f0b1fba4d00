#pragma once
#include <vector>

#include "core/motion/newton_system.h"
#include "core/world/muscle.h"
#include "core/world/world.h"

namespace sprung {

/// The muscles of a body as an energy, for steps that look for a minimum; see MuscleTension.
class MusclePotential {
 public:
  /// The actor has to outlive it.
  explicit MusclePotential(const Actor& actor) : actor_(actor) {}

  /// Before a step: the muscles contract as they do now.
  void begin();

  /// J, of the body where it stands; adds forces (m x 3, N).
  double add_forces(Points& forces) const;
  /// What pulls stiffens a brick against turning, what pushes softens it; with `definite` that is left out.
  void add_stiffness(bool definite, std::vector<PointStiffness>& points) const;

 private:
  /// One of a brick's directions e_i.
  struct Draw {
    int brick;
    Eigen::Matrix<double, 8, 1> weights;  // of the brick's corners in F e_i, 1/m
    Vec3 along;                           // F e_i
    double energy;                        // J, for a length of one
  };
  template <class Visit>
  void for_draws(const Visit& visit) const;

  const Actor& actor_;
  std::vector<MuscleTension> tensions_;  // by muscle
};

}  // namespace sprung
