#include "app/help/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

namespace sprung {
namespace {

/// Text as roff: hyphens stay hyphens, no line is taken for a request.
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

/// Indentation of the continuation of a line.
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
