#include "app/report/experiment_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/report/brick_skin.h"
#include "core/body/brick_kernel.h"
#include "render/image/color_map.h"
#include "render/renderer.h"

namespace sprung {

namespace {

constexpr double kLine = 0.0022;  // half the width of the lines between bricks over the size of the body

template <class Nodes>
Eigen::VectorXd displacements(const Nodes& body) {
  return (body.positions - body.rest_positions).rowwise().norm();
}

double brick_strain(const Body& body, std::size_t brick) {
  const auto axes = detail::mean_axes(brick_corners(body, brick));
  Mat3 gradient;
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) gradient(c, i) = axes[i][c];
  }
  gradient /= body.grid.brick_size;
  return (0.5 * (gradient.transpose() * gradient - Mat3::Identity())).norm();
}

Eigen::VectorXd strains(const Body& body) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(body.node_count());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(body.node_count());
  for (std::size_t brick = 0; brick < body.grid.cells.size(); ++brick) {
    const double strain = brick_strain(body, brick);
    for (const int node : body.grid.nodes[brick]) {
      sums[node] += strain;
      counts[node] += 1;
    }
  }
  return sums.cwiseQuotient(counts);
}

ColorBar color_bar(ColorBy by, const Eigen::VectorXd& values) {
  return by == ColorBy::kDisplacement ? ColorBar{"displacement (mm)", 0, 1000 * values.maxCoeff()}
                                      : ColorBar{"strain (%)", 0, 100 * values.maxCoeff()};
}

Image draw(const Stage& stage, const std::vector<SkinShape>& shapes, const Camera& camera,
           const ExperimentPictureOptions& options) {
  Renderer renderer(stage, {options.width, options.height, 4});
  return renderer.draw(shapes, camera);
}

/// The picture as if the studio that is seen in `backdrop` were white: every pixel over what stands behind it.
void make_white(Image& image, const Image& backdrop) {
  constexpr int kWhite = 255;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const int behind = std::max<int>(1, backdrop.pixels[i]);
    image.pixels[i] = static_cast<std::uint8_t>(std::min(kWhite, (image.pixels[i] * kWhite + behind / 2) / behind));
  }
}

Image draw_on_white(const Skin& skin, const ExperimentPictureOptions& options) {
  Stage stage;
  stage.bounds = bounding_box(skin.positions);
  stage.has_ground = options.has_ground;
  stage.ground.height = stage.bounds.min().y();
  const double aspect = double(options.width) / options.height;
  const Camera camera = frame_points(skin.positions, aspect, options.azimuth, options.elevation);
  const Image backdrop = draw(stage, {}, camera, options);
  stage.skins = {&skin};
  stage.default_colors = {Eigen::Vector3f::Ones()};
  Image image = draw(stage, {{skin.positions.cast<float>(), skin.normals.cast<float>()}}, camera, options);
  make_white(image, backdrop);
  return image;
}

std::vector<Eigen::Vector3f> colors_of(const Eigen::VectorXd& values) {
  const double highest = std::max(values.maxCoeff(), 1e-300);
  std::vector<Eigen::Vector3f> colors;
  for (const double value : values) colors.push_back(map_color(ColorMap::kViridis, value / highest));
  return colors;
}

double line_width(const Points& shown) { return kLine * bounding_box(shown).diagonal().norm(); }

}  // namespace

ExperimentPicture draw_experiment(const Body& body, const ExperimentPictureOptions& options) {
  const Eigen::VectorXd values = options.color_by == ColorBy::kDisplacement ? displacements(body) : strains(body);
  const Points shown = body.rest_positions + options.magnification * (body.positions - body.rest_positions);
  const Skin skin = brick_skin(body, shown, colors_of(values), line_width(shown));
  return {draw_on_white(skin, options), color_bar(options.color_by, values)};
}

ExperimentPicture draw_experiment(const Membrane& membrane, const ExperimentPictureOptions& options) {
  const Eigen::VectorXd values = displacements(membrane);
  Points shown = membrane_surface(membrane).positions;
  shown.leftCols<2>() =
      membrane.rest_positions + options.magnification * (membrane.positions - membrane.rest_positions);
  ExperimentPictureOptions frontal = options;
  frontal.azimuth = frontal.elevation = 0;
  const Skin skin = membrane_skin(membrane, shown, colors_of(values), line_width(shown));
  return {draw_on_white(skin, frontal), color_bar(ColorBy::kDisplacement, values)};
}

}  // namespace sprung
