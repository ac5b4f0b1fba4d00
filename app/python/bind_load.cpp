#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/commands/make_scene.h"
#include "app/load/load_answer_text.h"
#include "app/load/part_study.h"
#include "app/python/bindings.h"
#include "core/error.h"

namespace py = pybind11;

namespace sprung {
namespace {

using MeshOrFile = std::variant<std::filesystem::path, SurfaceMesh>;
using OneOrMany = std::variant<std::string, std::vector<std::string>>;

std::vector<std::string> list_of(const OneOrMany& texts) {
  if (const auto* one = std::get_if<std::string>(&texts)) return {*one};
  return std::get<std::vector<std::string>>(texts);
}

class SignalObserver : public Observer {
 public:
  void check_interrupt() const override { check_signals(); }
};

PartAnalysis analysis_from(const std::string& name) {
  if (name == "auto") return PartAnalysis::kAuto;
  if (name == "linear") return PartAnalysis::kLinear;
  if (name == "nonlinear") return PartAnalysis::kNonlinear;
  throw Error(ErrorKind::kBadInput, "analysis is 'auto', 'linear' or 'nonlinear', not '" + name + "'");
}

bool is_z_up(const MeshOrFile& mesh, const std::optional<std::string>& up) {
  if (up && *up != "y" && *up != "z") throw Error(ErrorKind::kBadInput, "up is 'y' or 'z', not '" + *up + "'");
  if (up) return *up == "z";
  const auto* file = std::get_if<std::filesystem::path>(&mesh);
  return file != nullptr && usual_up(*file) == UpAxis::kZ;
}

py::object load(MeshOrFile mesh, const OneOrMany& fix, const OneOrMany& loads,
                const std::variant<std::string, Material>& material, const std::string& unit,
                const std::optional<int>& bricks, const std::vector<Vec3>& at, const std::string& analysis, int modes,
                bool buckling, const std::optional<std::string>& up) {
  PartQuestion question{.unit = unit,
                        .is_z_up = is_z_up(mesh, up),
                        .fixes = list_of(fix),
                        .loads = list_of(loads),
                        .points = at,
                        .analysis = analysis_from(analysis),
                        .modes = modes,
                        .buckling = buckling};
  if (auto* surface = std::get_if<SurfaceMesh>(&mesh)) {
    question.body.surface = std::make_shared<const SurfaceMesh>(std::move(*surface));
  } else {
    question.body.mesh = std::filesystem::absolute(std::get<std::filesystem::path>(mesh));
  }
  const auto* name = std::get_if<std::string>(&material);
  question.body.material =
      name != nullptr ? built_in_materials()->find(*name).material() : std::get<Material>(material);
  if (bricks) question.body.bricks = *bricks;
  std::string json;
  {
    const py::gil_scoped_release release;
    const PartStudy study = study_part(question, SignalObserver());
    const LibraryMaterial* known = built_in_materials()->find_if_known(question.body.material.name);
    const PartLimits limits;
    const PartVerdict verdict = judge(study.answer, known, limits);
    json = json_of(PartReport{study.part, study.loads, study.answer, known, verdict, limits});
  }
  return py::module_::import("json").attr("loads")(json);
}

}  // namespace

void bind_load(py::module_& module) {
  module.def(
      "load", &load, py::arg("mesh"), py::arg("fix"), py::arg("load"), py::arg("material") = kUsualPartMaterial,
      py::arg("unit") = "", py::arg("bricks") = py::none(), py::arg("at") = std::vector<Vec3>(),
      py::arg("analysis") = "auto", py::arg("modes") = 0, py::arg("buckling") = false, py::arg("up") = py::none(),
      "How far a part bends and whether it holds: what sprung load --json prints. mesh: a file, or a Mesh; fix, "
      "load: one or several, as for sprung load; unit: of the mesh, mm unless it is glTF; bricks: along its "
      "longest side; at: (k, 3) units of the mesh, points to answer at; analysis: 'auto', 'linear', 'nonlinear'; "
      "modes: how many vibrations; buckling: whether to find its load; up: 'y' or 'z'.");
}

}  // namespace sprung
