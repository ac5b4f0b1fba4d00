#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/body/body.h"
#include "core/body/membrane.h"
#include "core/skin/skin.h"

namespace sprung {

/// The outer faces of a body's bricks as a skin at the given node positions (m x 3, m), with a colour (sRGB) a node.
/// Each face is a fine mesh of its own whose rim, `line` metres wide, is darker, so that bricks can be told apart.
/// Normals are smooth over faces that look the same way at rest, so box edges stay sharp.
[[nodiscard]] Skin brick_skin(const Body& body, const Points& positions, const std::vector<Eigen::Vector3f>& colors,
                              double line);

/// The same with a colour a brick.
[[nodiscard]] Skin colored_bricks(const Body& body, const Points& positions, const std::vector<Eigen::Vector3f>& colors,
                                  double line);

/// The rectangles of a membrane as such a skin, facing +z, at those node positions (m x 3, m).
[[nodiscard]] Skin membrane_skin(const Membrane& membrane, const Points& positions,
                                 const std::vector<Eigen::Vector3f>& colors, double line);

}  // namespace sprung
