#include "core/law/neo_hooke/warping.h"

namespace sprung {

SquareTerm<3> warping_term(const Material& material, double h, double volume, const Mat3& second) {
  SquareTerm<3> term{.pairs = &kEdges, .modes = {}, .stiffness = {}};
  term.modes.setZero();
  term.stiffness.setZero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    term.stiffness(i, i) = material.young * second(j, j) * second(k, k) / volume;
    for (int side = 0; side < 4; ++side) {
      term.modes(i, 4 * i + side) = edge_sign(side, 0) * edge_sign(side, 1) / (2 * h * h * h * h);
    }
  }
  return term;
}

}  // namespace sprung
