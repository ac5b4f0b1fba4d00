#include "core/law/neo_hooke/twist.h"

namespace sprung {

SquareTerm<3> twist_term(const Material& material, double h, const Mat3& second) {
  SquareTerm<3> term{.pairs = &kFaceDiagonals, .modes = {}, .stiffness = {}};
  term.modes.setZero();
  term.stiffness = material.shear_modulus() * Vec3(second.diagonal()).asDiagonal().toDenseMatrix();
  for (int normal = 0; normal < 3; ++normal) {
    for (int side = 0; side < 2; ++side) {
      const int first = 4 * normal + 2 * side;  // in kFaceDiagonals
      const double sign = (side != 0 ? 1 : -1) / (4 * h * h * h);
      term.modes(normal, first) = sign;
      term.modes(normal, first + 1) = -sign;
    }
  }
  return term;
}

}  // namespace sprung
