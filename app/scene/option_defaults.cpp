#include "app/scene/option_defaults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "app/scene/toml.h"
#include "core/error.h"
#include "core/files.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

std::string text_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  std::ostringstream words;
  node.visit([&](const auto& value) { words << value; });
  return words.str();
}

/// Several values if an option may be given several times: an array of strings.
std::vector<std::string> values_of(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr || !array->is_homogeneous(toml::node_type::string)) return {text_of(node)};
  std::vector<std::string> values;
  for (const toml::node& item : *array) values.push_back(text_of(item));
  return values;
}

void add_table(const toml::table& table, const std::string& command, OptionDefaults& defaults) {
  for (const auto& [name, node] : table) {
    const auto line = int(name.source().begin.line);
    if (const toml::table* of_command = node.as_table(); of_command != nullptr && command.empty()) {
      add_table(*of_command, std::string(name.str()), defaults);
    } else if (node.is_table() || node.is_array_of_tables()) {
      throw Error(
          ErrorKind::kBadInput,
          fmt::format("{}:{}: '{}' is no option; this file holds defaults of options (sprung help config), and a "
                      "scene needs another name than {}",
                      defaults.file.string(), line, name.str(), kConfigName));
    } else {
      defaults.list.push_back(
          {.command = command, .option = fmt::format("--{}", name.str()), .values = values_of(node), .line = line});
    }
  }
}

}  // namespace

const OptionDefault* OptionDefaults::find(std::string_view command, std::string_view option) const {
  const OptionDefault* found = nullptr;
  for (const OptionDefault& one : list) {
    if (one.option != option || (!one.command.empty() && one.command != command)) continue;
    if (found == nullptr || found->command.empty()) found = &one;
  }
  return found;
}

std::string OptionDefaults::location(const OptionDefault& one) const {
  return fmt::format("{}:{}", file.string(), one.line);
}

OptionDefaults option_defaults() {
  if (const char* named = std::getenv(kConfigVariable)) {  // NOLINT(concurrency-mt-unsafe): nobody sets it
    if (*named == '\0') return {};
    if (!fs::is_regular_file(named)) {
      throw Error(ErrorKind::kBadInput, fmt::format("{}: '{}' is not there", kConfigVariable, named));
    }
    OptionDefaults defaults = read_option_defaults(named);
    defaults.is_of_environment = true;
    return defaults;
  }
  std::error_code no_folder;
  for (fs::path folder = fs::current_path(no_folder); !folder.empty(); folder = folder.parent_path()) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / kConfigName, ignored)) return read_option_defaults(folder / kConfigName);
    if (folder == folder.parent_path()) break;
  }
  return {};
}

OptionDefaults read_option_defaults(const fs::path& file) {
  OptionDefaults defaults{.file = file, .list = {}};
  try {
    add_table(toml::parse(read_file(file)), "", defaults);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}:{}:{}: {}", file.string(), error.source().begin.line,
                                                  error.source().begin.column, error.description()));
  }
  std::sort(defaults.list.begin(), defaults.list.end(),
            [](const OptionDefault& a, const OptionDefault& b) { return a.line < b.line; });
  return defaults;
}

}  // namespace sprung
