#include "app/load/load_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>

#include "app/export/viewer.h"
#include "app/film/film_stage.h"
#include "core/body/stress.h"
#include "core/text.h"
#include "render/image/color_map.h"
#include "render/image/png.h"

namespace sprung {
namespace {

constexpr int kFrames = 9;
constexpr double kFrameRate = 6;  // frames/s

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '"') {
      safe += "&quot;";
    } else {
      safe += c;
    }
  }
  return safe;
}

/// The lines of text_of(): a name in the first columns, then what it is.
std::string table_of(const std::string& text) {
  constexpr std::size_t kColumn = 12;
  std::string rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto column = std::min(kColumn, line.size());
    rows +=
        fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", escaped(line.substr(0, column)), escaped(line.substr(column)));
  }
  return "<table>\n" + rows + "</table>\n";
}

std::string viewer_of(const PartReport& report, const PartSolution& coarse, double magnification) {
  const double highest = report.answer.von_mises ? report.answer.von_mises->value : 1;
  const std::vector<SoftBody>& bodies = coarse.simulation.world.bodies;
  std::vector<Skin> skins;
  AlignedBox box;
  for (const SoftBody& body : bodies) {
    const Eigen::VectorXd stress = von_mises(skin_stress(coarse, body));
    Skin skin = body.skin;
    skin.uvs.resize(0, 2);
    skin.parts.clear();
    skin.materials.clear();
    skin.colors.resize(stress.size(), 4);
    for (Eigen::Index row = 0; row < stress.size(); ++row) {
      skin.colors.row(row) << map_color(ColorMap::kTurbo, stress[row] / highest).transpose(), 1;
    }
    skins.push_back(std::move(skin));
    box.extend(bounding_box(body.skin_positions(body.rest_positions)));
  }
  ViewerFilm film;
  for (int frame = 0; frame < kFrames; ++frame) {
    const double share = magnification * frame / (kFrames - 1);
    std::vector<PosedMesh> meshes;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
      const SoftBody& body = bodies[row];
      const SkinShape shape = shape_of(body.grid, body.skin, body.skin_embedding,
                                       body.rest_positions + share * (body.positions - body.rest_positions));
      meshes.push_back({.name = fmt::format("body {}", row + 1),
                        .rest = &skins[row],
                        .positions = shape.positions.cast<double>(),
                        .normals = shape.normals.cast<double>().rowwise().normalized()});
    }
    film.add_frame(meshes);
  }
  constexpr double kAspect = 1.6;
  return film.page(kFrameRate, frame_bounds(box, kAspect), kAspect);
}

}  // namespace

std::string load_page(const PartReport& report, const PartSolution& coarse, const Image& picture,
                      double magnification) {
  const std::vector<std::uint8_t> png = encode_png(picture);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>{0} under load</title>\n<style>\n"
      "body {{ margin: 2em auto; max-width: 70em; padding: 0 1em; font: 16px/1.45 sans-serif; color: #1e2024; }}\n"
      "table {{ border-collapse: collapse; margin: 1em 0; }}\n"
      "th, td {{ text-align: left; vertical-align: top; padding: 0.15em 1.2em 0.15em 0; font-weight: normal; }}\n"
      "th {{ color: #5a6068; white-space: pre; }}\n"
      "img, iframe {{ width: 100%; border: 0; display: block; }}\niframe {{ aspect-ratio: 1.6; }}\n"
      "</style>\n</head>\n<body>\n<h1>{0} under load</h1>\n{1}<img alt=\"the loaded part, coloured by stress\" "
      "src=\"data:image/png;base64,{2}\">\n<h2>Turn it: displacements {3:g} times</h2>\n<iframe title=\"the part in "
      "three "
      "dimensions\" srcdoc=\"{4}\"></iframe>\n</body>\n</html>\n",
      escaped(report.part.loaded.name), table_of(text_of(report)), base64(std::as_bytes(std::span(png))), magnification,
      escaped(viewer_of(report, coarse, magnification)));
}

}  // namespace sprung
