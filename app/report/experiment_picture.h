#pragma once
#include <string>

#include "core/body/body.h"
#include "core/body/sheet.h"
#include "render/image.h"

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

/// The outer faces of a body's bricks where they are, coloured on the scale of color_scale(), the edges of each brick a
/// little darker. Bricks cut by the surface are drawn whole. Throws Error(kFailed) where no picture can be drawn.
[[nodiscard]] ExperimentPicture draw_experiment(const Body& body, const ExperimentPictureOptions& options = {});

/// A sheet where it is, seen from the front, coloured by its displacement.
[[nodiscard]] ExperimentPicture draw_experiment(const Sheet& sheet, const ExperimentPictureOptions& options = {});

/// sRGB in [0, 1] for a share from 0 to 1: dark blue over green to yellow, evenly spaced to the eye and told apart by
/// colour-blind people. Source: the map "viridis" of matplotlib (CC0), by linear interpolation of nine of its colours.
[[nodiscard]] Eigen::Vector3f color_scale(double share);

}  // namespace sprung
