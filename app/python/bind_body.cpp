#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "app/python/bindings.h"
#include "core/body/brick_measures.h"
#include "core/body/stress.h"
#include "core/error.h"
#include "core/text.h"

namespace py = pybind11;

namespace sprung {
namespace {

/// Calls `work` with the body of a handle, locked.
template <class Work>
auto with_body(const py::object& self, const Work& work) {
  const auto& handle = self.cast<const BodyHandle&>();
  return locked(*handle.world, [&] { return work(handle.world->body(handle.row)); });
}

template <class Member>
auto points_of(Member Body::*member, bool is_writable) {
  return [member, is_writable](const py::object& self) {
    return with_body(self, [&](const Body& body) {
      const Points& points = body.*member;
      return view(points.data(), {points.rows(), 3}, self, is_writable);
    });
  };
}

py::array masses_of(const py::object& self) {
  return with_body(self, [&](const Body& body) { return view(body.masses.data(), {body.masses.size()}, self); });
}

py::array nodes_of(const py::object& self) {
  return with_body(self, [&](const Body& body) {
    return view(body.grid.nodes.data()->data(), {body.grid.brick_count(), 8}, self);
  });
}

py::array triangles_of(const py::object& self) {
  const auto& handle = self.cast<const BodyHandle&>();
  return locked(*handle.world, [&] {
    const Triangles& triangles = handle.world->body(handle.row).drawn.skin.triangles;
    return view(triangles.data(), {triangles.rows(), 3}, self);
  });
}

/// One number per brick; the array owns computed ones.
py::array field_of(const py::object& self, const std::string& name) {
  constexpr std::array<std::string_view, 6> kNames{"stretch", "strain", "stress", "volume", "fill", "young"};
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) {
    throw Error(ErrorKind::kBadInput, fmt::format("there is no field '{}'{}", name, did_you_mean(name, kNames)));
  }
  return with_body(self, [&](const Body& body) -> py::array {
    if (name == "fill") return view(body.grid.fill.data(), {body.grid.brick_count()}, self);
    if (name == "young") return py::cast(brick_youngs(body));
    return py::cast(measure_bricks(body, static_cast<BrickMeasure>(found - kNames.begin()), body.positions));
  });
}

StrainMeasure measure_of(bool small) { return small ? StrainMeasure::kSmall : StrainMeasure::kFinite; }

StressTensors stress_of(const BodyHandle& handle, bool small) {
  return locked_without_gil(*handle.world, [&] {
    const Body& body = handle.world->body(handle.row);
    return recover_stress(body, body.positions, measure_of(small));
  });
}

StressTensors skin_stress_of(const BodyHandle& handle, bool small) {
  return locked_without_gil(*handle.world, [&] {
    const SoftBody& body = handle.world->body(handle.row);
    return stress_at(body.grid, body.drawn.embedding, recover_stress(body, body.positions, measure_of(small)));
  });
}

/// Rows of nodes: the rows themselves, or from one bool for each of `count` nodes.
std::vector<long> rows_from(const py::object& nodes, py::ssize_t count) {
  const auto array = py::array::ensure(nodes);
  if (!array) throw py::error_already_set();
  const char kind = array.dtype().kind();
  if (array.ndim() == 1 && array.size() == 0) return {};
  if (array.ndim() == 1 && (kind == 'i' || kind == 'u')) return nodes.cast<std::vector<long>>();
  if (array.ndim() != 1 || kind != 'b' || array.size() != count) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("nodes to pin are whole numbers in one row, or one bool for each of the body's {} nodes", count));
  }
  std::vector<long> rows;
  const auto is_meant = py::array_t<bool>(array);
  for (py::ssize_t row = 0; row < count; ++row) {
    if (is_meant.at(row)) rows.push_back(row);
  }
  return rows;
}

void pin(const BodyHandle& handle, const py::object& nodes) {
  locked(*handle.world,
         [&] { handle.world->pin(handle.row, rows_from(nodes, handle.world->body(handle.row).node_count())); });
}

void settle(const BodyHandle& handle, bool linear) {
  locked_without_gil(*handle.world, [&] { handle.world->settle(handle.row, linear, check_signals); });
}

Points deformed_skin(const BodyHandle& handle) {
  return locked_without_gil(*handle.world, [&] { return handle.world->skin_positions(handle.row); });
}

}  // namespace

void bind_body(py::module_& module) {
  py::class_<BodyHandle>(module, "Body",
                         "One solid filled with bricks: m nodes, n bricks; its skin: v vertices, t triangles.")
      .def_property_readonly("positions", points_of(&Body::positions, true), "(m, 3) m; no copy, writable.")
      .def_property_readonly("velocities", points_of(&Body::velocities, true), "(m, 3) m/s; no copy, writable.")
      .def_property_readonly("rest_positions", points_of(&Body::rest_positions, false), "(m, 3) m; no copy, read only.")
      .def_property_readonly("masses", &masses_of, "(m,) kg; no copy, read only.")
      .def_property_readonly("nodes", &nodes_of, "(n, 8) rows of positions, x fastest; no copy, read only.")
      .def_property_readonly("triangles", &triangles_of, "(t, 3) rows of skin_positions(); no copy, read only.")
      .def_property_readonly(
          "brick_size",
          [](const py::object& self) { return with_body(self, [](const Body& body) { return body.grid.brick_size; }); },
          "Side of a brick, m.")
      .def_property_readonly(
          "material",
          [](const py::object& self) { return with_body(self, [](const Body& body) { return body.material; }); },
          "Its material.")
      .def("field", &field_of, py::arg("name"),
           "(n,) stretch, strain (von Mises), volume (over that at rest), fill, 1; stress (von Mises), young, Pa.")
      .def("stress", &stress_of, py::arg("small") = false,
           "(m, 6) Cauchy stress at the nodes: xx, yy, zz, xy, yz, zx, Pa. Continued from the bricks' middles to their "
           "corners by their neighbours; small: of displacements as those of settle(linear=True).")
      .def("skin_stress", &skin_stress_of, py::arg("small") = false, "(v, 6) Pa, the same at the vertices of the skin.")
      .def("skin_positions", &deformed_skin, "(v, 3) m.")
      .def("pin", &pin, py::arg("nodes"), "Fixes these nodes where they are, and no others: rows, or (m,) bools.")
      .def("settle", &settle, py::arg("linear") = false,
           "Equilibrium with gravity, the constant forces of the scene and the pinned nodes; linear: for small "
           "displacements. Obstacles are not met; other loads are refused.");
}

}  // namespace sprung
