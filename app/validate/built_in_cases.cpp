#include "app/validate/built_in_cases.h"

#include <array>

namespace sprung {
namespace {

constexpr std::array<BuiltInCase, 7> kCases{
    {{"patch", "uniform stretch and shear of several bricks: exact at any ratio",
      "The outer nodes of a box of bricks are put where a uniform strain takes them, three stretches and three shears "
      "in "
      "turn; the inner ones find their own place. They find the uniform strain's, and the energy and the mean stress "
      "are "
      "those of isotropic elasticity, for every model with corrections and for springs alone at a ratio of 1/4. The "
      "numbers are the worst of the six strains. Exact are energy, stress and the sum of the forces on every face; the "
      "force on a single corner of a sheared brick is not, since its inner diagonals also press the eight corners in "
      "turns in and out. That pattern sums to nothing on every face and every edge of the brick pair by pair, and "
      "around a node the bricks cancel each other's, so that no node inside feels it: which is all that convergence "
      "asks (the patch test).",
      run_patch, draw_patch},
     {"membrane_patch", "the paper's 2D rectangle: uniform stretch and shear of several, exact at any ratio",
      "The same in plane stress, with rectangles that are not square.", run_membrane_patch, nullptr},
     {"membrane_stretch", "the paper's 2D rectangle: a membrane pulled at its end, exact at any ratio",
      "Two sides roll on axes of symmetry, the far end is pulled by 10 Pa.", run_membrane_stretch,
      draw_membrane_stretch},
     {"membrane_shear", "the paper's 2D rectangle: a membrane in pure shear, exact at any ratio",
      "Tractions of 10 Pa along all four sides.", run_membrane_shear, draw_membrane_shear},
     {"membrane_cantilever", "the paper's 2D rectangle: a cantilever against beam theory",
      "The rectangle calibrated in bending is right on one row of rectangles, the paper's is much too stiff there.",
      run_membrane_cantilever, draw_membrane_cantilever},
     {"equations", "equations and unknowns of each layout of springs (the paper's Table 1)",
      "Each layout has to answer the classical experiments: Young's modulus along every axis, Poisson's ratio across "
      "it, "
      "a shear in every plane. Counted by the program from the layouts, after symmetry. Where there are more equations "
      "than a layout's stiffnesses can meet, it is right at one ratio at most: 1/4 in space, 1/3 in the plane. The "
      "corrections add the unknowns that are missing.",
      run_equations, nullptr},
     {"uniaxial", "large strain: one brick stretched from 0.5 to 2 times its length, sides free",
      "Springs that are linear in their true stretch are one hyperelastic law, and it is none of the textbooks'; all "
      "of "
      "them share E and the ratio at rest. Stretched or squeezed by 10 % the bricks are within 7 % of Hooke's straight "
      "line (calibrated 4 %, tensile 3 %, m1 7 %), where neo-Hooke and St. Venant-Kirchhoff are 9 to 16 % off, one on "
      "either side. At twice its length the calibrated brick pulls with 1.4 E, between neo-Hooke's 0.5 E and St. "
      "Venant-Kirchhoff's 3 E; at half its length it pushes back with 0.42 E, between 1.1 E and 0.19 E, where St. "
      "Venant-Kirchhoff has begun to give way. Which of them a real material follows only its own test can tell: below "
      "10 % of strain it makes little difference, beyond it the law is a part of the answer. The laws of the bricks "
      "differ among each other by how much of the resistance is in diagonals, which turn as a brick is stretched.",
      run_uniaxial, nullptr}}};

}  // namespace

std::span<const BuiltInCase> built_in_cases() { return kCases; }

}  // namespace sprung
