// Writes what a frame of a film shows in a form that other renderers can be given: stage.json with the camera, the
// light, the floor and the bodies, and beside it files of plain 32-bit floats and integers: the bodies' meshes in world
// metres, and the light around them as a panorama. Arguments: the cache (.h5), the frame (counted from 1), the width
// and the height of the picture, the folder.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/film/film_cameras.h"
#include "app/film/film_pipeline.h"
#include "app/film/film_stage.h"
#include "app/film/matte_names.h"
#include "app/scene/cached_film.h"
#include "core/error.h"
#include "render/stage/stage_space.h"
#include "render/stage/visible_sides.h"
#include "render/trace/finish.h"
#include "render/trace/medium.h"
#include "render/trace/skin_paint.h"
#include "render/trace/stage_light.h"

namespace {

using namespace sprung;
using Eigen::Vector3f;
using nlohmann::json;
namespace fs = std::filesystem;

constexpr int kPanoramaHeight = 512;

const char* name_of(Look look) {
  switch (look) {
    case Look::kPlastic:
      return "plastic";
    case Look::kGelatin:
      return "gelatin";
    case Look::kRubber:
      return "rubber";
    case Look::kSteel:
      return "steel";
    case Look::kChart:
      return "chart";
  }
  return "";
}

template <class T>
json listed(const T& vector) {
  return {vector[0], vector[1], vector[2]};
}

template <class Scalar>
void write_raw(const std::vector<Scalar>& values, const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()), std::streamsize(values.size() * sizeof(Scalar)));
  if (!out) throw Error(ErrorKind::kFailed, fmt::format("'{}' cannot be written", file.string()));
}

/// Corners of triangles in the order that makes them face outwards.
Triangles outward(const Skin& skin) {
  Triangles triangles = skin.triangles;
  if (visible_sides(skin) == Sides::kBack) triangles.col(1).swap(triangles.col(2));
  return triangles;
}

/// Linear, of each corner of each triangle.
std::vector<float> corner_colors(const Skin& skin, const SkinPaint& paint, const Triangles& triangles) {
  std::vector<float> colors;
  for (int t = 0; t < int(triangles.rows()); ++t) {
    for (int k = 0; k < 3; ++k) {
      Vector3f weights = Vector3f::Zero();
      for (int corner = 0; corner < 3; ++corner) {
        if (skin.triangles(t, corner) == triangles(t, k)) weights[corner] = 1;
      }
      const Vector3f color = paint.color(t, weights / weights.sum(), {});
      colors.insert(colors.end(), color.begin(), color.end());
    }
  }
  return colors;
}

template <class Matrix>
std::vector<typename Matrix::Scalar> row_by_row(const Matrix& matrix) {
  std::vector<typename Matrix::Scalar> values;
  for (const auto& row : matrix.rowwise()) values.insert(values.end(), row.begin(), row.end());
  return values;
}

/// 1/m, of a body of one colour.
json medium_of(const Vector3f& color, double mean_free_path) {
  const Medium medium(color, float(1 / mean_free_path));
  return {{"scattering", medium.scattering}, {"absorption", listed(medium.absorption)}, {"index", Medium::kIndex}};
}

/// m, of each corner and colour: the mean free path to a scattering or an absorption.
std::vector<float> extinction_lengths(const std::vector<float>& colors, double mean_free_path) {
  std::vector<float> lengths;
  for (std::size_t i = 0; i < colors.size(); i += 3) {
    const Medium medium({colors[i], colors[i + 1], colors[i + 2]}, float(1 / mean_free_path));
    for (const float absorption : medium.absorption) lengths.push_back(1 / (medium.scattering + absorption));
  }
  return lengths;
}

Vector3f mean_of(const std::vector<float>& colors) {
  Vector3f sum = Vector3f::Zero();
  for (std::size_t i = 0; i < colors.size(); ++i) sum[Eigen::Index(i % 3)] += colors[i];
  return sum / (float(colors.size()) / 3);
}

json describe_body(const Stage& stage, std::size_t i, const SkinShape& shape, const fs::path& folder) {
  const Skin& skin = *stage.skins[i];
  TexturePictures pictures;
  const SkinPaint paint(skin, stage.default_colors[i], stage.color_map, pictures);
  const Triangles triangles = outward(skin);
  const std::vector<float> colors = corner_colors(skin, paint, triangles);
  const Floats3 normals = shape.normals.array().colwise() / shape.normals.rowwise().norm().array().max(1e-12F);
  const std::string stem = fmt::format("body_{}", stage.ids[i]);
  write_raw(row_by_row(shape.positions), folder / (stem + "_positions.raw"));
  write_raw(row_by_row(normals), folder / (stem + "_normals.raw"));
  write_raw(row_by_row(triangles), folder / (stem + "_triangles.raw"));
  write_raw(colors, folder / (stem + "_colors.raw"));
  const Finish::Properties finish = Finish::properties(stage.looks[i]);
  const bool is_entered = stage.mean_free_paths[i] > 0 && visible_sides(skin) != Sides::kBoth;
  json body = {{"id", stage.ids[i]},
               {"stem", stem},
               {"vertices", shape.positions.rows()},
               {"triangles", triangles.rows()},
               {"look", name_of(stage.looks[i])},
               {"roughness", finish.roughness},
               {"glow", finish.glow},
               {"is_translucent", is_entered}};
  if (is_entered) {
    write_raw(extinction_lengths(colors, stage.mean_free_paths[i]), folder / (stem + "_extinction_lengths.raw"));
    body["medium"] = medium_of(mean_of(colors), stage.mean_free_paths[i]);
  }
  return body;
}

/// Rows from straight up to straight down; columns around the vertical, the first and the last towards -x, the middle
/// towards x, a quarter towards -z.
void write_panorama(const StageLight& light, const fs::path& file) {
  constexpr double kPi = std::numbers::pi;
  std::vector<float> panorama;
  for (int row = 0; row < kPanoramaHeight; ++row) {
    const double elevation = kPi * (0.5 - (row + 0.5) / kPanoramaHeight);
    for (int column = 0; column < 2 * kPanoramaHeight; ++column) {
      const double turn = 2 * kPi * (0.5 - (column + 0.5) / (2 * kPanoramaHeight));
      const Vec3 direction(std::cos(turn) * std::cos(elevation), std::sin(elevation),
                           -std::sin(turn) * std::cos(elevation));
      const Vector3f radiance = light.around(direction.cast<float>());
      panorama.insert(panorama.end(), radiance.begin(), radiance.end());
    }
  }
  write_raw(panorama, file);
}

json describe_light(const Lighting& lighting, const StageLight& light, const fs::path& folder) {
  const double radius = lighting.key_radius;
  write_panorama(light, folder / "panorama.raw");
  return {{"to_key", listed(lighting.to_key())},
          {"key", listed(light.on_facing_key())},  // irradiance over pi, facing it
          {"key_angle", 2 * std::atan(radius)},
          {"panorama_height", kPanoramaHeight},
          {"on_open_floor", listed(light.on_open_floor())}};
}

json describe_camera(const Camera& camera) {
  return {{"eye", listed(camera.eye)},
          {"target", listed(camera.target)},
          {"up", listed(camera.up)},
          {"vertical_field_of_view", camera.vertical_field_of_view},
          {"orthographic", camera.orthographic},
          {"shift", camera.shift}};
}

json describe_bodies(const Stage& stage, const std::vector<SkinShape>& shapes, const std::vector<std::string>& names,
                     const fs::path& folder) {
  json bodies = json::array();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const int id = stage.ids[i];
    if (stage.ghosts[i] || id == 0) continue;
    json body = describe_body(stage, i, shapes[i], folder);
    body["name"] = names[std::size_t(id)];
    bodies.push_back(std::move(body));
  }
  return bodies;
}

void describe(const std::string& file, std::size_t frame, int width, int height, const fs::path& folder) {
  const CacheReader cache(file);
  if (frame < 1 || frame > cache.frame_count()) {
    throw Error(ErrorKind::kUsage,
                fmt::format("there is no frame {} in '{}': it has 1 to {}", frame, file, cache.frame_count()));
  }
  Film scene = cached_film(cache.header());
  scene.render.resolution = {width, height};
  if (scene.render.color_by != Field::kSkin || scene.render.springs) {
    throw Error(ErrorKind::kUsage, "colours that show a field are no light; simulate without render.color_by");
  }
  const Simulation simulation = cached_simulation(cache.header(), scene);
  const Recording recording = cached_recording(cache, scene);
  const Reach reach = reach_of(simulation, recording);
  const std::vector<Camera> cameras = cameras_of(scene, reach, 0);
  double finest = 0;
  for (const Camera& camera : cameras) finest = std::max(finest, pixels_per_metre(camera, height));
  const FilmStage film(scene, simulation, recording, 1 / finest);
  const Stage stage = film.stage(reach.bounds, read_surroundings(scene.render));
  const StageSpace space(reach.bounds);

  fs::create_directories(folder);
  const StageLight light(stage);
  json description = {
      {"camera", describe_camera(cameras[frame - 1])},
      {"light", describe_light(lighting_of(stage), light, folder)},
      {"bodies", describe_bodies(stage, film.shapes(frame - 1), matte_names(scene, simulation), folder)},
      {"center", listed(space.center)},
      {"size", 1 / space.scale}};
  if (stage.has_ground) {
    description["floor"] = {{"height", stage.ground.height}, {"albedo", listed(light.floor_albedo())}};
  }
  std::ofstream(folder / "stage.json") << description.dump(1) << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    fmt::print(stderr, "usage: describe_stage FILM.h5 FRAME WIDTH HEIGHT FOLDER\n");
    return 2;
  }
  try {
    describe(argv[1], std::size_t(std::atoi(argv[2])), std::atoi(argv[3]), std::atoi(argv[4]), argv[5]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "describe_stage: {}\n", error.what());
    return 1;
  }
}
