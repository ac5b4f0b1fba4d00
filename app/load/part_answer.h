#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/load/part_solution.h"

namespace sprung {

/// A quantity and its estimated discretisation error.
struct Estimate {
  double value = 0;
  double error = 0;
};

/// The largest value of a quantity, and its position.
struct Peak : Estimate {
  Vec3 position = Vec3::Zero();  // in the file
};

/// A singular stress, which grows with the number of bricks: at a re-entrant corner, or where a support or a load ends,
/// the exact solution is unbounded.
struct Singularity {
  Vec3 position = Vec3::Zero();  // in the file
  double stress = 0;             // von Mises, Pa, with the finest bricks
  double exponent = 0;           // a of stress ~ size^-a
};

/// The solution at a requested point, in the axes of the file.
struct PointAnswer {
  Vec3 position = Vec3::Zero();                                              // in the file
  Vec3 displacement = Vec3::Zero();                                          // m
  Eigen::Matrix<double, 6, 1> stress = Eigen::Matrix<double, 6, 1>::Zero();  // xx, yy, zz, xy, yz, zx, Pa
  Estimate von_mises;                                                        // Pa
};

/// The response of a part to its loads. SI; vectors in the axes of the file, positions in the file.
struct PartAnswer {
  Vec3 extent = Vec3::Zero();  // m
  double volume = 0;           // m^3, of the mesh
  double mass = 0;             // kg
  std::vector<double> brick_sizes;
  std::vector<long> brick_counts;
  double bricks_across = 0;  // a thin wall; 0: unknown
  bool is_linear = true;

  Peak displacement;
  Vec3 displacement_vector = Vec3::Zero();  // m, there
  std::optional<Peak> von_mises;            // Pa; none if all large stresses are singular
  std::optional<Peak> tension;              // Pa, the largest principal stress
  std::optional<Peak> compression;          // Pa, the least principal stress, negative
  std::vector<Singularity> singular;        // of von Mises, those that exceed the largest away from them

  std::vector<PointAnswer> points;  // as asked for

  struct Reaction {
    std::string fix;
    double area = 0;                                   // m^2, of the face
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // N, N m about the centre of the face
    Vec3 centre = Vec3::Zero();                        // in the file
  };
  std::vector<Estimate> frequencies;        // Hz, lowest first, if requested
  bool has_buckling = false;                // whether it was requested
  std::optional<Estimate> buckling_factor;  // of all loads; none: they never cause buckling
  std::vector<Reaction> reactions;          // of fixes, then of loads that prescribe a displacement
};

/// 3 |fine - coarse| / (ratio^2 - 1), `ratio`: of the brick sizes.
[[nodiscard]] double convergence_index(double fine, double coarse, double ratio);

/// The results of solutions on successively coarser grids, finest first. The error of a quantity is bounded by the grid
/// convergence index, 3 |f_1 - f_k| / ((h_k / h_1)^2 - 1), the largest of all coarser grids k (Roache, J. Fluids Eng.
/// 116 (1994) 405); a single grid leaves it unknown (infinite). Stresses are singular where, at a sharp re-entrant
/// edge or a support, they grow like size^-kSingular or faster from the coarsest grid to the finest; at an edge that
/// turns by 50 degrees or a face held along all axes, where that only begins to show, like size^-kSurelySingular (half
/// of either next to others). Stresses within three of its bricks of a singularity are left out.
[[nodiscard]] PartAnswer answer_of(const std::vector<PartSolution>& solutions, const LoadPart& part,
                                   const LoadCase& loads, const PartBricks& bricks);

/// Displacement and stress at points of the file. Throws Error(kUsage) for one that is not in the part.
[[nodiscard]] std::vector<PointAnswer> answers_at(const std::vector<Vec3>& points,
                                                  const std::vector<PartSolution>& solutions, const LoadPart& part);

inline constexpr double kSingular = 0.2;
inline constexpr double kSurelySingular = 0.03;

}  // namespace sprung
