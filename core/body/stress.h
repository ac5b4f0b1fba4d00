#pragma once
#include <vector>

#include "core/body/body.h"
#include "core/body/brick_measures.h"
#include "core/bricks/embedding.h"

namespace sprung {

/// n x 6: xx, yy, zz, xy, yz, zx of a symmetric tensor per row.
using StressTensors = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Cauchy stress (Pa, in the axes of the world) at a body's nodes with these at `positions` (m x 3, m), recovered. The
/// stress of a brick is evaluated at its centre and extrapolated to its corners with the slopes of a linear fit through
/// its neighbours of the same material, from its own value or, as far as it is cut, from that of the fit; nodes average
/// their bricks. Without neighbours, where a part is one brick thick, the bending and twist of the brick itself are
/// used. Linear stress fields are exact, in full bricks. At the interface of two materials it is the mean of both
/// sides. Deterministic.
[[nodiscard]] StressTensors recover_stress(const Body& body, const Points& positions,
                                           StrainMeasure measure = StrainMeasure::kFinite);
/// At some nodes only, a row for each.
[[nodiscard]] StressTensors recover_stress(const Body& body, const Points& positions, const std::vector<int>& nodes,
                                           StrainMeasure measure = StrainMeasure::kFinite);

/// The same at points embedded in the body, by trilinear interpolation.
[[nodiscard]] StressTensors stress_at(const BrickGrid& grid, const Embedding& points, const StressTensors& of_nodes);

/// sqrt(3/2 dev s : dev s); n, Pa.
[[nodiscard]] Eigen::VectorXd von_mises(const StressTensors& stresses);

struct PrincipalStresses {
  Points values;                   // n x 3, Pa, the largest (most tensile) first
  std::vector<Mat3> directions{};  // unit columns, of these
};

[[nodiscard]] PrincipalStresses principal_stresses(const StressTensors& stresses);

}  // namespace sprung
