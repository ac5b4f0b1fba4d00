#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "app/python/live_world.h"
#include "app/scene/film.h"

namespace sprung {

/// A body of a world that lives as long as anything of it is looked at.
struct BodyHandle {
  std::shared_ptr<LiveWorld> world;
  std::size_t row;
};

/// Does short work on a world when its turn comes. Nobody waits for a turn and keeps Python from running meanwhile:
/// whoever has the turn may need Python to end it.
template <class Work>
auto in_turn(LiveWorld& world, const Work& work) {
  const std::unique_lock<std::mutex> turn = [&] {
    const pybind11::gil_scoped_release others_run;
    return world.take_turn();
  }();
  return work();
}

/// The same for long work that needs no Python.
template <class Work>
auto while_others_run(LiveWorld& world, const Work& work) {
  const pybind11::gil_scoped_release others_run;
  const std::unique_lock<std::mutex> turn = world.take_turn();
  return work();
}

/// What is where it is, seen as an array; `owner` keeps it there.
template <class Number>
pybind11::array view(const Number* first, const std::vector<pybind11::ssize_t>& shape, const pybind11::object& owner,
                     bool is_writable = false) {
  pybind11::array array(pybind11::dtype::of<Number>(), shape, first, owner);
  if (!is_writable) array.attr("flags").attr("writeable") = false;
  return array;
}

/// The film of a scene file, or of a dict of its keys. Throws Error(kBadInput).
[[nodiscard]] Film film_from(const pybind11::object& scene);

/// A body of the scene of what a dict has of its keys. Throws Error(kBadInput).
[[nodiscard]] SceneBody body_from(const pybind11::dict& keys);

/// Lets Ctrl-C, and whatever else a script waits for, through. Without Python's lock.
void let_signals_in();

void bind_scene(pybind11::module_& module);
void bind_materials(pybind11::module_& module);
void bind_mesh(pybind11::module_& module);
void bind_body(pybind11::module_& module);
void bind_world(pybind11::module_& module);

}  // namespace sprung
