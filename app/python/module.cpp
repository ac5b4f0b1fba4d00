#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "app/python/bindings.h"
#include "app/scene/material_library.h"
#include "app/scene/scene_values.h"
#include "core/error.h"
#include "core/mesh/io/read_mesh.h"
#include "core/mesh/io/reader_process.h"

namespace py = pybind11;

namespace sprung {
namespace {

/// sprung.Error, and sprung.Diverged below it.
void bind_errors(py::module_& module) {
  // Never released: the interpreter may be gone when statics are destroyed.
  static const py::handle error = py::exception<Error>(module, "Error", PyExc_RuntimeError).release();
  static const py::handle diverged = py::exception<Error>(module, "Diverged", error).release();
  error.attr("__doc__") = "Raised by the library: a mesh, a material, a value or a name is wrong.";
  diverged.attr("__doc__") = "A motion or an equilibrium that does not converge; the message says where.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& one) {
      const bool has_diverged = one.kind() == ErrorKind::kDiverged;
      PyErr_SetString((has_diverged ? diverged : error).ptr(), one.what());
    }
  });
}

Material material_named(const std::string& name) { return built_in_materials()->find(name).material(); }

Material make_material(double young, double poisson, double density, double damping, const std::string& name,
                       const std::string& law, std::optional<double> mooney_share, std::optional<double> fung_exponent,
                       std::vector<double> ogden_exponents, std::vector<double> ogden_shares) {
  Material material{
      .name = name, .young = young, .poisson = poisson, .density = density, .damping = damping, .source = ""};
  parse_value(law, {.name = "law", .help = ""}, material.law.kind);
  material.law.mooney_share = mooney_share;
  material.law.fung_exponent = fung_exponent;
  material.law.ogden_exponents = std::move(ogden_exponents);
  material.law.ogden_shares = std::move(ogden_shares);
  check_material(material);
  return material;
}

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const LibraryMaterial& material : built_in_materials()->materials()) names.push_back(material.name);
  return names;
}

std::string described(const py::object& self) {
  return py::str("<sprung.Material {}: {:g} Pa, {:g}, {:g} kg/m3>")
      .format(self.attr("name"), self.attr("young"), self.attr("poisson"), self.attr("density"));
}

void bind_materials(py::module_& module) {
  py::class_<Material>(module, "Material", "What bricks are made of: isotropic, and linear for small strains.")
      .def(py::init(&make_material), py::arg("young"), py::arg("poisson"), py::arg("density"),
           py::arg("damping") = 0.02, py::arg("name") = "custom", py::arg("law") = "neo-hooke",
           py::arg("mooney_share") = py::none(), py::arg("fung_exponent") = py::none(),
           py::arg("ogden_exponents") = std::vector<double>{}, py::arg("ogden_shares") = std::vector<double>{},
           "young: Pa; poisson: above -1 and below 0.5; density: kg/m3; damping: fraction of critical, at the slowest "
           "vibration; law: at large strains, neo-hooke, mooney-rivlin, ogden, fung or linear, with its parameters as "
           "in a scene.")
      .def_readonly("name", &Material::name, "The name it was given.")
      .def_readonly("young", &Material::young, "Young's modulus, Pa.")
      .def_readonly("poisson", &Material::poisson, "Poisson's ratio, 1.")
      .def_readonly("poisson_in_motion", &Material::poisson_in_motion, "Poisson's ratio in motions, 1; None: the same.")
      .def_readonly("density", &Material::density, "Density, kg/m3.")
      .def_readonly("damping", &Material::damping, "Ratio of critical damping at the slowest vibration, 1.")
      .def_property_readonly(
          "law", [](const Material& material) { return law_text(material.law); }, "The law at large strains.")
      .def_readonly("source", &Material::source, "Source of a built-in material's figures.")
      .def("__repr__", &described);
  module.def("material", &material_named, py::arg("name"),
             "A built-in material; Error with the nearest name where there is none.");
  module.def("materials", &material_names, "The names of the built-in materials.");
}

SurfaceMesh make_mesh(const Points& positions, const Triangles& triangles) {
  SurfaceMesh mesh;
  mesh.positions = positions;
  mesh.triangles = triangles;
  mesh.parts.push_back({.name = "mesh", .triangle_count = int(triangles.rows())});
  const std::string fault = find_fault(mesh);
  if (!fault.empty()) throw Error(ErrorKind::kBadInput, fmt::format("the mesh is not one: {}", fault));
  return mesh;
}

py::array mesh_positions_of(const py::object& self) {
  const Points& positions = self.cast<const SurfaceMesh&>().positions;
  return view(positions.data(), {positions.rows(), 3}, self);
}

py::array mesh_triangles_of(const py::object& self) {
  const Triangles& triangles = self.cast<const SurfaceMesh&>().triangles;
  return view(triangles.data(), {triangles.rows(), 3}, self);
}

void bind_mesh(py::module_& module) {
  py::class_<SurfaceMesh>(module, "Mesh", "A surface of triangles, as a file or a script gives it.")
      .def(py::init(&make_mesh), py::arg("positions"), py::arg("triangles"),
           "positions: (k, 3), in any unit; triangles: (t, 3) rows of positions, from 0, counter-clockwise from "
           "outside.")
      .def_property_readonly("positions", &mesh_positions_of, "(k, 3) units of the file; no copy, read only.")
      .def_property_readonly("triangles", &mesh_triangles_of, "(t, 3) rows of positions; no copy, read only.")
      .def_readonly("notes", &SurfaceMesh::notes, "What was ignored in the file, one sentence each.");
  module.def("read_mesh", &read_mesh, py::arg("file"), py::call_guard<py::gil_scoped_release>(),
             "The mesh in a file: OBJ, PLY, STL, OFF, or whatever assimp reads; Error says what is wrong and where.");
}

}  // namespace
}  // namespace sprung

PYBIND11_MODULE(sprung, module) {
  module.doc() = "Soft bodies of real materials: meshes filled with bricks, moved, measured and drawn. SI units.";
  module.attr("__version__") = SPRUNG_VERSION;
  sprung::bind_errors(module);
  sprung::bind_materials(module);
  sprung::bind_mesh(module);
  sprung::bind_body(module);
  sprung::bind_world(module);
  sprung::bind_load(module);
  sprung::bind_scene(module);
}
