#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "app/python/bindings.h"
#include "app/scene/cached_film.h"
#include "app/scene/scene_file.h"
#include "app/scene/scene_values.h"
#include "app/scene/supporting_material.h"
#include "core/error.h"
#include "core/files.h"
#include "core/simulation/simulate.h"

namespace py = pybind11;

namespace sprung {
namespace {

/// A scene dict as TOML, and where in it each value is.
class DictText {
 public:
  explicit DictText(const py::dict& keys) {
    for (const auto& [key, value] : keys) {
      const std::string name = py::str(key).cast<std::string>();
      text_ += name + " = ";
      write(value, name);
      text_ += "\n";
    }
  }

  [[nodiscard]] const std::string& text() const { return text_; }

  /// "body[1].pin[0].box": the path of what is at a line and a column (from 1).
  [[nodiscard]] std::string path_at(std::size_t line, std::size_t column) const {
    std::size_t offset = 0;
    for (; line > 1; --line) offset = text_.find('\n', offset) + 1;
    offset += column - 1;
    const auto beyond = std::upper_bound(places_.begin(), places_.end(), offset,
                                         [](std::size_t index, const auto& known) { return index < known.first; });
    return beyond == places_.begin() ? "scene" : std::prev(beyond)->second;
  }

 private:
  void write_table(const py::dict& table, const std::string& path) {
    text_ += "{ ";
    bool is_first = true;
    for (const auto& [key, value] : table) {
      const std::string name = py::str(key).cast<std::string>();
      text_ += (std::exchange(is_first, false) ? "" : ", ");
      const std::string below = fmt::format("{}.{}", path, name);
      places_.emplace_back(text_.size(), below);
      text_ += name + " = ";
      write(value, below);
    }
    text_ += " }";
  }

  void write(const py::handle& value, const std::string& path) {
    places_.emplace_back(text_.size(), path);
    if (py::isinstance<Material>(value)) {
      const auto& material = value.cast<const Material&>();
      const std::string in_motion =
          material.poisson_in_motion ? fmt::format(", poisson_in_motion = {}", *material.poisson_in_motion) : "";
      text_ += fmt::format("{{ young = {}, poisson = {}{}, density = {}, damping = {}, law = \"{}\"{} }}",
                           material.young, material.poisson, in_motion, material.density, material.damping,
                           law_name(material.law.kind), parameters_text(material.law));
    } else if (py::isinstance<py::dict>(value)) {
      write_table(py::reinterpret_borrow<py::dict>(value), path);
    } else if (py::isinstance<py::bool_>(value)) {
      text_ += value.cast<bool>() ? "true" : "false";
    } else if (py::isinstance<py::int_>(value)) {
      text_ += fmt::format("{}", value.cast<long>());
    } else if (py::isinstance<py::float_>(value)) {
      text_ += py::repr(value).cast<std::string>();
    } else if (py::isinstance<py::str>(value)) {
      text_ += toml_text(value.cast<std::string>());
    } else if (py::hasattr(value, "__fspath__")) {
      text_ += toml_text(value.attr("__fspath__")().cast<std::string>());
    } else if (py::hasattr(value, "tolist")) {  // of NumPy
      write(value.attr("tolist")(), path);
    } else if (py::isinstance<py::sequence>(value)) {
      write_list(value, path);
    } else {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: a scene has no value like {}; give numbers, texts, lists and dicts of them", path,
                              py::repr(value).cast<std::string>()));
    }
  }

  void write_list(const py::handle& items, const std::string& path) {
    text_ += "[";
    std::size_t row = 0;
    for (const py::handle item : items) {
      text_ += row > 0 ? ", " : "";
      write(item, fmt::format("{}[{}]", path, row++));
    }
    text_ += "]";
  }

  std::string text_;
  std::vector<std::pair<std::size_t, std::string>> places_;  // by offset in the text, ascending
};

/// The mistakes in a scene, "FILE:LINE:COLUMN: what", each with the path of its key instead of its position.
std::string with_paths(const std::string& mistakes, const std::string& file, const DictText& scene) {
  std::string text;
  std::istringstream lines(mistakes);
  for (std::string line; std::getline(lines, line);) {
    std::size_t row = 0;
    std::size_t column = 0;
    int end = 0;
    const bool has_place = line.starts_with(file + ":") &&
                           std::sscanf(line.c_str() + file.size(), ":%zu:%zu: %n", &row, &column, &end) == 2 && end > 0;
    if (!text.empty()) text += '\n';
    const std::string what = has_place ? line.substr(file.size() + std::size_t(end)) : line;
    const std::string path = has_place ? scene.path_at(row, column) + ": " : "";
    text += what.starts_with(path) ? what : path + what;
  }
  return text;
}

Film parse_dict(const py::dict& keys) {
  const DictText scene(keys);
  const std::filesystem::path file = std::filesystem::current_path() / "scene";
  try {
    return parse_scene(scene.text(), file);
  } catch (const Error& error) {
    throw Error(error.kind(), with_paths(error.what(), file.string(), scene));
  }
}

/// Indexed by frame, then by body: m x 3.
using Frames = std::vector<std::vector<Points>>;

/// The result of simulate() or read_run().
struct SceneRun {
  Film film;
  Simulation simulation;
  Recording recording;
  Frames positions;   // m
  Frames velocities;  // m/s
};

/// Lets Ctrl-C end a simulation and reports it to Python.
class PythonObserver : public Observer {
 public:
  PythonObserver() = default;
  PythonObserver(py::object progress, py::object on_frame, SceneRun* run)
      : progress_(std::move(progress)), on_frame_(std::move(on_frame)), run_(run) {}

  void check_interrupt() const override { check_signals(); }

  void show(const Progress& progress) const override {
    constexpr auto kBetween = std::chrono::milliseconds(100);
    const auto now = std::chrono::steady_clock::now();
    if (progress_.is_none() || now - shown_ < kBetween) return;
    shown_ = now;
    const double share = progress.total() > 0 ? progress.done() / progress.total() : 0;
    const py::gil_scoped_acquire python;
    progress_(progress.name(), share, progress.seconds_to_go());
  }

  void finish_frame(int frame, double progress, const World& world) const override {
    if (run_ == nullptr) return;
    std::vector<Points> positions;
    std::vector<Points> velocities;
    for (const SoftBody& body : world.bodies) {
      positions.push_back(body.positions);
      velocities.push_back(body.velocities);
    }
    if (!on_frame_.is_none()) {
      const py::gil_scoped_acquire python;
      on_frame_(frame, progress, positions);
    }
    run_->positions.push_back(std::move(positions));
    run_->velocities.push_back(std::move(velocities));
  }

 private:
  py::object progress_ = py::none();
  py::object on_frame_ = py::none();
  SceneRun* run_ = nullptr;
  mutable std::chrono::steady_clock::time_point shown_;
};

std::shared_ptr<SceneRun> read_run(const std::filesystem::path& file) {
  const CacheReader cache(file);
  auto run = std::make_shared<SceneRun>();
  run->film = cached_film(cache.header());
  run->simulation = cached_simulation(cache.header(), run->film);
  run->recording = cached_recording(cache, run->film);
  for (std::size_t frame = 0; frame < cache.frame_count(); ++frame) {
    run->positions.push_back(cache.positions(frame));
    run->velocities.push_back(cache.velocities(frame));
    run->recording.seconds.push_back(cache.frame(frame).seconds);
    run->recording.state_hash = cache.frame(frame).state_hash;
  }
  return run;
}

std::shared_ptr<SceneRun> run_scene(const py::object& scene, const std::optional<std::filesystem::path>& cache,
                                    bool resume, const py::object& progress, const py::object& on_frame) {
  auto run = std::make_shared<SceneRun>();
  run->film = film_from(scene);
  const PythonObserver observer(progress, on_frame, run.get());
  const py::gil_scoped_release release;
  std::optional<RunCache> file;
  if (cache) file.emplace(*cache, record_of(run->film), resume);
  run->simulation = prepare_simulation(run->film, observer);
  run->recording = simulate(run->simulation, run->film, observer, file ? &*file : nullptr);
  if (!file) return run;
  file->close();
  return read_run(*cache);
}

std::size_t row_of(const SceneRun& run, long frame) {
  const long count = long(run.positions.size());
  if (frame < -count || frame >= count) {
    throw Error(ErrorKind::kBadInput, fmt::format("there is no frame {}: they are 0 to {}", frame, count - 1));
  }
  return frame < 0 ? frame + count : frame;
}

std::vector<Points> run_positions_of(const SceneRun& run, long frame) { return run.positions[row_of(run, frame)]; }
std::vector<Points> run_velocities_of(const SceneRun& run, long frame) { return run.velocities[row_of(run, frame)]; }

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), isize(values));
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
  for (const SoftBody& body : run.simulation.world.bodies) triangles.push_back(body.drawn.skin.triangles);
  return triangles;
}

/// Keyed by probe, then by quantity: (frames, 3), or (frames,) if it is one number.
py::dict probes_of(const SceneRun& run) {
  py::dict probes;
  for (const ProbeTrack& track : run.recording.probes) {
    py::dict measured;
    for (const ProbeQuantity& quantity : kProbeQuantities) {
      if (!quantity.is_of(track.kind)) continue;
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(track.samples.size(),
                                                                                  quantity.size());
      for (std::size_t i = 0; i < track.samples.size(); ++i) {
        std::copy_n(quantity.of(track.samples[i]).begin(), quantity.size(), rows.row(Eigen::Index(i)).begin());
      }
      const py::str name{std::string(quantity.name)};
      if (quantity.size() == 1) {
        measured[name] = Eigen::VectorXd(rows.col(0));
      } else {
        measured[name] = rows;
      }
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
          "frame_count", [](const SceneRun& run) { return run.positions.size(); }, "How many frames there are.")
      .def_property_readonly(
          "progress", [](const SceneRun& run) { return vector_of(run.recording.progress); },
          "(frames,) time, s, or share of the load, or number of the mode, 1.")
      .def_property_readonly(
          "seconds", [](const SceneRun& run) { return vector_of(run.recording.seconds); },
          "(frames,) s, of computing; those of an earlier run that this one went on from included.")
      .def_property_readonly(
          "scene", [](const SceneRun& run) { return print_scene(with_defaults(run.film)); },
          "The scene as resolved, as TOML.")
      .def_property_readonly(
          "frequencies", [](const SceneRun& run) { return run.recording.frequencies; }, "(modes,) Hz.")
      .def_property_readonly(
          "state_hash", [](const SceneRun& run) { return run.recording.state_hash; },
          "Of every bit of the last state, as sprung simulate prints it.")
      .def("positions", &run_positions_of, py::arg("frame"),
           "By body: (m, 3) m, of the nodes in a frame, from 0; -1 is the last.")
      .def("velocities", &run_velocities_of, py::arg("frame"), "By body: (m, 3) m/s, of the nodes in a frame.")
      .def("skin_positions", &skins_of, py::arg("frame"), "By body: (v, 3) m.")
      .def_property_readonly("triangles", &run_triangles_of, "By body: (t, 3) rows of skin_positions().")
      .def_property_readonly(
          "probes", &probes_of,
          "By name: position, displacement, m; force, N; torque, N m; stress (xx, yy, zz), shear_stress (xy, yz, zx), "
          "Pa; each (frames, 3).");
  module.def(
      "simulate", &run_scene, py::arg("scene"), py::arg("cache") = py::none(), py::arg("resume") = false,
      py::arg("progress") = py::none(), py::arg("on_frame") = py::none(),
      "Computes all frames of a scene, as sprung simulate does. scene: a TOML file, or a dict of the same "
      "keys; cache: an HDF5 file to keep the frames in; resume: continues the run in it; progress(stage, share, "
      "seconds_to_go): called between time steps, up to ten times a second; on_frame(frame, progress, positions): "
      "called after each frame, with the nodes of each body, (m, 3) m. What these raise ends the run.");
  module.def("read_run", &read_run, py::arg("cache"), py::call_guard<py::gil_scoped_release>(),
             "The run in a cache, as sprung simulate wrote it.");
}

}  // namespace sprung
