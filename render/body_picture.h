#pragma once
#include <functional>
#include <string>

#include "core/body/body.h"
#include "core/body/membrane.h"
#include "core/skin/skin.h"
#include "render/image/image.h"

namespace sprung {

/// The colour (sRGB) of a corner (0 to 3) of a face.
using CornerColor = std::function<Eigen::Vector3f(const BrickFace& face, int corner)>;

/// The outer faces of a body's bricks as a skin at the given node positions (m x 3, m). Each face is a fine mesh of its
/// own with a darker rim, `line` metres wide, so that bricks can be told apart. Normals are smooth over faces that
/// share an orientation at rest, so box edges stay sharp.
[[nodiscard]] Skin brick_skin(const Body& body, const Points& positions, const CornerColor& color, double line);

enum class ColorBy {
  kDisplacement,  // distance of each node from its rest position, mm
  kStrain         // norm of Green's strain, averaged at nodes, %
};

struct BodyPictureOptions {
  ColorBy color_by = ColorBy::kDisplacement;
  double magnification = 1;  // of the displacements; the colours show the true ones
  int width = 640;
  int height = 400;
};

/// A body on white, coloured by ColorMap::kViridis from `low` to `high`.
struct BodyPicture {
  Image image;
  std::string quantity;  // with the unit
  double low = 0;
  double high = 0;
};

/// The bricks of a body at body.positions, edges a little darker. Bricks cut by the surface are drawn whole. Throws
/// Error(kFailed) if no OpenGL context can be made.
[[nodiscard]] BodyPicture draw_body(const Body& body, const BodyPictureOptions& options = {});

/// A membrane likewise, seen from the front, coloured by its displacements.
[[nodiscard]] BodyPicture draw_membrane(const Membrane& membrane, const BodyPictureOptions& options = {});

}  // namespace sprung
