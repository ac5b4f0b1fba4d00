#pragma once
#include <vector>

#include "core/body/body.h"
#include "core/body/kernel/tile_kernel.h"

namespace sprung {

/// Evaluates the springs of a body, or its solid bricks, in a workspace kept from step to step. Tiles are computed in
/// parallel and their contributions to shared nodes are summed in a fixed order: the same bits for any number of
/// threads. Only for models with has_tiles().
class SpringSystem {
 public:
  explicit SpringSystem(const SpringKernel& kernel = best_spring_kernel()) : kernel_(kernel) {}

  /// Forces on the nodes, m x 3, N, as spring_forces().
  void forces(const Body& body, Points& forces);

  /// The second derivative of the elastic energy times u (3 m). Solid bricks only.
  void multiply(const Body& body, const Eigen::VectorXd& u, Eigen::VectorXd& product);

  /// `factor` times the axial stiffness of the springs (without the geometric stiffness), or times
  /// BrickModel::damping(), times u (3 m): the damping forces of rates u, with nodes at `positions` (m x 3, m), times
  /// -factor / beta.
  void multiply_along(const Body& body, const Points& positions, double factor, const Eigen::VectorXd& u,
                      Eigen::VectorXd& product);

  /// J, as elastic_energy().
  [[nodiscard]] double energy(const Body& body);

  /// The parameters of a step.
  struct Step {
    double drift = 0;             // s
    double kick = 0;              // s
    Rayleigh damping{};           // instead of the body's
    Vec3 gravity = Vec3::Zero();  // m/s^2
  };

  /// body.positions += drift * velocities, then body.velocities += kick * (forces / m + gravity - alpha velocities).
  /// Inverse masses per node in 1/kg.
  void move(Body& body, const Step& step, const Eigen::VectorXd& inverse_masses);

 private:
  void run(const Body& body, KernelInput input);
  void run_product(const Body& body, KernelInput input, const Eigen::VectorXd& u, Eigen::VectorXd& product);

  /// Scratch in whole cache lines: a pack that straddles two costs twice as much.
  struct alignas(64) CacheLine {
    double values[8] = {};
  };

  SpringKernel kernel_;
  std::vector<double> shared_;                   // forces
  std::vector<double> gathered_;                 // likewise, of gathered bricks
  std::vector<EnergyLanes> energies_;            // per tile, then per group of packs
  std::vector<std::vector<CacheLine>> scratch_;  // per thread
};

/// Workspace for the forces of one body, kept between steps.
struct ForceWorkspace {
  SpringSystem springs;
  CornerSums bricks;  // models without springs
};

/// Forces of all bricks on the nodes, m x 3, N: elastic, and beta damping (at body.velocities), without gravity
/// and alpha damping. The same bits for any number of threads.
void spring_forces(const Body& body, ForceWorkspace& workspace, Points& forces);

/// Elastic energy stored in the bricks, J.
[[nodiscard]] double elastic_energy(const Body& body, ForceWorkspace& workspace);
[[nodiscard]] double elastic_energy(const Body& body);

/// The rounding error of elastic_energy(), J, at most: a brick's energy is a small difference of terms as large as
/// Young's modulus times its volume.
[[nodiscard]] double energy_rounding(const Body& body);

/// Energies of some bricks, with the body's nodes at `positions` (m x 3, m), J; those of all add up to
/// elastic_energy().
[[nodiscard]] Eigen::VectorXd brick_energies(const Body& body, const std::vector<int>& bricks, const Points& positions);

/// Sum of the absolute values of all force components of every brick at its corners, N.
[[nodiscard]] double corner_force_sum(const Body& body);

/// 1/2 sum m v^2, J.
[[nodiscard]] double kinetic_energy(const Body& body);

/// The speed of the fastest node, m/s.
[[nodiscard]] double largest_speed(const Body& body);

/// Sum of m v, kg m/s, and sum of x cross m v about the world's origin, kg m^2/s.
[[nodiscard]] Vec3 linear_momentum(const Body& body);
[[nodiscard]] Vec3 angular_momentum(const Body& body);

}  // namespace sprung
