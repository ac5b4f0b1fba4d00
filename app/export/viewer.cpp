#include "app/export/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "app/export/viewer_page.h"
#include "app/report/png_base64.h"

namespace sprung {
namespace {

constexpr double kSteps = 65535;

/// Of each vertex: its own colour, or that of the part which uses it.
std::vector<std::uint8_t> colors_of(const PosedMesh& mesh) {
  Floats3 colors = mesh.color.transpose().replicate(mesh.positions.rows(), 1);
  for (const PosedPart& part : parts_of(mesh)) {
    const auto triangles = mesh.rest->triangles.middleRows(part.first_triangle, part.triangle_count);
    for (const auto& triangle : triangles.rowwise()) {
      for (const int vertex : triangle) colors.row(vertex) = part.color.head<3>();
    }
  }
  if (mesh.rest->colors.rows() > 0) colors = mesh.rest->colors.leftCols<3>();
  std::vector<std::uint8_t> bytes;
  bytes.reserve(static_cast<std::size_t>(colors.size()));
  for (const float value : colors.reshaped<Eigen::RowMajor>()) {
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F))));
  }
  return bytes;
}

template <class Value>
std::string text_of(std::span<const Value> values) {
  return base64(std::as_bytes(values));
}

}  // namespace

void ViewerFilm::add_frame(const std::vector<PosedMesh>& meshes) {
  if (meshes_.empty()) {
    for (const PosedMesh& mesh : meshes) {
      meshes_.push_back({.triangles = mesh.rest->triangles, .colors = colors_of(mesh), .frames = {}});
    }
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) meshes_[i].frames.emplace_back(meshes[i].positions.cast<float>());
}

std::string ViewerFilm::mesh_text(std::size_t mesh, const Vec3& low, double step) const {
  const Mesh& shown = meshes_[mesh];
  std::vector<std::uint16_t> steps;
  for (const Floats3& frame : shown.frames) {
    for (Eigen::Index i = 0; i < frame.size(); ++i) {
      const double place = (static_cast<double>(frame.data()[i]) - low[i % 3]) / step;
      steps.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(place, 0.0, kSteps))));
    }
  }
  const std::span<const int> triangles(shown.triangles.data(), static_cast<std::size_t>(shown.triangles.size()));
  return fmt::format("{{triangles: \"{}\", colors: \"{}\", positions: \"{}\"}}", text_of(triangles),
                     text_of(std::span<const std::uint8_t>(shown.colors)),
                     text_of(std::span<const std::uint16_t>(steps)));
}

std::string ViewerFilm::page(double fps, double azimuth, double elevation) const {
  Eigen::AlignedBox3d box;
  for (const Mesh& mesh : meshes_) {
    for (const Floats3& frame : mesh.frames) {
      box.extend(Vec3(frame.colwise().minCoeff().cast<double>()));
      box.extend(Vec3(frame.colwise().maxCoeff().cast<double>()));
    }
  }
  const Vec3 low = box.min();
  const Vec3 high = box.max();
  const double step = std::max(box.sizes().maxCoeff(), 1e-30) / kSteps;
  std::string meshes;
  for (std::size_t i = 0; i < meshes_.size(); ++i) meshes += (i == 0 ? "" : ",\n") + mesh_text(i, low, step);
  const double degree = std::numbers::pi / 180;
  const std::string film = fmt::format(
      "{{frames: {}, fps: {}, azimuth: {}, elevation: {}, low: [{}, {}, {}], high: [{}, {}, {}], step: {},\n"
      "meshes: [{}]}}",
      meshes_.empty() ? 0 : meshes_.front().frames.size(), fps, azimuth * degree, elevation * degree, low.x(), low.y(),
      low.z(), high.x(), high.y(), high.z(), step, meshes);
  const auto place = kViewerPage.find(kViewerFilm);
  std::string page(kViewerPage.substr(0, place));
  page += film;
  return page += kViewerPage.substr(place + kViewerFilm.size());
}

}  // namespace sprung
