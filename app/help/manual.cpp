#include "app/help/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>

#include "app/commands/options.h"
#include "app/scene/material_library.h"
#include "app/scene/scenarios.h"
#include "app/scene/scene_reference.h"
#include "app/scene/scene_values.h"
#include "app/validate/built_in_cases.h"
#include "app/validate/experiment_files.h"
#include "core/error.h"

namespace sprung {
namespace {

/// Text as roff: hyphens that can be copied, nothing that is taken for a request.
std::string roff(const std::string& text) {
  std::string escaped;
  bool starts_line = true;
  for (const char letter : text) {
    if (starts_line && (letter == '.' || letter == '\'')) escaped += "\\&";
    if (letter == '\\') {
      escaped += "\\e";
    } else if (letter == '-') {
      escaped += "\\-";
    } else {
      escaped += letter;
    }
    starts_line = letter == '\n';
  }
  return escaped;
}

std::string verbatim(const std::string& text) { return text.empty() ? "" : ".PP\n.nf\n" + roff(text) + "\n.fi\n"; }

std::string option_entry(const CLI::Option& option) {
  const bool is_positional = option.get_positional();
  const std::string name = is_positional ? option.get_name(true) : option.get_name(false, true);
  const std::string value = is_positional || option.get_option_text().empty() ? "" : " " + option.get_option_text();
  return fmt::format(".TP\n.B {}\n{}\n", roff(name + value), roff(option.get_description()));
}

std::string command_section(const CLI::App& command) {
  std::string text = fmt::format(".SS sprung {}\n{}.\n", command.get_name(), roff(command.get_description()));
  for (const CLI::Option* option : command.get_options()) text += option_entry(*option);
  return text + verbatim(command.get_footer());
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& version) {
  std::string text = fmt::format(
      ".TH SPRUNG 1 \"\" \"sprung {}\" \"User Commands\"\n.SH NAME\nsprung \\- soft bodies of real materials, from a "
      "surface mesh to a film\n.SH SYNOPSIS\n.B sprung\n.I COMMAND\n[\\fIOPTION\\fR ...]\n.SH DESCRIPTION\n{}\n"
      ".SH COMMANDS\n",
      version, roff(app.get_description()));
  for (const CLI::App* command : app.get_subcommands({})) text += command_section(*command);
  return text + ".SH NOTES\n" + verbatim(app.get_footer());
}

namespace {

std::vector<std::string> split(std::string_view text, std::string_view separator) {
  std::vector<std::string> parts;
  for (auto end = text.find(separator); end != std::string_view::npos; end = text.find(separator)) {
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(end + separator.size());
  }
  parts.emplace_back(text);
  return parts;
}

/// Of the scene's key that an option stands for.
std::vector<std::string> names_of_key(std::string_view path) {
  constexpr std::string_view kNames = "one of ";
  const std::string_view table = path.substr(0, path.find('.'));
  const std::string_view key = path.substr(path.find('.') + 1);
  for (const TableText& texts : scene_tables()) {
    if (texts.name != table) continue;
    const auto is_it = [&](const KeyText& text) { return text.name == key && text.type.starts_with(kNames); };
    const auto found = std::find_if(texts.keys.begin(), texts.keys.end(), is_it);
    if (found != texts.keys.end()) return split(std::string_view(found->type).substr(kNames.size()), ", ");
  }
  return {};
}

/// "[[body]]" -> "body."
std::string prefix_of(std::string_view path) {
  const auto first = path.find_first_not_of('[');
  return std::string(path.substr(first, path.find(']') - first)) + ".";
}

/// "body.young=" for every key that can be set by itself.
std::vector<std::string> settable_keys() {
  std::vector<std::string> names;
  for (const TableText& table : scene_tables()) {
    std::vector<std::string> prefixes;
    std::transform(table.paths.begin(), table.paths.end(), std::back_inserter(prefixes), prefix_of);
    if (prefixes.empty()) prefixes.emplace_back();  // the scene's own
    for (const std::string& prefix : prefixes) {
      for (const KeyText& key : table.keys) {
        if (key.type != "table" && key.type != "tables") names.push_back(fmt::format("{}{}=", prefix, key.name));
      }
    }
  }
  return names;
}

/// Those that come with the program; none where they are not found.
std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const BuiltInCase& known : built_in_cases()) names.emplace_back(known.name);
  try {
    for (const std::filesystem::path& file : experiment_files()) names.push_back(file.stem().string());
  } catch (const Error&) {
    return names;
  }
  return names;
}

}  // namespace

std::vector<std::string> named_choices(const CLI::Option& option) {
  const std::string& text = option.get_option_text();
  if (text.find('|') != std::string::npos) {
    std::vector<std::string> choices = split(text, "|");
    std::erase_if(choices, [](const std::string& choice) { return choice.find_first_of("ABCDEFGHIJKLMN") == 0; });
    return choices;
  }
  const std::string name = option.get_name();
  if (name == "--class") {
    const std::vector<std::string_view> names = value_names<MaterialClass>();
    return {names.begin(), names.end()};
  }
  if (name == "--set") return settable_keys();
  if (name == "--case") return case_names();
  if (name == "--scenario") return {scenario_names().begin(), scenario_names().end()};
  if (name == "--material") {
    std::vector<std::string> names;
    for (const LibraryMaterial& material : built_in_materials()->materials()) names.push_back(material.name);
    return names;
  }
  for (const KeyOption& known : key_options()) {
    if (name == known.option) return names_of_key(known.key);
  }
  return {};
}

namespace {

/// Spaces before what a line goes on with.
std::size_t indent_of(std::string_view line) {
  const std::size_t start = std::min(line.find_first_not_of(' '), line.size());
  const bool has_description = start > 0 && line.size() > kHelpColumn && line[kHelpColumn - 1] == ' ';
  return has_description ? kHelpColumn : start;
}

}  // namespace

std::string wrapped_help(std::string_view help) {
  std::string wrapped;
  while (!help.empty()) {
    const std::size_t end = std::min(help.find('\n'), help.size());
    std::string line(help.substr(0, end));
    const std::size_t indent = indent_of(line);
    while (line.size() > kHelpWidth) {
      const std::size_t space = line.rfind(' ', kHelpWidth);
      if (space == std::string::npos || space <= indent) break;  // a word that is too long by itself
      wrapped += line.substr(0, line.find_last_not_of(' ', space) + 1) + "\n";
      line = std::string(indent, ' ') + line.substr(space + 1);
    }
    wrapped += line;
    if (end < help.size()) wrapped += '\n';
    help.remove_prefix(std::min(end + 1, help.size()));
  }
  return wrapped;
}

}  // namespace sprung
