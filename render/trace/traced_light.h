#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace sprung {

/// One kind of light in all pixels: the mean of the samples that saw it.
struct LightLayer {
  std::vector<Eigen::Vector3f> light;
  std::vector<float> variance;  // of the brightness of that mean
  std::vector<float> share;     // of the pixel's samples

  explicit LightLayer(std::size_t pixels) : light(pixels, Eigen::Vector3f::Zero()), variance(pixels), share(pixels) {}
};

/// The light found by rays, by pixel, rows from the top: layers that are smoothed separately, and what needs no
/// smoothing.
struct TracedLight {
  int width;
  int height;
  LightLayer base;                           // reflected by the bases of skins, as if these were white
  LightLayer specular;                       // by their specular layers; the same share
  LightLayer floor;                          // on the floor, over that without bodies
  std::vector<Eigen::Vector3f> color;        // of skins, linear
  std::vector<Eigen::Vector3f> normal;       // of skins, unit or shorter
  std::vector<Eigen::Vector3f> position;     // of skins where they are seen, stage space
  std::vector<Eigen::Vector3f> floor_color;  // without bodies
  std::vector<Eigen::Vector3f> background;   // times its share

  TracedLight(int columns, int rows)
      : width(columns),
        height(rows),
        base(pixels()),
        specular(pixels()),
        floor(pixels()),
        color(pixels(), Eigen::Vector3f::Zero()),
        normal(pixels(), Eigen::Vector3f::Zero()),
        position(pixels(), Eigen::Vector3f::Zero()),
        floor_color(pixels(), Eigen::Vector3f::Zero()),
        background(pixels(), Eigen::Vector3f::Zero()) {}
  [[nodiscard]] std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
};

}  // namespace sprung
