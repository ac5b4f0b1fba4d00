#pragma once
#include <string>

#include "core/body/body.h"
#include "core/body/membrane.h"
#include "render/image/image.h"

namespace sprung {

/// What the colours of a picture mean.
struct ColorBar {
  std::string label{};  // with the unit; empty: no bar
  double low = 0;
  double high = 0;
};

enum class ColorBy {
  kDisplacement,  // length of each node's way from rest, mm
  kStrain         // Frobenius norm of Green's strain of each brick's mean axes, averaged at nodes, %
};

struct ExperimentPictureOptions {
  ColorBy color_by = ColorBy::kDisplacement;
  double magnification = 1;  // of the displacements; the colours show the true ones
  double azimuth = 30;       // degrees, as frame_points
  double elevation = 18;
  bool has_ground = false;
  int width = 640;
  int height = 400;
};

struct ExperimentPicture {
  Image image;
  ColorBar colors;
};

/// The outer faces of a body's bricks where they are, coloured by ColorMap::kViridis, the edges of each brick a
/// little darker. Bricks cut by the surface are drawn whole. Throws Error(kFailed) where no picture can be drawn.
[[nodiscard]] ExperimentPicture draw_experiment(const Body& body, const ExperimentPictureOptions& options = {});

/// A membrane where it is, seen from the front, coloured by its displacement.
[[nodiscard]] ExperimentPicture draw_experiment(const Membrane& membrane, const ExperimentPictureOptions& options = {});

}  // namespace sprung
