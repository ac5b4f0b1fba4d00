#pragma once
#include <string>

namespace CLI {
class App;
}

namespace sprung {

/// The manual of the program with all its commands and options, as roff for man(1).
[[nodiscard]] std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace sprung
