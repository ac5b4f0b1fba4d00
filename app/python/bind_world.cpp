#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <numeric>
#include <variant>

#include "app/python/bindings.h"
#include "core/error.h"

namespace py = pybind11;

namespace sprung {
namespace {

using FileOrMesh = std::variant<std::filesystem::path, SurfaceMesh>;

std::vector<BodyHandle> handles_of(const std::shared_ptr<LiveWorld>& world, const std::vector<std::size_t>& rows) {
  std::vector<BodyHandle> handles;
  handles.reserve(rows.size());
  for (const std::size_t row : rows) handles.push_back({world, row});
  return handles;
}

std::vector<BodyHandle> add_to_world(const std::shared_ptr<LiveWorld>& world, FileOrMesh mesh, const Material& material,
                                     double size, int bricks, const Vec3& position, const std::string& model,
                                     const py::kwargs& keys) {
  SceneBody body = body_from(keys);
  if (auto* surface = std::get_if<SurfaceMesh>(&mesh)) {
    body.surface = std::make_shared<const SurfaceMesh>(std::move(*surface));
  } else {
    body.mesh = std::get<std::filesystem::path>(mesh);
  }
  body.material = material;
  body.size = size;
  if (bricks <= 0) throw Error(ErrorKind::kBadInput, fmt::format("bricks ({}) must be above 0", bricks));
  body.bricks = bricks;
  body.position = position;
  body.model = model_from_name(model);
  return handles_of(world, locked_without_gil(*world, [&] { return world->add(body); }));
}

std::shared_ptr<LiveWorld> world_from_scene(const py::object& scene) {
  Film film = film_from(scene);
  const py::gil_scoped_release release;
  return std::make_shared<LiveWorld>(std::move(film));
}

std::vector<BodyHandle> bodies_of(const std::shared_ptr<LiveWorld>& world) {
  std::vector<std::size_t> rows(locked(*world, [&] { return world->body_count(); }));
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return handles_of(world, rows);
}

void advance_world(LiveWorld& world, double duration) {
  locked_without_gil(world, [&] { world.advance(duration, check_signals); });
}

void step_world(LiveWorld& world, double dt, long count) {
  locked_without_gil(world, [&] { world.step(dt, count, check_signals); });
}

/// The array owns the image's memory.
py::array_t<std::uint8_t> draw_world(LiveWorld& world, int width, int height, double azimuth, double elevation) {
  auto image =
      std::make_unique<Image>(locked_without_gil(world, [&] { return world.draw(width, height, azimuth, elevation); }));
  const std::uint8_t* first = image->pixels.data();
  const py::capsule owner(image.release(), [](void* memory) { delete static_cast<Image*>(memory); });
  return py::array_t<std::uint8_t>({py::ssize_t{height}, py::ssize_t{width}, py::ssize_t{3}}, first, owner);
}

}  // namespace

void bind_world(py::module_& module) {
  py::class_<LiveWorld, std::shared_ptr<LiveWorld>>(
      module, "World",
      "Bodies that move and touch each other. Threads take turns; where an Error is raised nothing changes.")
      .def(py::init<const Vec3&, std::optional<double>>(), py::arg("gravity") = std::array<double, 3>{0, -9.81, 0},
           py::arg("ground") = 0.0, "gravity: (3,) m/s2; ground: height of level ground, m, or None.")
      .def("add", &add_to_world, py::arg("mesh"), py::arg("material"), py::arg("size") = 0.2, py::arg("bricks") = 24,
           py::arg("position") = std::array<double, 3>{0, 0, 0}, py::arg("model") = "calibrated",
           "A body for every solid of a mesh or a file of one. size: longest side, m; bricks: along that; "
           "position: (3,) m, of the middle of the bottom of the bounding box; model: as for sprung animate --model; "
           "keys: others of [[body]] in scenes, pin=[{...}], force=[{...}], velocity=[...] ...")
      .def_static("from_scene", &world_from_scene, py::arg("scene"),
                  "Everything in a scene: bodies, pins, forces, obstacles, glue. scene: a TOML file, or a dict of the "
                  "same keys; paths in a dict are relative to the working folder.")
      .def_property_readonly("bodies", &bodies_of, "All bodies, in the order in which they were added.")
      .def("advance", &advance_world, py::arg("duration"), "Advances by duration, s, in stable time steps.")
      .def("step", &step_world, py::arg("dt"), py::arg("count") = 1, "Exactly count explicit time steps of dt, s.")
      .def(
          "stable_step", [](LiveWorld& world) { return locked(world, [&] { return world.stable_step(); }); },
          "Longest stable explicit time step in the present state, s.")
      .def_property_readonly(
          "time", [](LiveWorld& world) { return locked(world, [&] { return world.time(); }); }, "Since the start, s.")
      .def("render", &draw_world, py::arg("width") = 640, py::arg("height") = 360, py::arg("azimuth") = 30.0,
           py::arg("elevation") = 14.0,
           "(height, width, 3) sRGB bytes; azimuth: degrees about y; elevation: degrees above the horizon.");
}

}  // namespace sprung
