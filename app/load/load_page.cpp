#include "app/load/load_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <sstream>

#include "app/export/viewer.h"
#include "app/film/film_stage.h"
#include "core/body/stress.h"
#include "core/io/animation.h"
#include "core/text.h"
#include "render/image/color_map.h"
#include "render/image/png.h"

namespace sprung {
namespace {

constexpr int kFrames = 9;
constexpr double kFrameRate = 6;  // frames/s
constexpr double kAspect = 1.6;   // of the turning view

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
  constexpr double kMega = 1e6;
  const double highest = report.answer.von_mises ? report.answer.von_mises->value : 1;
  const std::vector<SoftBody>& bodies = coarse.simulation.world.bodies;
  ViewerTake take;
  take.name = report.part.loaded.name;
  take.fps = kFrameRate;
  take.progress = "load";
  take.aspect = kAspect;
  take.shown_field = 0;
  ViewerField& field = take.fields.emplace_back();
  field.legend.title = "von Mises stress, MPa";
  field.legend.map = ColorMap::kTurbo;
  field.legend.high = highest / kMega;
  for (int frame = 0; frame < kFrames; ++frame) take.at.push_back(double(frame) / (kFrames - 1));
  const StrainMeasure measure = strain_measure(coarse.scene);
  std::vector<PosedMesh> meshes;
  AlignedBox box;
  int nodes = 0;
  for (const SoftBody& body : bodies) {
    const int first_brick = take.add_bricks(body.grid, nodes);
    nodes += body.node_count();
    field.add(von_mises(recover_stress(body, body.positions, measure)) / highest);
    const Points positions = body.skin_positions(body.rest_positions);
    const Eigen::Index count = positions.rows();
    ViewerMesh& mesh = take.meshes.emplace_back();
    mesh.brick.resize(count);
    mesh.local.resize(count, 3);
    std::vector<int> rows(count);
    std::iota(rows.begin(), rows.end(), 0);
    place_vertices(mesh, rows, body.drawn.embedding, first_brick);
    meshes.push_back({.name = fmt::format("body {}", take.meshes.size()),
                      .rest = &body.drawn.skin,
                      .positions = positions,
                      .normals = body.drawn.skin.normals});
    box.extend(bounding_box(positions));
  }
  for (const double share : take.at) {
    std::vector<Floats3> moved;
    for (const SoftBody& body : bodies) {
      const Points way = body.positions - body.rest_positions;
      moved.emplace_back((body.rest_positions + magnification * share * way).cast<float>());
    }
    take.add_frame(moved);
  }
  take.camera = frame_bounds(box, kAspect);
  take.model = static_glb(meshes);
  return viewer_page({&take, 1});
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
