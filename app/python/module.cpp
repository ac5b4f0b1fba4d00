#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>

#include "app/materials/material_library.h"
#include "app/python/live_world.h"
#include "core/body/brick_measures.h"
#include "core/error.h"
#include "core/nearest.h"

namespace py = pybind11;

namespace sprung {
namespace {

/// A body of a world that lives as long as anything of it is looked at.
struct BodyHandle {
  std::shared_ptr<LiveWorld> world;
  std::size_t row;

  [[nodiscard]] Body& body() const { return world->body(row); }
};

/// n x 3 numbers where they are; `owner` keeps them there.
py::array view(const double* first, py::ssize_t rows, const py::object& owner, bool is_writable) {
  py::array array(py::dtype::of<double>(), {rows, py::ssize_t{3}}, first, owner);
  if (!is_writable) array.attr("flags").attr("writeable") = false;
  return array;
}

template <class Member>
auto points_of(Member Body::*member, bool is_writable) {
  return [member, is_writable](const py::object& self) {
    const Points& points = self.cast<BodyHandle&>().body().*member;
    return view(points.data(), points.rows(), self, is_writable);
  };
}

py::array nodes_of(const py::object& self) {
  const BrickGrid& grid = self.cast<BodyHandle&>().body().grid;
  py::array array(py::dtype::of<int>(), {static_cast<py::ssize_t>(grid.nodes.size()), py::ssize_t{8}},
                  grid.nodes.data()->data(), self);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// One number a brick; the array takes over the memory.
Eigen::VectorXd field_of(const BodyHandle& handle, const std::string& name) {
  const Body& body = handle.body();
  constexpr std::array<std::string_view, 6> kNames{"stretch", "strain", "stress", "volume", "fill", "young"};
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) {
    throw Error(ErrorKind::kBadInput, fmt::format("there is no field '{}'{}", name, did_you_mean(name, kNames)));
  }
  if (name == "fill") return Eigen::Map<const Eigen::VectorXd>(body.grid.fill.data(), body.grid.brick_count());
  if (name == "young") return brick_youngs(body);
  return measure_bricks(body, static_cast<BrickMeasure>(found - kNames.begin()), body.positions);
}

std::vector<BodyHandle> add_bodies(const std::shared_ptr<LiveWorld>& world, const std::string& mesh,
                                   const Material& material, double size, int bricks, const Vec3& position,
                                   const std::string& model) {
  std::vector<BodyHandle> handles;
  for (const std::size_t row : world->add(mesh, {.material = material,
                                                .model = model_from_name(model),
                                                .size = size,
                                                .bricks = bricks,
                                                .position = position})) {
    handles.push_back({world, row});
  }
  return handles;
}

/// height x width x 3 bytes; the array takes over the memory.
py::array_t<std::uint8_t> picture(const LiveWorld& world, int width, int height, double azimuth, double elevation) {
  auto image = std::make_unique<Image>(world.draw(width, height, azimuth, elevation));
  const std::uint8_t* first = image->pixels.data();
  const py::capsule owner(image.release(), [](void* memory) { delete static_cast<Image*>(memory); });
  return py::array_t<std::uint8_t>({py::ssize_t{height}, py::ssize_t{width}, py::ssize_t{3}}, first, owner);
}

Material material_named(const std::string& name) { return built_in_materials()->find(name).material(); }

Material make_material(double young, double poisson, double density, double damping, const std::string& name) {
  const Material material{
      .name = name, .young = young, .poisson = poisson, .density = density, .damping = damping, .source = ""};
  check_material(material);
  return material;
}

void add_material(py::module_& module) {
  py::class_<Material>(module, "Material")
      .def(py::init(&make_material), py::arg("young"), py::arg("poisson"), py::arg("density"),
           py::arg("damping") = 0.02, py::arg("name") = "custom")
      .def_readonly("name", &Material::name)
      .def_readonly("young", &Material::young)
      .def_readonly("poisson", &Material::poisson)
      .def_readonly("density", &Material::density)
      .def_readonly("damping", &Material::damping)
      .def_readonly("source", &Material::source);
  module.def("material", &material_named, py::arg("name"));
  module.def("materials", [] {
    std::vector<std::string> names;
    for (const LibraryMaterial& material : built_in_materials()->materials()) names.push_back(material.name);
    return names;
  });
}

void add_body(py::module_& module) {
  py::class_<BodyHandle>(module, "Body")
      .def_property_readonly("positions", points_of(&Body::positions, true))
      .def_property_readonly("velocities", points_of(&Body::velocities, true))
      .def_property_readonly("rest_positions", points_of(&Body::rest_positions, false))
      .def_property_readonly("nodes", &nodes_of)
      .def_property_readonly("masses", [](const BodyHandle& handle) { return handle.body().masses; })
      .def_property_readonly("brick_size", [](const BodyHandle& handle) { return handle.body().grid.brick_size; })
      .def_property_readonly("material", [](const BodyHandle& handle) { return handle.body().material; })
      .def("field", &field_of, py::arg("name"))
      .def("skin_positions", [](const BodyHandle& handle) { return handle.world->skin_positions(handle.row); })
      .def("triangles", [](const BodyHandle& handle) { return handle.world->skin(handle.row).triangles; })
      .def(
          "pin", [](const BodyHandle& handle, const std::vector<int>& nodes) { handle.world->pin(handle.row, nodes); },
          py::arg("nodes"))
      .def(
          "settle", [](const BodyHandle& handle, bool linear) { handle.world->settle(handle.row, linear); },
          py::arg("linear") = false, py::call_guard<py::gil_scoped_release>());
}

void add_world(py::module_& module) {
  py::class_<LiveWorld, std::shared_ptr<LiveWorld>>(module, "World")
      .def(py::init<const Vec3&, std::optional<double>>(), py::arg("gravity") = Vec3(0, -9.81, 0),
           py::arg("ground") = 0.0)
      .def("add", &add_bodies, py::arg("mesh"), py::arg("material"), py::arg("size") = 0.2, py::arg("bricks") = 24,
           py::arg("position") = Vec3(0, 0, 0), py::arg("model") = "calibrated")
      .def("advance", &LiveWorld::advance, py::arg("duration"), py::call_guard<py::gil_scoped_release>())
      .def("step", &LiveWorld::step, py::arg("dt"), py::arg("count") = 1, py::call_guard<py::gil_scoped_release>())
      .def("stable_step", &LiveWorld::stable_step)
      .def_property_readonly("time", &LiveWorld::time)
      .def("render", &picture, py::arg("width") = 640, py::arg("height") = 360, py::arg("azimuth") = 30.0,
           py::arg("elevation") = 14.0);
}

}  // namespace
}  // namespace sprung

PYBIND11_MODULE(sprung, module) {
  module.doc() = "Soft bodies of real materials: meshes filled with bricks, moved, measured and drawn. SI units.";
  py::register_exception<sprung::Error>(module, "Error", PyExc_RuntimeError);
  sprung::add_material(module);
  sprung::add_body(module);
  sprung::add_world(module);
}
