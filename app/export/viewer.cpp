#include "app/export/viewer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/io/animation.h"
#include "core/text.h"

namespace sprung {
namespace {

constexpr double kSteps = 65535;

/// All coordinates of all frames in steps from `low`, 16 bits each, as base64.
std::string text_of(const std::vector<Floats3>& frames, const Vec3& low, double step) {
  std::vector<std::uint16_t> steps;
  for (const Floats3& frame : frames) {
    for (Eigen::Index i = 0; i < frame.size(); ++i) {
      const double place = (double(frame.data()[i]) - low[i % 3]) / step;
      steps.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(place, 0.0, kSteps))));
    }
  }
  return base64(std::as_bytes(std::span(steps)));
}

std::string list_of(const Vec3& vector) { return fmt::format("[{}, {}, {}]", vector.x(), vector.y(), vector.z()); }

}  // namespace

void ViewerFilm::add_frame(const std::vector<PosedMesh>& meshes) {
  if (frames_.empty()) {
    model_ = static_glb(meshes);
    frames_.resize(meshes.size());
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) frames_[i].emplace_back(meshes[i].positions.cast<float>());
}

std::string ViewerFilm::page(double fps, const Camera& camera, double aspect) const {
  AlignedBox box;
  for (const std::vector<Floats3>& frames : frames_) {
    for (const Floats3& frame : frames) {
      box.extend(Vec3(frame.colwise().minCoeff().cast<double>()));
      box.extend(Vec3(frame.colwise().maxCoeff().cast<double>()));
    }
  }
  const double step = std::max(box.sizes().maxCoeff(), 1e-30) / kSteps;
  std::vector<std::string> positions;
  for (const std::vector<Floats3>& frames : frames_) positions.push_back(text_of(frames, box.min(), step));
  const std::string film = fmt::format(
      "{{\"frames\": {}, \"fps\": {}, \"eye\": {}, \"target\": {}, \"field_of_view\": {}, \"aspect\": {}, \"low\": {}, "
      "\"size\": {}, \"step\": {},\n\"model\": \"{}\",\n\"positions\": [\"{}\"]}}",
      frames_.empty() ? 0 : frames_.front().size(), fps, list_of(camera.eye), list_of(camera.target),
      camera.vertical_field_of_view, aspect, list_of(box.min()), box.diagonal().norm(), step,
      base64(std::as_bytes(std::span(model_))), fmt::join(positions, "\",\n\""));
  const std::string_view page = viewer_page();
  const auto place = page.find(kViewerFilm);
  std::string text(page.substr(0, place));
  text += film;
  return text += page.substr(place + kViewerFilm.size());
}

}  // namespace sprung
