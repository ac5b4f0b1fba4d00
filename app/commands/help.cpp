#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/help/manual.h"
#include "app/validate/cases.h"
#include "core/text.h"

namespace sprung {
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

/// The names that a key of the scene accepts.
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

/// The names that an option accepts; empty if it accepts none, or any.
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

struct HelpOptions {
  std::string topic;
  bool json_schema = false;
};

std::string help_on(const CLI::App& command, const std::string& name) {
  return wrapped_help(command.get_formatter()->make_help(&command, name, CLI::AppFormatMode::Normal));
}

/// Lets the help of a command name all its options.
void show_all(CLI::App& command) {
  const auto formatter = std::make_shared<CLI::Formatter>();
  formatter->column_width(kHelpColumn);
  command.formatter(formatter);
}

std::string help_text(CLI::App& app, const HelpOptions& options) {
  const std::string& topic = options.topic;
  if (topic == "scene") return options.json_schema ? scene_schema() : scene_reference();
  for (CLI::App* command : app.get_subcommands({})) show_all(*command);
  if (topic == "man") return man_page(app, SPRUNG_VERSION);
  if (topic == "bash") return completions(app, CommandShell::kBash, named_choices);
  if (topic == "zsh") return completions(app, CommandShell::kZsh, named_choices);
  if (topic == "fish") return completions(app, CommandShell::kFish, named_choices);
  if (options.json_schema) throw Error(ErrorKind::kUsage, "--json-schema is for sprung help scene");
  if (topic.empty()) return help_on(app, app.get_name());
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == topic) return help_on(*command, "sprung " + topic);
  }
  const std::vector<std::string> names = help_topics(app);
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw Error(ErrorKind::kUsage, fmt::format("no help on '{}'{}", topic, did_you_mean(topic, known)));
}

}  // namespace

void add_help(CLI::App& app, Invocation&) {
  CLI::App* command = app.add_subcommand("help", "on a command, or on the keys of a scene: sprung help scene");
  const auto options = std::make_shared<HelpOptions>();
  command->add_option("TOPIC", options->topic,
                      "a command; scene, its keys; man, the manual as roff; bash, zsh or fish, completions for it");
  command->add_flag("--json-schema", options->json_schema, "the keys of a scene as a JSON Schema");
  command->footer("Examples:\n  sprung help animate\n  sprung help scene");
  command->callback([options, &app] { fmt::print("{}", help_text(app, *options)); });
}

}  // namespace sprung
