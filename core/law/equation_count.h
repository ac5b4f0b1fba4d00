#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sprung {

/// Which corners of a box the springs of an element join, and whether it is corrected.
struct SpringConfiguration {
  std::string name;
  int dimensions = 3;                    // 2: plane stress, unit thickness
  std::array<double, 3> sides{1, 1, 1};  // m; the third is not used in 2D
  std::vector<int> springs;              // by how many coordinates the ends differ: 1 edges, 2 face diagonals, 3 inner
  bool corrected = false;                // with an axial potential 1/2 e^T M e on the mean stretches
};

enum class EquationKind { kYoung, kPoisson, kShear };

/// Requires a configuration to respond to the uniform strains of the classical experiments like isotropic elasticity
/// with E = 1 Pa: matrix * stiffnesses = right, stiffnesses in N/m, every equation once (none that holds for any
/// stiffness, none twice). Derivation: under a uniform strain a spring along v is stretched by s = v^T strain v / |v|,
/// so the mean stress (in direction of a second strain, Pa) is sum of k s s' / volume; M adds e_i M_ij e_j' / volume,
/// e_i = side_i strain_ii. The strains: along each axis 1, across it -nu (stress along it E: kYoung; across it 0:
/// kPoisson), and for each plane a unit shear (stress G: kShear). The unknowns are the stiffnesses that symmetry does
/// not make equal: springs that span the same sides share one; edges first, each kind in the order of the axes, then M,
/// its diagonal first.
struct SpringEquations {
  Eigen::MatrixXd matrix;  // equations x unknowns, 1/m
  Eigen::VectorXd right;   // Pa
  std::vector<EquationKind> kinds;
};

[[nodiscard]] SpringEquations spring_equations(const SpringConfiguration& configuration, double poisson);

/// A row of the paper's Table 1.
struct EquationCount {
  std::string name;
  int unknowns = 0;
  int equations = 0;  // the sum of the three below
  int young_equations = 0;
  int poisson_equations = 0;
  int shear_equations = 0;
  int rank = 0;                   // of the matrix: how many stiffnesses the equations determine
  bool solvable = false;          // for every Poisson's ratio
  std::optional<double> poisson;  // if not solvable: the one ratio at which it is, if there is one
};

/// Forms the equations of each configuration, counts them, and looks for the ratios (-0.9 to 0.49) that they allow.
[[nodiscard]] std::vector<EquationCount> count_equations(std::span<const SpringConfiguration> configurations);

/// 2D, M1 (edges, face diagonals), M2 (edges, inner diagonals) and M3 (all), each with equal sides, then each with
/// unequal ones, then all of them again, corrected.
[[nodiscard]] std::vector<SpringConfiguration> table_configurations();

}  // namespace sprung
