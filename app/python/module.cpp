#include "app/python/bindings.h"
#include "core/error.h"

namespace {

/// Errors of ours as Python's: Diverged where a motion did, Error for all of them.
void bind_errors(pybind11::module_& module) {
  // Never given back: the interpreter may be gone when statics end.
  static const pybind11::handle error =
      pybind11::exception<sprung::Error>(module, "Error", PyExc_RuntimeError).release();
  static const pybind11::handle diverged = pybind11::exception<sprung::Error>(module, "Diverged", error).release();
  error.attr("__doc__") = "What the library raises: a mesh, a material, a value or a name that is wrong.";
  diverged.attr("__doc__") = "A motion or an equilibrium came to no good end; the message says where.";
  pybind11::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const sprung::Error& one) {
      const bool has_diverged = one.kind() == sprung::ErrorKind::kDiverged;
      PyErr_SetString((has_diverged ? diverged : error).ptr(), one.what());
    }
  });
}

}  // namespace

PYBIND11_MODULE(sprung, module) {
  module.doc() = "Soft bodies of real materials: meshes filled with bricks, moved, measured and drawn. SI units.";
  module.attr("__version__") = SPRUNG_VERSION;
  bind_errors(module);
  sprung::bind_materials(module);
  sprung::bind_mesh(module);
  sprung::bind_body(module);
  sprung::bind_world(module);
  sprung::bind_scene(module);
}
