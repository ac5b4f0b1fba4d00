#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "app/scene/scene_file.h"
#include "core/error.h"

/// A scene is parsed or refused; one that is parsed can be written, and parses to the same text again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sprung;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::string printed;
  try {
    printed = print_scene(parse_scene(text, "scene.toml"));
  } catch (const Error&) {
    return 0;
  }
  if (print_scene(parse_scene(printed, "scene.toml")) != printed) std::abort();
  return 0;
}
