#pragma once
#include <cstddef>
#include <vector>

#include "core/types.h"

namespace sprung {

/// A stiffness against the motion of a weighted sum of a brick's corners, such as a contact.
struct PointStiffness {
  int brick = 0;
  CornerWeights weights;          // of the brick's corners in the point
  Mat3 stiffness = Mat3::Zero();  // N/m, symmetric; no negative eigenvalue if a system must be definite
};

/// A part of a coupled point: the corners of a brick of one body, by their weights.
struct CoupledCorners {
  std::size_t body;
  int brick;
  CornerWeights weights;
};

/// A stiffness of a weighted sum of node positions of several bodies, such as a point of one skin relative to a
/// triangle of another. The first part is one side; the others are the other side.
struct Coupling {
  std::vector<CoupledCorners> corners;
  Mat3 stiffness = Mat3::Zero();  // N/m, symmetric, no negative eigenvalue
};

}  // namespace sprung
