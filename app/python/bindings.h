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

/// A body of a world, which lives as long as any view of it.
struct BodyHandle {
  std::shared_ptr<LiveWorld> world;
  std::size_t row;
};

/// Does short work on a world, holding its lock. It waits for the lock without Python's: the thread that holds the lock
/// may need Python to finish.
template <class Work>
auto locked(LiveWorld& world, const Work& work) {
  const std::unique_lock<std::mutex> lock = [&] {
    const pybind11::gil_scoped_release release;
    return world.lock();
  }();
  return work();
}

/// The same for long work without Python's lock.
template <class Work>
auto locked_without_gil(LiveWorld& world, const Work& work) {
  const pybind11::gil_scoped_release release;
  const std::unique_lock<std::mutex> lock = world.lock();
  return work();
}

/// An array over existing memory, which `owner` keeps alive.
template <class Number>
pybind11::array view(const Number* first, const std::vector<pybind11::ssize_t>& shape, const pybind11::object& owner,
                     bool is_writable = false) {
  pybind11::array array(pybind11::dtype::of<Number>(), shape, first, owner);
  if (!is_writable) array.attr("flags").attr("writeable") = false;
  return array;
}

/// The film of a scene file, or of a dict of its keys. Throws Error(kBadInput).
[[nodiscard]] Film film_from(const pybind11::object& scene);

/// A body from a dict of keys of [[body]]. Throws Error(kBadInput).
[[nodiscard]] SceneBody body_from(const pybind11::dict& keys);

/// Runs pending signal handlers of Python, such as Ctrl-C's; takes Python's lock. Throws if one raises.
void check_signals();

void bind_scene(pybind11::module_& module);
void bind_body(pybind11::module_& module);
void bind_load(pybind11::module_& module);
void bind_world(pybind11::module_& module);

}  // namespace sprung
