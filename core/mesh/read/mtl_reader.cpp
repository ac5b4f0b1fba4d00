#include "core/mesh/read/mtl_reader.h"

#include "core/mesh/read/text_scanner.h"

namespace sprung {
namespace {

/// The words that belong to an option of a texture map and are not its file: "-s 1 1 1", "-clamp on".
bool is_option_value(std::string_view word) { return number_of(word).has_value() || word == "on" || word == "off"; }

/// The file of a map_Kd line, which may hold blanks, after its options.
std::string texture_name(TextScanner& scanner) {
  std::string_view word = scanner.word();
  while (word.starts_with('-')) {
    const bool takes_a_word = word == "-imfchan" || word == "-type";
    word = scanner.word();
    if (takes_a_word) {
      word = scanner.word();
      continue;
    }
    while (is_option_value(word)) word = scanner.word();
  }
  const std::string_view rest = scanner.rest();
  return rest.empty() ? std::string(word) : std::string(word.data(), rest.data() + rest.size());
}

void read_color(TextScanner& scanner, Eigen::Vector4f& color) {
  for (int channel = 0; channel < 3; ++channel) {
    const auto value = number_of(scanner.word());
    if (!value || !(*value >= 0)) return;
    color[channel] = static_cast<float>(std::min(*value, 1.0));
  }
}

}  // namespace

std::vector<SurfaceMaterial> read_mtl(std::string_view text) {
  std::vector<SurfaceMaterial> materials;
  TextScanner scanner(without_byte_order_mark(text), "MTL");
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.word();
    if (keyword == "newmtl") materials.emplace_back().name = scanner.rest();
    if (materials.empty()) continue;
    if (keyword == "Kd") read_color(scanner, materials.back().color);
    if (keyword == "map_Kd") materials.back().texture_name = texture_name(scanner);
  }
  return materials;
}

}  // namespace sprung
