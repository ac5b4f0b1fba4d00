#pragma once
#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "core/mesh/surface_mesh.h"
#include "core/simulation/scene.h"

namespace sprung {

/// One body in the units of its table, which the program takes for SI.
class TableScene {
 public:
  TableScene(SurfaceMesh mesh, double brick, double young, double poisson, Solver scheme = Solver::kLinear) {
    box_ = bounding_box(mesh.positions);
    scene_.gravity.setZero();
    scene_.duration = 1;
    scene_.solver.scheme = scheme;
    scene_.solver.load_steps = 1;
    SceneBody& body = scene_.bodies.emplace_back();
    body.surface = std::make_shared<const SurfaceMesh>(std::move(mesh));
    body.scale = 1;
    body.brick_size = brick;
    body.material = {
        .name = "table", .young = young, .poisson = poisson, .density = 1, .damping = 0.02, .source = "its table"};
  }

  TableScene& density(double density) {
    body().material.density = density;
    return *this;
  }
  TableScene& modes(int count) {
    scene_.solver.modes = count;
    return *this;
  }
  TableScene& steps(int count) {
    scene_.solver.load_steps = count;
    return *this;
  }

  /// Pins a side of the bounding box ("x-low") along some axes.
  TableScene& hold(const std::string& side, const std::string& axes = "xyz") {
    Pin pin;
    pin.box = side_of(side);
    return add(std::move(pin), axes);
  }
  /// Pins a part of the mesh.
  TableScene& hold_part(const std::string& part, const std::string& axes = "xyz") {
    Pin pin;
    pin.part = part;
    return add(std::move(pin), axes);
  }
  /// Pins the skin of a part, wherever the bricks lie.
  TableScene& hold_surface(const std::string& part) {
    Pin pin;
    pin.part = part;
    pin.on_surface = true;
    return add(std::move(pin), "xyz");
  }
  /// Pins the edge where two sides of the bounding box meet.
  TableScene& hold_edge(const std::string& one, const std::string& other, const std::string& axes) {
    const Box a = side_of(one);
    const Box b = side_of(other);
    Pin pin;
    pin.box = Box{a.min.cwiseMax(b.min), a.max.cwiseMin(b.max)};
    return add(std::move(pin), axes);
  }

  /// Loads a part of the mesh.
  BodyForce& load(const std::string& part) {
    BodyForce& force = body().forces.emplace_back();
    force.part = part;
    return force;
  }
  TableScene& pull(const std::string& part, const Vec3& total) {
    BodyForce& force = load(part);
    force.total = total;
    force.on_surface = true;
    return *this;
  }
  TableScene& press(const std::string& part, double pressure) {
    load(part).pressure = pressure;
    return *this;
  }

  /// A point in the frame of the table; moved into the body by a ten-thousandth of it.
  TableScene& probe(const std::string& name, const Vec3& position) {
    const Vec3 from_middle = (1 - 1e-4) * (position - box_.center());
    scene_.probes.push_back({.name = name, .body = 1, .point = from_middle, .pin = {}, .selection = {}});
    return *this;
  }

  [[nodiscard]] Scene scene() const { return scene_; }

 private:
  SceneBody& body() { return scene_.bodies[0]; }

  [[nodiscard]] static Box side_of(const std::string& side) {
    Box box;
    const int axis = side[0] - 'x';
    const bool is_high = side.ends_with("high");
    (is_high ? box.min : box.max)[axis] = is_high ? 1 : 0;
    return box;
  }

  TableScene& add(Pin pin, const std::string& axes) {
    for (std::size_t axis = 0; axis < 3; ++axis) pin.axes.fixed[axis] = axes.find("xyz"[axis]) != std::string::npos;
    pin.name = fmt::format("pin {}", body().pins.size() + 1);
    body().pins.push_back(std::move(pin));
    return *this;
  }

  Scene scene_;
  AlignedBox box_;
};

}  // namespace sprung
