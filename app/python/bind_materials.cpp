#include <pybind11/stl.h>

#include "app/python/bindings.h"
#include "app/scene/material_library.h"

namespace py = pybind11;

namespace sprung {
namespace {

Material material_named(const std::string& name) { return built_in_materials()->find(name).material(); }

Material make_material(double young, double poisson, double density, double damping, const std::string& name) {
  Material material{
      .name = name, .young = young, .poisson = poisson, .density = density, .damping = damping, .source = ""};
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

}  // namespace

void bind_materials(py::module_& module) {
  py::class_<Material>(module, "Material", "What bricks are made of: isotropic, and linear for small strains.")
      .def(py::init(&make_material), py::arg("young"), py::arg("poisson"), py::arg("density"),
           py::arg("damping") = 0.02, py::arg("name") = "custom",
           "young: Pa; poisson: above -1 and below 0.5; density: kg/m3; damping: share of critical, at the slowest "
           "vibration.")
      .def_readonly("name", &Material::name, "The name it was given.")
      .def_readonly("young", &Material::young, "Young's modulus, Pa.")
      .def_readonly("poisson", &Material::poisson, "Poisson's ratio, 1.")
      .def_readonly("density", &Material::density, "Density, kg/m3.")
      .def_readonly("damping", &Material::damping, "Ratio of critical damping at the slowest vibration, 1.")
      .def_readonly("source", &Material::source, "Where a built-in material's figures are from.")
      .def("__repr__", &described);
  module.def("material", &material_named, py::arg("name"),
             "A built-in material; Error with the nearest name where there is none.");
  module.def("materials", &material_names, "The names of the built-in materials.");
}

}  // namespace sprung
