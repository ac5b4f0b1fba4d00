#include "app/scene/cached_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "app/scene/scene_file.h"

namespace sprung {
namespace {

Film parse_cached(const std::string& text) { return parse_scene(text, "/cache.toml", SceneFiles::kAnywhere); }

/// The film with those settings of `other` that change no frame.
Film with_drawing_of(Film film, const Film& other) {
  film.camera = other.camera;
  film.render = other.render;
  const bool has_even_pins = std::any_of(film.bodies.begin(), film.bodies.end(), [](const SceneBody& body) {
    return std::any_of(body.pins.begin(), body.pins.end(), [](const Pin& pin) { return pin.translate || pin.rotate; });
  });
  if (is_motion(film) && !has_even_pins) film.duration = other.duration;
  return film;
}

/// "[[body]] young = 2 in the cache, young = 3 here" of the first line that differs.
std::string difference_of_texts(const std::string& cached, const std::string& now) {
  std::istringstream old_text(cached);
  std::istringstream new_text(now);
  std::string section;
  std::string old_line;
  std::string new_line;
  while (true) {
    const bool has_old = static_cast<bool>(std::getline(old_text, old_line));
    const bool has_new = static_cast<bool>(std::getline(new_text, new_line));
    if (!has_old && !has_new) return "";
    if (!has_old) old_line = "nothing";
    if (!has_new) new_line = "nothing";
    if (old_line != new_line) {
      return fmt::format("the scene: {}{} in the cache, {} here", section, old_line, new_line);
    }
    if (old_line.starts_with('[')) section = old_line + " ";
  }
}

}  // namespace

SceneRecord record_of(const Film& film) {
  const std::string text = print_scene(with_defaults(film));
  return {.text = text, .difference = [text](const std::string& cached_text) {
            const Film now = parse_cached(text);
            return difference_of_texts(print_scene(with_drawing_of(parse_cached(cached_text), now)), print_scene(now));
          }};
}

Film cached_film(const CacheHeader& header) { return parse_cached(header.scene); }

}  // namespace sprung
