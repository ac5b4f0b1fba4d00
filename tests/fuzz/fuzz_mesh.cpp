#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/mesh/io/reader_process.h"
#include "core/mesh/io/readers.h"

namespace sprung {
namespace {

/// Reading may throw an Error about the input; a mesh that it returns must be valid.
template <class Read>
void expect_mesh_or_error(const Read& read) {
  try {
    const SurfaceMesh mesh = read();
    if (!find_fault(mesh).empty()) std::abort();
  } catch (const Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
}

template <class Check>
void expect_error_or_none(const Check& check) {
  try {
    check();
  } catch (const Error&) {
  }
}

}  // namespace
}  // namespace sprung

/// The same bytes to every reader and check that runs in this program's own code; each recognises its format by the
/// first words.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sprung;
  const std::string name = "fuzz";
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const FindText library = [&](const std::string&) { return std::optional<std::string>(bytes); };
  expect_mesh_or_error([&] { return read_obj(bytes, name, library); });
  expect_mesh_or_error([&] { return read_off(bytes, name); });
  expect_mesh_or_error([&] { return read_ply(bytes, name); });
  expect_mesh_or_error([&] { return read_stl(bytes, name); });
  expect_error_or_none([&] { static_cast<void>(mesh_from_bytes(std::as_bytes(std::span(bytes)))); });
  expect_error_or_none([&] { check_glb(bytes, name); });
  expect_error_or_none([&] { check_gltf(bytes, name); });
  expect_error_or_none([&] { check_3mf(bytes, name); });
  return 0;
}
