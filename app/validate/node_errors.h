#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/body/body.h"

namespace sprung {

/// Displacements at points of a body, from an independent solution.
struct KnownSolution {
  double poisson = 0;
  Points positions;      // n x 3, m, at rest, from the centre of the body's bounding box
  Points displacements;  // n x 3, m
};

/// The solutions in a table "poisson,x,y,z,ux,uy,uz" (CSV, SI units, # starts a comment line), one for each Poisson's
/// ratio. Throws Error(kBadInput) naming file and line.
[[nodiscard]] std::vector<KnownSolution> read_known_solutions(const std::filesystem::path& file);

struct NodeError {
  double along = 0;  // x at rest, 0 to 1 over the known points
  Vec3 known;        // displacement, m
  Vec3 error;        // of the body's displacement, m
};

/// The difference between a body and a known solution at its nodes.
struct NodeErrors {
  std::string model{};
  double poisson = 0;
  std::string grid{};            // "8x2x2"
  std::vector<NodeError> nodes;  // those at known points
  double largest = 0;            // of the known displacements, m

  /// Length of the error over the largest known displacement: mean and maximum over the nodes.
  [[nodiscard]] double mean_error() const;
  [[nodiscard]] double max_error() const;
  /// Root of the sum of squared errors over the sum of squared known displacements.
  [[nodiscard]] double rms_error() const;
};

/// The errors of body.positions at the known points that coincide with a node; `bricks_from_rest` rotates the points
/// into the frame of the grid. Throws Error(kBadInput) if no node coincides with any of them.
[[nodiscard]] NodeErrors node_errors(const Body& body, const Mat3& bricks_from_rest, const KnownSolution& known);

}  // namespace sprung
