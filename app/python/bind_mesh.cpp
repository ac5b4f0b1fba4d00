#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "app/python/bindings.h"
#include "core/error.h"
#include "core/mesh/io/read_mesh.h"
#include "core/mesh/io/reader_process.h"

namespace py = pybind11;

namespace sprung {
namespace {

SurfaceMesh make_mesh(const Points& positions, const Triangles& triangles) {
  SurfaceMesh mesh;
  mesh.positions = positions;
  mesh.triangles = triangles;
  mesh.parts.push_back({.name = "mesh", .triangle_count = int(triangles.rows())});
  const std::string fault = find_fault(mesh);
  if (!fault.empty()) throw Error(ErrorKind::kBadInput, fmt::format("the mesh is not one: {}", fault));
  return mesh;
}

py::array positions_of(const py::object& self) {
  const Points& positions = self.cast<const SurfaceMesh&>().positions;
  return view(positions.data(), {positions.rows(), 3}, self);
}

py::array triangles_of(const py::object& self) {
  const Triangles& triangles = self.cast<const SurfaceMesh&>().triangles;
  return view(triangles.data(), {triangles.rows(), 3}, self);
}

}  // namespace

void bind_mesh(py::module_& module) {
  py::class_<SurfaceMesh>(module, "Mesh", "A surface of triangles, as a file or a script gives it.")
      .def(py::init(&make_mesh), py::arg("positions"), py::arg("triangles"),
           "positions: (k, 3), in any unit; triangles: (t, 3) rows of positions, from 0, counter-clockwise from "
           "outside.")
      .def_property_readonly("positions", &positions_of, "(k, 3) units of the file; no copy, read only.")
      .def_property_readonly("triangles", &triangles_of, "(t, 3) rows of positions; no copy, read only.")
      .def_readonly("notes", &SurfaceMesh::notes, "What was left out of the file, a sentence each.");
  module.def("read_mesh", &read_mesh, py::arg("file"), py::call_guard<py::gil_scoped_release>(),
             "The mesh in a file: OBJ, PLY, STL, OFF, or whatever assimp reads; Error says what is wrong and where.");
}

}  // namespace sprung
