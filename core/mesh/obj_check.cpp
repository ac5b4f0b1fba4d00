#include "core/mesh/obj_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sprung {
namespace {

constexpr std::string_view kSpace = " \t\r";

/// Takes the next word off the front of a line; empty at its end.
std::string_view next_word(std::string_view& line) {
  const std::size_t begin = line.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return line = {};
  const std::size_t end = std::min(line.find_first_of(kSpace, begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

/// Takes the next line off the front of the text. A backslash at the end of a line continues it: the rest then counts
/// as a line of its own, which is harmless since it begins with no keyword.
std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

bool is_finite(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  return result.ec != std::errc::result_out_of_range && std::isfinite(value);
}

std::string vertex_fault(std::string_view line, long vertex) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_finite(next_word(line))) return fmt::format("vertex {} has a coordinate that is not finite", vertex);
  }
  return {};
}

/// `so_far`: vertices above this line, which negative indices count back from.
std::string face_fault(std::string_view line, long face, long so_far, long vertices) {
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
    long index = 0;
    if (std::from_chars(word.data(), word.data() + word.size(), index).ec != std::errc{}) continue;
    const bool exists = index < 0 ? -index <= so_far : index >= 1 && index <= vertices;
    if (!exists) return fmt::format("face {} refers to vertex {} of {} (index out of range)", face, index, vertices);
  }
  return {};
}

long count_vertices(std::string_view text) {
  long vertices = 0;
  while (!text.empty()) {
    std::string_view line = next_line(text);
    if (next_word(line) == "v") ++vertices;
  }
  return vertices;
}

}  // namespace

std::string find_obj_fault(std::string_view text) {
  const long vertices = count_vertices(text);
  long faces = 0;
  long so_far = 0;
  std::string fault;
  while (!text.empty() && fault.empty()) {
    std::string_view line = next_line(text);
    const std::string_view keyword = next_word(line);
    if (keyword == "v") fault = vertex_fault(line, ++so_far);
    if (keyword == "f") fault = face_fault(line, ++faces, so_far, vertices);
  }
  if (fault.empty() && faces == 0 && vertices > 0)
    return fmt::format("no faces (a point cloud of {} points)", vertices);
  return fault;
}

}  // namespace sprung
