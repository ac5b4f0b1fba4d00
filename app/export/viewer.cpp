#include "app/export/viewer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/bricks/brick_topology.h"
#include "core/text.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSteps = 65535;
constexpr int kColors = 256;  // of a map

template <class Items>
std::string text_of(const Items& items) {
  return base64(std::as_bytes(std::span(items.data(), std::size_t(items.size()))));
}

/// Quantises positions to whole steps from the low corner of everything in a take.
class Lattice {
 public:
  explicit Lattice(const ViewerTake& take) {
    extend(take.nodes);
    for (const ViewerMesh& mesh : take.meshes) extend(mesh.obstacle);
    step_ = std::max(box_.sizes().maxCoeff(), 1e-30) / kSteps;
  }

  /// All coordinates of all frames, 16 bits each, as base64.
  [[nodiscard]] std::string text(const std::vector<Floats3>& frames) const {
    std::vector<std::uint16_t> steps;
    for (const Floats3& frame : frames) {
      for (Eigen::Index i = 0; i < frame.size(); ++i) {
        const double place = (double(frame.data()[i]) - box_.min()[i % 3]) / step_;
        steps.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(place, 0.0, kSteps))));
      }
    }
    return text_of(steps);
  }

  [[nodiscard]] const AlignedBox& box() const { return box_; }
  [[nodiscard]] double step() const { return step_; }

 private:
  void extend(const std::vector<Floats3>& frames) {
    for (const Floats3& frame : frames) {
      if (frame.rows() == 0) continue;
      box_.extend(Vec3(frame.colwise().minCoeff().cast<double>()));
      box_.extend(Vec3(frame.colwise().maxCoeff().cast<double>()));
    }
  }

  AlignedBox box_;
  double step_ = 1;  // m
};

Json json_of(const Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// Its colours are sRGB bytes as base64.
Json json_of(const Legend& legend) {
  std::vector<std::uint8_t> colors;
  for (int i = 0; i < kColors; ++i) {
    for (const float channel : map_color(legend.map, double(i) / (kColors - 1))) {
      colors.push_back(static_cast<std::uint8_t>(std::lround(255 * channel)));
    }
  }
  return {{"title", legend.title}, {"low", legend.low}, {"high", legend.high}, {"colors", text_of(colors)}};
}

Json json_of(const ViewerMesh& mesh, const Lattice& lattice) {
  if (mesh.brick.empty()) return {{"obstacle", lattice.text(mesh.obstacle)}};
  return {{"brick", text_of(mesh.brick)}, {"local", text_of(mesh.local)}};
}

std::vector<std::array<int, 2>> edges_of(const std::vector<std::array<int, 8>>& bricks) {
  std::vector<std::array<int, 2>> edges;
  for (const std::array<int, 8>& corners : bricks) {
    for (const auto& [from, to] : kEdges) {
      edges.push_back({std::min(corners[from], corners[to]), std::max(corners[from], corners[to])});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

Json json_of(const ViewerTake& take) {
  const Lattice lattice(take);
  Json json{{"name", take.name},
            {"frames", take.at.size()},
            {"fps", take.fps},
            {"first_frame", take.first_frame},
            {"frame_step", take.frame_step},
            {"progress", take.progress},
            {"at", take.at},
            {"eye", json_of(take.camera.eye)},
            {"target", json_of(take.camera.target)},
            {"field_of_view", take.camera.vertical_field_of_view},
            {"aspect", take.aspect},
            {"low", json_of(lattice.box().min())},
            {"high", json_of(lattice.box().max())},
            {"step", lattice.step()},
            {"shown_field", take.shown_field},
            {"model", text_of(take.model)}};
  json["ground"] = take.ground ? Json(*take.ground) : Json();
  json["meshes"] = Json::array();
  for (const ViewerMesh& mesh : take.meshes) json["meshes"].push_back(json_of(mesh, lattice));
  json["nodes"] = lattice.text(take.nodes);
  json["bricks"] = text_of(take.bricks);
  json["edges"] = text_of(edges_of(take.bricks));
  json["fields"] = Json::array();
  for (const ViewerField& field : take.fields) {
    json["fields"].emplace_back(json_of(field.legend))["steps"] = text_of(field.steps);
  }
  if (take.spring_stretch) {
    json["springs"] = json_of(*take.spring_stretch);
    json["springs"]["pairs"] = text_of(take.springs);
    json["springs"]["rest"] = text_of(take.rest_lengths);
  }
  return json;
}

/// JSON escaped so that it cannot end the script element around it.
std::string in_script(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char letter : json) {
    if (letter == '<') {
      text += "\\u003c";
    } else {
      text += letter;
    }
  }
  return text;
}

}  // namespace

void ViewerField::add(const Eigen::VectorXd& coordinates) {
  for (const double coordinate : coordinates) {
    steps.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(coordinate, 0.0, 1.0))));
  }
}

int ViewerTake::add_bricks(const BrickGrid& grid, int first_node) {
  const auto first = int(bricks.size());
  for (std::array<int, 8> corners : grid.nodes) {
    for (int& node : corners) node += first_node;
    bricks.push_back(corners);
  }
  return first;
}

void ViewerTake::add_frame(const std::vector<Floats3>& bodies) {
  Eigen::Index count = 0;
  for (const Floats3& body : bodies) count += body.rows();
  Floats3& all = nodes.emplace_back(count, 3);
  Eigen::Index first = 0;
  for (const Floats3& body : bodies) {
    all.middleRows(first, body.rows()) = body;
    first += body.rows();
  }
}

void place_vertices(ViewerMesh& mesh, const std::vector<int>& rows, const Embedding& embedding, int first_brick) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    mesh.brick[rows[i]] = first_brick + embedding.brick[i];
    mesh.local.row(rows[i]) = embedding.local.row(Eigen::Index(i)).cast<float>();
  }
}

std::string viewer_page(std::span<const ViewerTake> takes) {
  const std::string_view page = viewer_template();
  const auto place = page.find(kViewerTakes);
  std::string text(page.substr(0, place));
  text += '[';
  for (const ViewerTake& take : takes) {
    if (&take != &takes.front()) text += ",\n";
    text += in_script(json_of(take).dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  text += ']';
  return text += page.substr(place + kViewerTakes.size());
}

}  // namespace sprung
