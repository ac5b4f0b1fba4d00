#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>

#include "app/python/bindings.h"
#include "app/scene/cached_film.h"
#include "app/scene/carrying_material.h"
#include "app/scene/scene_file.h"
#include "app/scene/scene_values.h"
#include "core/error.h"
#include "core/files.h"
#include "core/simulation/simulate.h"

namespace py = pybind11;

namespace sprung {
namespace {

std::string toml_of(const py::handle& value);

std::string table_of(const py::dict& table) {
  std::string text;
  for (const auto& [key, value] : table) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", py::str(key).cast<std::string>(), toml_of(value));
  }
  return "{ " + text + " }";
}

/// A Python value as TOML.
std::string toml_of(const py::handle& value) {
  if (py::isinstance<Material>(value)) {
    const auto& material = value.cast<const Material&>();
    return fmt::format("{{ young = {}, poisson = {}, density = {}, damping = {} }}", material.young, material.poisson,
                       material.density, material.damping);
  }
  if (py::isinstance<py::dict>(value)) return table_of(py::reinterpret_borrow<py::dict>(value));
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value)) return fmt::format("{}", value.cast<long>());
  if (py::isinstance<py::float_>(value)) return py::repr(value).cast<std::string>();
  if (py::isinstance<py::str>(value)) return toml_text(value.cast<std::string>());
  if (py::hasattr(value, "__fspath__")) {
    return toml_text(value.attr("__fspath__")().cast<std::string>());
  }
  if (py::hasattr(value, "tolist")) return toml_of(value.attr("tolist")());  // of NumPy
  if (py::isinstance<py::sequence>(value)) {
    std::string text;
    for (const py::handle item : value) text += (text.empty() ? "" : ", ") + toml_of(item);
    return "[" + text + "]";
  }
  throw Error(ErrorKind::kBadInput,
              fmt::format("a scene has no value like {}; give numbers, texts, lists and dicts of them",
                          py::repr(value).cast<std::string>()));
}

Film parse_dict(const py::dict& keys) {
  std::string text;
  for (const auto& [key, value] : keys) {
    text += fmt::format("{} = {}\n", py::str(key).cast<std::string>(), toml_of(value));
  }
  return parse_scene(text, std::filesystem::current_path() / "scene");
}

/// The result of simulate() or read_run().
struct SceneRun {
  Film film;
  Simulation simulation;
  Recording recording;
};

/// Lets Ctrl-C end a simulation.
class PythonObserver : public Observer {
 public:
  void check_interrupt() const override { check_signals(); }
};

std::shared_ptr<SceneRun> read_run(const std::filesystem::path& file) {
  const CacheReader cache(file);
  Film film = cached_film(cache.header());
  Simulation simulation = cached_simulation(cache.header(), film);
  Recording recording = cached_recording(cache);
  if (cache.frame_count() > 0) recording.state_hash = cache.frame(cache.frame_count() - 1).state_hash;
  return std::make_shared<SceneRun>(SceneRun{std::move(film), std::move(simulation), std::move(recording)});
}

std::shared_ptr<SceneRun> run_scene(const py::object& scene, const std::optional<std::filesystem::path>& cache,
                                    bool resume) {
  Film film = film_from(scene);
  const py::gil_scoped_release release;
  const PythonObserver observer;
  std::optional<RunCache> file;
  if (cache) file.emplace(*cache, record_of(film), resume);
  auto run = std::make_shared<SceneRun>(SceneRun{.film = std::move(film), .simulation = {}, .recording = {}});
  run->simulation = prepare_simulation(run->film, observer);
  run->recording = simulate(run->simulation, run->film, observer, file ? &*file : nullptr);
  if (!file) return run;
  file->close();
  return read_run(*cache);
}

std::size_t row_of(const SceneRun& run, long frame) {
  const long count = long(run.recording.frames.size());
  if (frame < -count || frame >= count) {
    throw Error(ErrorKind::kBadInput, fmt::format("there is no frame {}: they are 0 to {}", frame, count - 1));
  }
  return frame < 0 ? frame + count : frame;
}

std::vector<Points> run_positions_of(const SceneRun& run, long frame) {
  std::vector<Points> bodies;
  for (const Floats3& nodes : run.recording.frames[row_of(run, frame)]) bodies.emplace_back(nodes.cast<double>());
  return bodies;
}

std::vector<Points> skins_of(const SceneRun& run, long frame) {
  std::vector<Points> skins;
  const std::vector<Points> nodes = run_positions_of(run, frame);
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    skins.push_back(run.simulation.world.bodies[row].skin_positions(nodes[row]));
  }
  return skins;
}

std::vector<Triangles> run_triangles_of(const SceneRun& run) {
  std::vector<Triangles> triangles;
  for (const SoftBody& body : run.simulation.world.bodies) triangles.push_back(body.skin.triangles);
  return triangles;
}

/// By probe, then by quantity: (frames, 3).
py::dict probes_of(const SceneRun& run) {
  py::dict probes;
  for (const ProbeTrack& track : run.recording.probes) {
    py::dict measured;
    for (const auto& [name, member] :
         {std::pair{"position", &ProbeSample::position}, std::pair{"displacement", &ProbeSample::displacement},
          std::pair{"force", &ProbeSample::force}, std::pair{"torque", &ProbeSample::torque}}) {
      Points rows(track.samples.size(), 3);
      for (std::size_t i = 0; i < track.samples.size(); ++i) rows.row(i) = track.samples[i].*member;
      measured[name] = rows;
    }
    probes[py::str(track.name)] = measured;
  }
  return probes;
}

}  // namespace

Film film_from(const py::object& scene) {
  Film film = py::isinstance<py::dict>(scene) ? parse_dict(scene.cast<py::dict>())
                                              : read_scene(scene.cast<std::filesystem::path>());
  choose_materials(film, PythonObserver());
  return film;
}

SceneBody body_from(const py::dict& keys) {
  if (keys.empty()) return default_body();
  py::dict body(keys);
  for (const char* name : {"mesh", "material", "size", "bricks", "position", "model"}) {
    if (body.contains(name)) throw Error(ErrorKind::kBadInput, fmt::format("'{}' is given twice", name));
  }
  body["box"] = std::array<double, 3>{1, 1, 1};  // stands for the mesh, which may have no file
  py::dict scene;
  scene["body"] = py::make_tuple(body);
  SceneBody parsed = parse_dict(scene).bodies.front();
  parsed.box.reset();
  return parsed;
}

void check_signals() {
  const py::gil_scoped_acquire python;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void bind_scene(py::module_& module) {
  py::class_<SceneRun, std::shared_ptr<SceneRun>>(module, "Run", "The frames of a scene.")
      .def_property_readonly(
          "frame_count", [](const SceneRun& run) { return run.recording.frames.size(); }, "How many frames there are.")
      .def_property_readonly(
          "progress",
          [](const SceneRun& run) {
            return Eigen::VectorXd(
                Eigen::Map<const Eigen::VectorXd>(run.recording.progress.data(), isize(run.recording.progress)));
          },
          "(frames,) time, s, or share of the load, or number of the mode, 1.")
      .def_property_readonly(
          "frequencies", [](const SceneRun& run) { return run.recording.frequencies; }, "(modes,) Hz.")
      .def_property_readonly(
          "state_hash", [](const SceneRun& run) { return run.recording.state_hash; },
          "Of every bit of the last state, as sprung simulate prints it.")
      .def("positions", &run_positions_of, py::arg("frame"),
           "By body: (m, 3) m, of the nodes in a frame, from 0; -1 is the last.")
      .def("skin_positions", &skins_of, py::arg("frame"), "By body: (v, 3) m.")
      .def_property_readonly("triangles", &run_triangles_of, "By body: (t, 3) rows of skin_positions().")
      .def_property_readonly("probes", &probes_of,
                             "By name: position, displacement, m; force, N; torque, N m; each (frames, 3).");
  module.def("simulate", &run_scene, py::arg("scene"), py::arg("cache") = py::none(), py::arg("resume") = false,
             "Computes all frames of a scene, as sprung simulate does. scene: a TOML file, or a dict of the same "
             "keys; cache: an HDF5 file to keep the frames in; resume: continues the run in it.");
  module.def("read_run", &read_run, py::arg("cache"), py::call_guard<py::gil_scoped_release>(),
             "The run in a cache, as sprung simulate wrote it.");
}

}  // namespace sprung
