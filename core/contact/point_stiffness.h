#pragma once
#include <cstddef>
#include <vector>

#include "core/types.h"

namespace sprung {

/// Something that holds what moves as a weighted sum of a brick's corners, such as a contact.
struct PointStiffness {
  int brick = 0;
  CornerWeights weights;          // of the brick's corners in the point
  Mat3 stiffness = Mat3::Zero();  // N/m, symmetric; no negative eigenvalue where a system is to be definite
};

/// A part of a coupled place: the corners of a brick of one body, by their weights.
struct CoupledCorners {
  std::size_t body;
  int brick;
  CornerWeights weights;
};

/// Holds the weighted sum of nodes' places of several bodies, such as where a point of one skin stands to a triangle of
/// another. First comes what is on one side, by itself, then what is on the other.
struct Coupling {
  std::vector<CoupledCorners> corners;
  Mat3 stiffness = Mat3::Zero();  // N/m, symmetric, no negative eigenvalue
};

}  // namespace sprung
