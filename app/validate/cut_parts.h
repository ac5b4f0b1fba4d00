#pragma once
#include <functional>
#include <string>
#include <vector>

#include "app/validate/check.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/simulation/scene.h"

namespace sprung {

inline const std::string kCalculix = "finite elements (CalculiX C3D20R, tests/references/curved.py)";

/// A figure of a part, and its expected value.
struct CutFigure {
  std::string quantity;
  double expected = 0;
  std::string unit;
  std::string source;
  double tolerance = kNaN;  // of the default
};

/// A part whose figures are all measured at once for a model.
struct CutPart {
  std::string bricks;
  double poisson = 0;
  std::vector<CutFigure> figures;
  std::function<std::vector<double>(Model)> measure;
};

/// A scene whose probe's displacement along an axis is the figure, m.
[[nodiscard]] CutPart probed_part(const Scene& scene, const std::string& bricks, int axis, CutFigure figure);

/// Supports at every node of a side, and the weights of all nodes as loads.
struct SupportedBody {
  Supports supports;
  Points loads;
};

/// The low side of a box of bricks across an axis; `acceleration`: m/s^2.
[[nodiscard]] SupportedBody supported_at(const Body& body, int axis, const Vec3& acceleration);

/// Plates, beams, rods, shells and walls, thin or slanted.
[[nodiscard]] std::vector<CutPart> thin_parts();
/// Free and clamped parts whose bricks are turned.
[[nodiscard]] std::vector<CutPart> turned_parts();
/// Whole bricks: clamped, bonded, crushed, stretched and sheared.
[[nodiscard]] std::vector<CutPart> strained_parts();

}  // namespace sprung
